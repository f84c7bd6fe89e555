#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/sat.h"

namespace rung {

/// What is already known of a cone, over its step graph: conditions that hold
/// in every scan and lemmas that hold of every state.
struct Known {
  std::uint32_t k = 0;
  std::vector<AigLit> conditions;
  std::vector<AigLit> lemmas;
};

/// Candidates for one joint induction; `true` flags survive.
struct Candidates {
  std::vector<AigLit> conditions;
  std::vector<AigLit> lemmas;  // over state leaves
  std::vector<bool> condition_holds;
  std::vector<bool> lemma_holds;
};

/// Limits of an induction: when one is reached, nothing has been shown.
struct InductionLimits {
  InductionLimits(std::int64_t most_conflicts = 20000,
                  std::uint32_t most_rounds = 100000)
      : conflicts(most_conflicts), rounds(most_rounds) {}
  std::int64_t conflicts;  // a query
  std::uint32_t rounds;    // queries that drop candidates
};

/// Drops candidates until the rest, together with `known`, is k-inductive in
/// the sense of Invariant (smt/invariant.h); one session for all of them.
/// Returns false when a limit was reached: then nothing has been shown.
///
/// Source: Flanagan, Leino, "Houdini, an Annotation Assistant for ESC/Java",
///         FME 2001; Sheeran, Singh, Stalmarck, "Checking Safety Properties
///         Using Induction and a SAT-Solver", FMCAD 2000.
bool prove_by_induction(Cone& cone, const Known& known, std::uint32_t k,
                        Candidates& candidates, const InductionLimits& limits,
                        const Deadline& deadline);

/// Which of `known.lemmas` its conditions rest on, closed under the step. All
/// of them when a limit was reached.
std::vector<bool> needed_lemmas(Cone& cone, const Known& known,
                                std::int64_t conflicts,
                                const Deadline& deadline);

}  // namespace rung
