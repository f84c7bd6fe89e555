#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/induction.h"
#include "smt/invariant.h"
#include "smt/run.h"

namespace rung {

/// What lemmas are made of: a bit of the state, or a comparison of a word with
/// a number, which stands for many of its bits.
struct PdrSignal {
  LemmaAtom atom;
  AigLit now = 0;   // over the state before the scan
  AigLit next = 0;  // the same after the scan
  bool init = false;
  bool fine = false;  // one bit of a word: used when nothing coarser will do
};

/// Signals of a cone: its bits, `x >= c` for the numbers c that its words are
/// compared with, and the bits of its words. Adds terms to `ts`.
std::vector<PdrSignal> pdr_signals(TransitionSystem& ts, Cone& cone);

struct PdrLimits {
  std::uint32_t queries = 20000;   // in all
  std::int64_t conflicts = 20000;  // a query
};

struct PdrResult {
  enum class Answer : std::uint8_t { Unreachable, Reachable, Unknown };
  Answer answer = Answer::Unknown;
  /// Unreachable: with what is known inductive, and they rule the target out.
  std::vector<LemmaClause> lemmas;
  Run run;  // Reachable: scans only
};

/// Property-directed reachability: is there a run to a scan in which `target`
/// holds? `known` holds in every scan and only helps.
///
/// Source: Bradley, "SAT-Based Model Checking without Unrolling", VMCAI 2011;
///         Een, Mishchenko, Brayton, "Efficient Implementation of Property
///         Directed Reachability", FMCAD 2011.
PdrResult property_directed_reachability(Cone& cone,
                                         const std::vector<PdrSignal>& signals,
                                         const Known& known, AigLit target,
                                         const PdrLimits& limits,
                                         const Deadline& deadline);

}  // namespace rung
