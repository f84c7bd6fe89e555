#include "analysis/node_operands.h"

namespace rung {

std::uint32_t operand_count(NodeOp op) {
  switch (op) {
    case NodeOp::Constant:
    case NodeOp::Read:
    case NodeOp::Call:
    case NodeOp::Branch:
      return 0;
    case NodeOp::Not:
    case NodeOp::Negate:
    case NodeOp::Wrap16:
    case NodeOp::Wrap:
    case NodeOp::ToWord:
    case NodeOp::ToBit:
      return 1;
    case NodeOp::And:
    case NodeOp::Or:
    case NodeOp::Xor:
    case NodeOp::Equal:
    case NodeOp::NotEqual:
    case NodeOp::Less:
    case NodeOp::LessEqual:
    case NodeOp::Greater:
    case NodeOp::GreaterEqual:
    case NodeOp::Add:
    case NodeOp::Subtract:
    case NodeOp::Multiply:
    case NodeOp::Divide:
      return 2;
  }
  return 0;
}

}  // namespace rung
