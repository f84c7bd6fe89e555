#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// One literal of a lemma: a bit term over state variables, or bit `bit` of
/// the two's complement of state word `var`, which is floor(var / 2^bit) mod 2.
struct LemmaAtom {
  ExprId term;            // no value: the bit of `var`
  VarId var;              //
  std::uint32_t bit = 0;  //
  bool negated = false;
};

/// A disjunction of atoms; an empty one is false.
using LemmaClause = std::vector<LemmaAtom>;

/// A certificate that `conditions` hold in every scan from power-up that keeps
/// the constraints. With L(s) the conjunction of `lemmas` and of the ranges
/// low <= x <= high of the state words, P(s, i) that of `conditions`, C(s, i)
/// that of the constraints, the ranges of the inputs and of dt:
///
///   base  s0 = init, s1 = next(s0, i0), ..., C in scans 0 .. k-1
///         implies L(s0) .. L(sk) and P in scans 0 .. k-1
///   step  L(s0) .. L(sk), P in scans 0 .. k-1, C in scans 0 .. k
///         implies P in scan k and L(s(k+1))
///
/// and so do the `consequences`, which are about any scan from such a state,
/// whether or not the constraints allow it: they assume C in the scans before
/// theirs only.
///
/// With k = 0 that is an ordinary inductive invariant: initiation, consecution
/// and safety over one scan.
struct Invariant {
  std::uint32_t k = 0;
  std::vector<LemmaClause> lemmas;
  std::vector<ExprId> conditions;
  std::vector<ExprId> consequences;
};

/// A lemma in the program's names; bits are printed as `T(0).elapsed[3]`.
std::string to_string(const TransitionSystem& ts, const LemmaClause& lemma);

}  // namespace rung
