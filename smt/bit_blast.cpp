#include "smt/bit_blast.h"

namespace rung {

Operands operands(const Expr& e) {
  switch (e.op) {
    case ExprOp::Constant:
    case ExprOp::Variable:
      return {};
    case ExprOp::Not:
    case ExprOp::Wrap16:
      return {{e.a}, 1};
    case ExprOp::And:
    case ExprOp::Xor:
    case ExprOp::Equal:
    case ExprOp::Less:
    case ExprOp::Add:
    case ExprOp::Multiply:
    case ExprOp::Divide:
      return {{e.a, e.b}, 2};
    case ExprOp::Ite:
      return {{e.a, e.b, e.c}, 3};
  }
  return {};
}

StepCircuit::StepCircuit(const TransitionSystem& ts) : ts_(&ts) {}

AigLit StepCircuit::bit(ExprId term) { return word(term).front(); }

const Word& StepCircuit::word(ExprId term) {
  encode(term);
  return done(term);
}

const Word& StepCircuit::leaves(VarId var) { return word(ts_->of(var)); }

Word StepCircuit::next(std::uint32_t state) {
  const State& s = ts_->states[state];
  const auto width = static_cast<std::uint32_t>(leaves(s.var).size());
  return word_resize(word(s.next), width);
}

AigLit StepCircuit::in_range(VarId var) {
  const Variable& v = ts_->vars[var];
  if (v.type == Type::Bit) return kAigTrue;
  const Word x = leaves(var);
  const AigLit below = word_less(aig_, x, word_constant(v.low));
  const AigLit above = word_less(aig_, word_constant(v.high), x);
  return aig_.conjunction(aig_not(below), aig_not(above));
}

void StepCircuit::encode(ExprId root) {
  stack_.push_back(root);
  while (!stack_.empty()) {
    const ExprId id = stack_.back();
    if (is_done(id)) {
      stack_.pop_back();
      continue;
    }
    const Expr& e = ts_->exprs[id];
    const std::size_t waiting = stack_.size();
    const Operands needed = operands(e);
    for (std::uint32_t i = 0; i < needed.count; ++i) {
      if (!is_done(needed.ids[i])) stack_.push_back(needed.ids[i]);
    }
    if (stack_.size() != waiting) continue;
    stack_.pop_back();
    words_.emplace(id, encode_one(e));
    terms_.push_back(id);
  }
}

Word StepCircuit::encode_one(const Expr& e) {
  switch (e.op) {
    case ExprOp::Variable:
      return encode_variable(e.var);
    case ExprOp::Not:
      return {aig_not(done(e.a).front())};
    case ExprOp::And:
      return {aig_.conjunction(done(e.a).front(), done(e.b).front())};
    case ExprOp::Xor:
      return {aig_.exclusive_or(done(e.a).front(), done(e.b).front())};
    case ExprOp::Equal:
      return {word_equal(aig_, done(e.a), done(e.b))};
    case ExprOp::Less:
      return {word_less(aig_, done(e.a), done(e.b))};
    case ExprOp::Constant:
    case ExprOp::Ite:
    case ExprOp::Add:
    case ExprOp::Multiply:
    case ExprOp::Divide:
    case ExprOp::Wrap16:
      break;
  }
  if (e.type == Type::Bit) {
    if (e.op == ExprOp::Constant) return {e.value != 0 ? kAigTrue : kAigFalse};
    return {
        aig_.choose(done(e.a).front(), done(e.b).front(), done(e.c).front())};
  }
  if (e.low <= -ExprArena::kUnbounded || e.high >= ExprArena::kUnbounded) {
    overflow_ = true;
  }
  // The bounds know more than the operands' widths do.
  Word word = word_resize(encode_word(e), word_width(e.low, e.high));
  if (e.low >= 0) word.back() = kAigFalse;
  if (e.high < 0) word.back() = kAigTrue;
  return word;
}

Word StepCircuit::encode_word(const Expr& e) {
  switch (e.op) {
    case ExprOp::Constant:
      return word_constant(e.value);
    case ExprOp::Add:
      return word_add(aig_, done(e.a), done(e.b));
    case ExprOp::Multiply:
      return word_multiply(aig_, done(e.a), done(e.b));
    case ExprOp::Divide:
      return word_divide(aig_, done(e.a), ts_->exprs[e.b].value);
    case ExprOp::Wrap16:
      return word_resize(done(e.a), 16);
    case ExprOp::Ite:
      return word_choose(aig_, done(e.a).front(), done(e.b), done(e.c));
    case ExprOp::Variable:
    case ExprOp::Not:
    case ExprOp::And:
    case ExprOp::Xor:
    case ExprOp::Equal:
    case ExprOp::Less:
      break;
  }
  return {kAigFalse};
}

Word StepCircuit::encode_variable(VarId var) {
  const Variable& v = ts_->vars[var];
  variables_.push_back(var);
  Word word;
  const auto leaf = [&] {
    const AigLit bit = aig_.input();
    leaf_.resize(aig_.size());
    leaf_[aig_node(bit)] = {var, static_cast<std::uint32_t>(word.size())};
    word.push_back(bit);
  };
  if (v.type == Type::Bit) {
    leaf();
    return word;
  }
  const std::uint32_t width = word_width(v.low, v.high);
  while (word.size() + 1 < width) leaf();
  if (v.low >= 0 || v.high < 0) {
    word.push_back(v.low >= 0 ? kAigFalse : kAigTrue);
  } else {
    leaf();
  }
  return word;
}

}  // namespace rung
