#pragma once

#include <cstdint>

#include "analysis/program.h"

namespace rung {

/// Changes of one place of a program, for what is tried as a repair. Whatever
/// points at nodes behind the place is moved along.

/// What used node `at`, a bit, uses its negation then.
void negate_node(Program& program, std::uint32_t at);

/// A negation is left out; any other operator becomes `op`, with what its
/// short-circuit markers do.
void replace_operator(Program& program, std::uint32_t at, NodeOp op);

/// A contact behind the whole rung: in series (And) or parallel (Or).
void append_contact(Program& program, RungId rung, CellId cell, bool negated,
                    NodeOp op);

/// The node, a bit, is `value` whatever its operands are.
void replace_by_constant(Program& program, std::uint32_t at, bool value);

}  // namespace rung
