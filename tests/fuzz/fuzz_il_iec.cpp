// Any bytes give a program or a clear error: the reader of instruction lists
// and the builder behind it. What the reader accepts the builder accepts.

#include <cstddef>
#include <cstdint>
#include <string>

#include "checks.h"
#include "frontend/il_iec/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  rung::SourceSet sources;
  const rung::FileId file = sources.add("fuzz", std::string(data, data + size));
  rung::is_il_iec(sources[file].text());
  rung::DiagnosticList list;
  const rung::Ast ast = rung::read_il_iec(sources, file, {}, list);
  check_diagnostics(sources, list);
  if (list.has_errors()) return 0;
  const rung::Program program = rung::build_program(ast, {}, list);
  check(!list.has_errors());
  check(program.rungs.size() == ast.rungs.size());
  check_program(program);
  return 0;
}
