// Any bytes give a program or a clear error: the reader of sketches and the
// builder behind it. What the reader accepts the builder accepts.

#include <cstddef>
#include <cstdint>
#include <string>

#include "checks.h"
#include "frontend/plclib/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  for (const std::string_view semantics : {"", "plclib", "plclib14"}) {
    rung::SourceSet sources;
    const rung::FileId file =
        sources.add("fuzz", std::string(data, data + size));
    rung::DiagnosticList list;
    const rung::Ast ast = rung::read_plclib(
        sources, file, {.semantics = rung::find_semantics(semantics)}, list);
    check_diagnostics(sources, list);
    if (list.has_errors()) continue;
    const rung::Program program = rung::build_program(ast, {}, list);
    check(!list.has_errors());
    check(program.rungs.size() == ast.rungs.size());
    check_program(program);
  }
  return 0;
}
