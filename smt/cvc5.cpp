#include "smt/cvc5.h"

#include <cstddef>
#include <sstream>

#include "base/process.h"

namespace rung {
namespace {

constexpr std::size_t kMostText = std::size_t{1} << 20;

/// "This is cvc5 version 1.0.3 [git ...]"
std::string version_of(const std::string& banner) {
  const std::string_view marker = "cvc5 version ";
  const std::size_t found = banner.find(marker);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + marker.size();
  return banner.substr(begin, banner.find_first_of(" \n", begin) - begin);
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

SolverAnswers run_cvc5(const std::string& path, double seconds) {
  SolverAnswers result;
  const ProcessOutput banner =
      run_process({"cvc5", "--version"}, 10, kMostText);
  result.error = banner.error;
  if (!result.error.empty()) return result;
  result.version = version_of(banner.text);
  const ProcessOutput output = run_process(
      {"cvc5", "--lang=smt2", "--incremental", path}, seconds, kMostText);
  result.error = output.error;
  if (!result.error.empty()) return result;
  std::istringstream lines(output.text);
  for (std::string line; std::getline(lines, line);) {
    if (line == "sat" || line == "unsat" || line == "unknown") {
      result.answers.push_back(line);
    } else if (result.error.empty()) {
      result.error = "cvc5: " + first_line(line);
    }
  }
  if (result.error.empty() && output.status != 0) {
    result.error = "cvc5 failed with status " + std::to_string(output.status);
  }
  return result;
}

}  // namespace rung
