#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smt/invariant.h"
#include "smt/liveness_questions.h"
#include "smt/portfolio.h"
#include "smt/recovery.h"
#include "smt/run.h"

namespace rung {

/// `never` holds at every scan's end of `ts`, a system with monitors, and that
/// answers the question.
struct LivenessProof {
  TransitionSystem ts;
  Invariant invariant;
  ExprId never;
  std::vector<ExprId> no_faults;  // hold as well, by the same invariant
};

struct LivenessAnswer {
  enum class Kind : std::uint8_t { Always, Loops, Unknown };
  Kind kind = Kind::Unknown;
  std::optional<LivenessProof> proof;  // Always
  FoundRun stem;                       // Loops: the scans before the loop
  FoundRun loop;                       // may follow each other for ever
  std::string engine;
  std::string reason;  // Unknown
};

/// Asks all engines whether a scan can end badly in the systems of
/// liveness_questions.h: first for a loop, which is the only counterexample,
/// then for what needs no numbers, then for bounds made of the presets below.
///
/// Source: Claessen, Sorensson, "A Liveness Checking Algorithm that Counts",
///         FMCAD 2012; Biere, Artho, Schuppan, "Liveness Checking as Safety
///         Checking", FMICS 2002.
///
/// Short: what is quick.
LivenessAnswer decide_recurrence(const TransitionSystem& ts,
                                 const Recurrence& asked, Patience patience,
                                 const PortfolioOptions& options);

/// The same of no goal: is there a run at all on which `fair` is true again and
/// again?
LivenessAnswer decide_fairness(const TransitionSystem& ts, ExprId fair,
                               const PortfolioOptions& options);

}  // namespace rung
