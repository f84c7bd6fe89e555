#include "frontend/ladder/words.h"

namespace rung::ladder {

Expression both(const Expression& left, AstOp op, const Expression& right,
                SourceRange where) {
  Expression nodes = left;
  push_all(nodes, right);
  push_binary(nodes, op, where);
  return nodes;
}

Expression word_of(Expression bit, SourceRange where) {
  push_conversion(bit, "to_word", where);
  return bit;
}

void wrap(Expression& value, std::uint32_t bits, SourceRange where) {
  if (bits > 16) return;
  if (bits == 16) return push_conversion(value, "wrap16", where);
  // Eight bits, at the upper end of sixteen.
  push_leaf(value, AstOp::Number, "256", where);
  push_binary(value, AstOp::Multiply, where);
  push_conversion(value, "wrap16", where);
  push_leaf(value, AstOp::Number, "256", where);
  push_binary(value, AstOp::Divide, where);
}

}  // namespace rung::ladder
