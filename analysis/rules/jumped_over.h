#pragma once

#include "analysis/program.h"

namespace rung {

/// The bit `run` of `q = run && x || !run && q` (of a word, the sum of the two
/// products), which a reader has made: the rung is executed where it is true.
/// No value: the rung is executed in every scan.
CellId guard_of(const Program& program, const Rung& rung);

/// `q = run && x || !run && q`, which keeps its value where an instruction list
/// jumps over it: rules about contacts would speak of some that nobody wrote.
bool is_jumped_over(const Program& program, const Rung& rung);

}  // namespace rung
