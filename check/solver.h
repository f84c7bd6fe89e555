#pragma once

#include <string>
#include <vector>

namespace rung::check {

/// What a solver's program said: "sat", "unsat" or "unknown", in order.
struct Answers {
  std::vector<std::string> list;
  std::string error;  // it did not run, or said something else
};

/// Runs `solver`, `z3` or `cvc5` from PATH, on the scripts, one after the
/// other and each from nothing. No shell; after `seconds` it is killed.
Answers ask_solver(const std::string& solver,
                   const std::vector<std::string>& scripts, double seconds);

}  // namespace rung::check
