#pragma once

#include "analysis/program.h"

namespace rung {

/// `q = run && x || !run && q`, which keeps its value where an instruction list
/// jumps over it: rules about contacts would speak of some that nobody wrote.
bool is_jumped_over(const Program& program, const Rung& rung);

}  // namespace rung
