#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smt/invariant.h"
#include "smt/portfolio.h"
#include "smt/recovery.h"
#include "smt/run.h"

namespace rung {

/// What is asked: is `goal` true at infinitely many scan ends of every infinite
/// run on which `fair` is? Terms of a scan's end; no `fair`: of every run.
struct Recurrence {
  ExprId goal;
  ExprId fair;
  std::int64_t counts = 0;  // that counters below count to, all together
};

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

/// Two reductions to what can happen at a scan's end, for all engines.
///
/// *Bounds* (a proof when they hold). A response: the goal comes within T ms of
/// `fair`, or of the goal before. Or: between two goals there are no more than
/// k moments at which `fair` is true and T ms have passed since the goal or the
/// last such moment; with T = 0 that is k-liveness. A scan takes time, so on a
/// run where `fair` comes again and again such moments do, too, unless the goal
/// does. T is made of the presets of the timers below.
///
/// *Loops* (exact). At some scan the state is written down; if it is there
/// again later, with `fair` and without the goal on the way, that can be
/// repeated for ever. Words are bounded and clocks saturate, so the states are
/// finitely many: where there is no loop there is no such run.
///
/// Source: Claessen, Sorensson, "A Liveness Checking Algorithm that Counts",
///         FMCAD 2012; Biere, Artho, Schuppan, "Liveness Checking as Safety
///         Checking", FMICS 2002.
///
/// Short: what is quick.
LivenessAnswer decide_recurrence(const TransitionSystem& ts,
                                 const Recurrence& asked, Patience patience,
                                 const PortfolioOptions& options);

/// The second one alone, with no goal: is there a run at all on which `fair` is
/// true again and again?
LivenessAnswer decide_fairness(const TransitionSystem& ts, ExprId fair,
                               const PortfolioOptions& options);

}  // namespace rung
