#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/trace.h"

namespace rung {

enum class Verdict : std::uint8_t {
  Proved,    // every reachable state; the certificate was re-checked.
             // Of a reach obligation: a witness was found and replayed.
  Violated,  // a trace was replayed. Of a reach obligation: the condition was
             // proved unreachable, the certificate re-checked. Of a recover
             // obligation: both, for the runs that start where the trace ends.
  Bounded,   // no violation within `scans` scans; no proof
  Vacuous,   // it holds only because its trigger or the assumptions never can
  Unknown,   // `reason` says why
};

std::string_view to_string(Verdict verdict);

/// Why a condition holds in every reachable state: lemmas over the state
/// variables whose conjunction is inductive and implies it.
struct Certificate {
  std::vector<std::string> lemmas;      // in the program's names
  std::vector<std::string> checked_by;  // "z3 4.8.12", "cvc5 1.0.3"
  std::string smtlib_path;              // empty unless a file was asked for
  /// They had accepted the same script, word for word, for an equal part of
  /// the program, and were not asked again.
  bool reused = false;
  /// Of `recoverable`: in which states which inputs lead to the goal, or to a
  /// state of a line above: "Q0 && T(0).elapsed >= 4900: I1 = 1".
  std::vector<std::string> ways;
  /// Of k-induction; smt/invariant.h. Where it is more than 0, `conditions` is
  /// all that was proved together: each may need the others.
  std::uint32_t k = 0;
  std::vector<std::string> conditions;
};

struct ObligationResult {
  Obligation obligation;
  Verdict verdict = Verdict::Unknown;
  std::string engine;       // which one decided it
  std::uint64_t scans = 0;  // length of the trace, or the bound searched
  double milliseconds = 0;
  std::string reason;
  std::optional<Certificate> certificate;
  std::optional<Trace> trace;
};

/// A check of the tool's own answer that failed: exit 4, both sides printed.
struct SelfCheckFailure {
  std::string obligation;
  std::string what;  // "the simulator does not reach the violation: ..."
};

}  // namespace rung
