#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "smt/certificate.h"
#include "smt/smtlib.h"
#include "smt/z3_context.h"

namespace rung {

/// What Z3 says of a script: Accepted when every query is unsatisfiable,
/// Rejected when one is satisfiable.
struct ScriptAnswer {
  CertificateOutcome outcome = CertificateOutcome::Undecided;
  std::uint32_t query = 0;  // Rejected: the one; Undecided: the first
  std::string why;          // Undecided: the solver's words
  /// Undecided: the claims that are neither right nor wrong, for all that is
  /// known. Every query of any other claim was answered.
  std::vector<std::uint32_t> open_claims;
};

/// Asks the queries of `script` in a solver of its own. Each is tried a little
/// first; what is too hard for that shares the time that is left.
/// Errors: never throws; an error of the solver is Undecided with its text.
ScriptAnswer ask_z3(const Z3Context& context, const CertificateScript& script,
                    std::chrono::steady_clock::time_point deadline);

}  // namespace rung
