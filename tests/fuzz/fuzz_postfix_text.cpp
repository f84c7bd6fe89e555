// Any bytes give an error or a program; a program is written and read again
// without a change.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "analysis/program.h"
#include "backend/postfix/lower.h"
#include "frontend/postfix/disassemble.h"
#include "frontend/postfix/reader.h"

namespace {

rung::Program read(std::string text, rung::SourceSet& sources,
                   rung::DiagnosticList& found) {
  const rung::FileId file =
      rung::add_postfix(sources, "input", std::move(text), found);
  if (!file.has_value()) return {};
  const rung::Ast ast = rung::read_postfix(sources, file, found);
  if (found.has_errors()) return {};
  return rung::build_program(ast, {}, found);
}

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  rung::SourceSet sources;
  rung::DiagnosticList found;
  const rung::Program program = read(
      std::string(reinterpret_cast<const char*>(data), size), sources, found);
  if (found.has_errors()) return 0;
  const auto text = rung::lower_to_postfix_text(program, found);
  const auto binary = rung::lower_to_postfix_binary(program, found);
  // What a text says and the format has no room for, the writer has named.
  if (!text || !binary) {
    require(found.has_errors());
    return 0;
  }
  require(rung::disassemble_postfix(*binary).text == *text);
  const rung::Program again = read(*binary, sources, found);
  require(!found.has_errors());
  require(rung::lower_to_postfix_binary(again, found) == *binary);
  return 0;
}
