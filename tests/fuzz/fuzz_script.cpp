// Any bytes give a program or a clear error: the reader of rung scripts and
// the builder behind it, in both dialects.

#include <cstddef>
#include <cstdint>
#include <string>

#include "checks.h"
#include "frontend/script/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string text(data, data + size);
  for (const char* const dialect : {"", "yun", "sim"}) {
    rung::SourceSet sources;
    const rung::FileId file = sources.add("fuzz", text);
    rung::DiagnosticList read;
    const rung::Ast ast = rung::read_script(sources, file, dialect, read);
    check_diagnostics(sources, read);
    rung::DiagnosticList built;
    const rung::Program program = rung::build_program(ast, {}, built);
    check_diagnostics(sources, built);
    if (!read.has_errors() && !built.has_errors()) check_program(program);
  }
  return 0;
}
