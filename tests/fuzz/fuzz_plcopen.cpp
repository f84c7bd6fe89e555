// Any bytes give a program or a clear error: the reader of PLCopen XML and the
// builder behind it, under each of its presets. What the reader accepts the
// builder accepts.

#include <cstddef>
#include <cstdint>
#include <string>

#include "checks.h"
#include "frontend/plcopen/reader.h"

namespace {

void read(const rung::SourceSet& sources, rung::FileId file,
          std::string_view semantics) {
  rung::ReadOptions options;
  options.semantics = rung::find_semantics(semantics);
  rung::DiagnosticList list;
  const rung::Ast ast = rung::read_plcopen(sources, file, options, list);
  check_diagnostics(sources, list);
  if (list.has_errors()) return;
  // What has no effect is a warning.
  rung::DiagnosticList found;
  const rung::Program program = rung::build_program(ast, {}, found);
  check(!found.has_errors());
  check(program.rungs.size() == ast.rungs.size());
  check_program(program);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  rung::SourceSet sources;
  const rung::FileId file = sources.add("fuzz", std::string(data, data + size));
  rung::is_plcopen(sources[file].text());
  read(sources, file, "openplc");
  read(sources, file, "iec");
  return 0;
}
