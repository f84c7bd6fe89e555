#pragma once

#include <vector>

#include "smt/invariant.h"

namespace rung {

/// Splits a certificate into parts whose claims share no state, through any
/// number of scans: each part is a certificate of its own, and all together
/// are the whole. Solvers take far longer on the whole: one of 200 motors in
/// one script took 3 s, in 200 scripts 0.8 s.
/// Limits: linear in the cone.
std::vector<Invariant> split_certificate(const TransitionSystem& ts,
                                         const Invariant& invariant);

}  // namespace rung
