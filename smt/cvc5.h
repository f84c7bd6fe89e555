#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// What an external solver said of a script: one word a check-sat.
struct SolverAnswers {
  std::vector<std::string> answers;  // "unsat", "sat", "unknown"
  std::string version;               // "1.0.3"
  std::string error;                 // empty when it ran to its end
};

/// Runs the binary `cvc5` from PATH on an SMT-LIB file, without a shell.
/// Errors: no such binary, a time-out, or a solver that fails, in `error`.
SolverAnswers run_cvc5(const std::string& path, double seconds);

}  // namespace rung
