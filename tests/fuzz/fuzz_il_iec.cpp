// Any bytes give a program or a clear error: the reader of instruction lists
// and the builder behind it. What the reader accepts the builder accepts.

#include <cstddef>
#include <cstdint>
#include <string>

#include "analysis/program.h"
#include "frontend/il_iec/reader.h"

namespace {

void check(bool holds) {
  if (!holds) __builtin_trap();
}

void check_diagnostics(const rung::SourceSet& sources,
                       const rung::DiagnosticList& list) {
  for (const rung::Diagnostic& item : list.items()) {
    check(item.code.size() == 5 && item.code.substr(0, 3) == "RP0");
    check(!item.message.empty());
    check(item.where.has_value() && item.where.begin <= item.where.end);
    check(item.where.end <= sources[item.where.file].text().size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  rung::SourceSet sources;
  const rung::FileId file = sources.add("fuzz", std::string(data, data + size));
  rung::is_il_iec(sources[file].text());
  rung::DiagnosticList list;
  const rung::Ast ast = rung::read_il_iec(sources, file, list);
  check_diagnostics(sources, list);
  if (list.has_errors()) return 0;
  const rung::Program program = rung::build_program(ast, {}, list);
  check(!list.has_errors());
  check(program.rungs.size() == ast.rungs.size());
  return 0;
}
