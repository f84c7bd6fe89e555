#pragma once

#include <cstdint>

#include "analysis/program.h"

namespace rung {

/// How many of Node::a and Node::b it has: those of a call are with the call.
std::uint32_t operand_count(NodeOp op);

}  // namespace rung
