#include "programs.h"

#include <gtest/gtest.h>

#include "frontend/script/reader.h"

namespace rung {

std::unique_ptr<Read> read(const std::string& text, std::string_view dialect) {
  auto result = std::make_unique<Read>();
  const FileId file = result->sources.add("test", text);
  DiagnosticList problems;
  const Ast ast = read_script(result->sources, file, dialect, problems);
  result->program = build_program(ast, {}, problems);
  for (const Diagnostic& d : problems.items()) {
    EXPECT_NE(d.severity, Severity::Error) << text << ": " << d.message;
  }
  return result;
}

}  // namespace rung
