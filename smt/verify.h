#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"
#include "analysis/result.h"
#include "analysis/transition_system.h"

namespace rung {

/// All limits of one run. Effort limits (conflicts) decide first, so results
/// do not depend on the machine; the clock is the outer limit.
struct Budget {
  double seconds = 60;            // one program, all obligations
  std::uint32_t max_depth = 200;  // jump steps of the bounded search
  /// Set by another thread, which nobody waits for any more: give up.
  const std::atomic<bool>* stop = nullptr;
};

struct VerifyOptions {
  Budget budget;
  std::string engine;      // empty: the portfolio; else one engine by name
  std::uint32_t jobs = 1;  // independent parts of the program at a time
  bool self_check = true;  // replay traces, re-check certificates
  std::string recheck;     // "cvc5": re-check with that binary as well
  std::string smtlib_directory;  // write certificates there; empty: nowhere
  /// Test only: of random runs. Verdicts do not depend on it.
  std::uint64_t seed = 0;
  /// Test only: corrupt an answer before its check, to see it rejected.
  bool inject_wrong_invariant = false;
  bool inject_wrong_trace = false;
  std::function<void(std::string_view)> progress;  // may be empty
  /// Obligations to decide, by name; empty: all.
  std::function<bool(std::string_view)> wanted;
};

struct VerifyReport {
  std::vector<ObligationResult> results;  // in the order of the obligations
  std::vector<SelfCheckFailure> failures;
};

/// Decides every obligation; traces are replayed and certificates re-checked
/// before they are in the report.
/// Errors: never throws; a solver's exception is an Unknown with its text.
VerifyReport verify(const Program& program, const PropertySet& properties,
                    const VerifyOptions& options);

/// Names for --engine, and one line each about them.
struct EngineInfo {
  std::string_view name;
  std::string_view summary;
};
const std::vector<EngineInfo>& engines();

/// The versions of the linked solvers, e.g. {"z3", "4.8.12"}.
std::vector<std::pair<std::string, std::string>> solver_versions();

}  // namespace rung
