#include "frontend/ladder/jumps.h"

namespace rung::ladder {

void Jumps::jump(std::string_view label, const Expression& power,
                 SourceRange where) {
  if (taken_.empty()) before_ = out_->guard();
  const auto guarded = [&](Expression nodes) {
    if (out_->guard().empty()) return nodes;
    push_leaf(nodes, AstOp::Name, out_->guard(), where);
    push_binary(nodes, AstOp::And, where);
    return nodes;
  };
  const std::string_view bit =
      out_->keep("jump", kBitCell, guarded(power), where);
  taken_[label].push_back(bit);
  Expression stays;
  push_leaf(stays, AstOp::Name, bit, where);
  push_unary(stays, AstOp::Not, where);
  out_->set_guard(out_->keep("here", kBitCell, guarded(stays), where));
}

void Jumps::arrive(std::string_view label, SourceRange where) {
  const auto taken = taken_.find(label);
  if (taken == taken_.end()) return;
  Expression here;
  push_leaf(here, AstOp::Name, out_->guard(), where);
  for (const std::string_view bit : taken->second) {
    push_leaf(here, AstOp::Name, bit, where);
    push_binary(here, AstOp::Or, where);
  }
  taken_.erase(taken);
  out_->set_guard(taken_.empty() ? before_
                                 : out_->keep("here", kBitCell, here, where));
}

}  // namespace rung::ladder
