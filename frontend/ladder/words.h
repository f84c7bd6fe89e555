#pragma once

#include <cstdint>

#include "frontend/statements.h"

namespace rung::ladder {

/// `left OP right`.
Expression both(const Expression& left, AstOp op, const Expression& right,
                SourceRange where);
/// 1 where the bit is true, else 0.
Expression word_of(Expression bit, SourceRange where);
/// The value in 8 or 16 bits, two's complement; more bits are left as they are.
void wrap(Expression& value, std::uint32_t bits, SourceRange where);

}  // namespace rung::ladder
