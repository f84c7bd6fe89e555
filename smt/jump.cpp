#include "smt/jump.h"

#include <algorithm>

namespace rung {

std::vector<ExprId> growth_terms(TransitionSystem& ts) {
  std::vector<ExprId> growth(ts.states.size());
  for (std::size_t i = 0; i < ts.states.size(); ++i) {
    const State& state = ts.states[i];
    if (!state.clock) continue;
    const ExprId later = ts.exprs.add(ts.of(state.var), ts.of(ts.dt));
    growth[i] = ts.exprs.minimum(later, ts.exprs.word(state.cap));
  }
  return growth;
}

JumpCircuit::JumpCircuit(Cone& cone, const std::vector<ExprId>& growth)
    : cone_(&cone), bits_(cone.bits()) {
  const TransitionSystem& ts = cone.ts();
  for (std::uint32_t state : cone.states()) {
    if (!ts.states[state].clock) continue;
    grown_[growth[state]] = state;
    useful_ = ts.scan.max_ms > 0;
  }
  if (!useful_) return;
  add_leaves();
  for (std::uint32_t state : cone.states()) visit(ts.states[state].next);
  for (ExprId constraint : ts.constraints) visit(constraint);
  finish();
}

Word JumpCircuit::leaf_word(std::int64_t high) {
  Word word;
  for (std::uint32_t i = word_width(0, high) - 1; i > 0; --i) {
    word.push_back(cone_->circuit().aig().input());
  }
  word.push_back(kAigFalse);
  return word;
}

void JumpCircuit::add_leaves() {
  const TransitionSystem& ts = cone_->ts();
  std::int64_t longest = 1;
  for (std::uint32_t state : cone_->states()) {
    if (ts.states[state].clock) {
      longest = std::max(longest, ts.states[state].cap);
    }
  }
  Aig& aig = cone_->circuit().aig();
  taken_ = aig.input();
  delta_ = leaf_word(longest);
  scans_ = leaf_word(longest / std::max<std::int64_t>(ts.scan.min_ms, 1) + 1);
  // scans * min <= delta <= scans * max, and something happens.
  const Word least = word_multiply(aig, scans_, word_constant(ts.scan.min_ms));
  const Word most = word_multiply(aig, scans_, word_constant(ts.scan.max_ms));
  allowed_ = aig_not(word_equal(aig, scans_, word_constant(0)));
  allowed_ = aig.conjunction(allowed_, aig_not(word_less(aig, delta_, least)));
  allowed_ = aig.conjunction(allowed_, aig_not(word_less(aig, most, delta_)));
}

/// Visits the terms under `root` once, operands first.
void JumpCircuit::visit(ExprId root) {
  const ExprArena& exprs = cone_->ts().exprs;
  stack_.push_back(root);
  while (!stack_.empty()) {
    const ExprId id = stack_.back();
    const auto [entry, is_new] = seen_.try_emplace(id, false);
    if (entry->second) {
      stack_.pop_back();
      continue;
    }
    if (!is_new) {
      entry->second = true;
      stack_.pop_back();
      stretch_term(id, exprs[id]);
      continue;
    }
    // The comparison inside a growth term is the saturation's own.
    if (grown_.count(id) != 0) continue;
    const Operands under = operands(exprs[id]);
    for (std::uint32_t i = 0; i < under.count; ++i) {
      if (seen_.count(under.ids[i]) == 0) stack_.push_back(under.ids[i]);
    }
  }
}

const Word& JumpCircuit::stretched(ExprId id) {
  const auto found = stretched_.find(id);
  return found == stretched_.end() ? cone_->circuit().word(id) : found->second;
}

/// min(x + delta, cap), x as the first scan left it.
Word JumpCircuit::grown_word(std::uint32_t state) {
  Aig& aig = cone_->circuit().aig();
  const Word cap = word_constant(cone_->ts().states[state].cap);
  const Word sum = word_add(aig, cone_->circuit().next(state), delta_);
  return word_choose(aig, word_less(aig, sum, cap), sum, cap);
}

void JumpCircuit::stretch_term(ExprId id, const Expr& e) {
  const TransitionSystem& ts = cone_->ts();
  Aig& aig = cone_->circuit().aig();
  if (const auto grown = grown_.find(id); grown != grown_.end()) {
    stretched_[id] = grown_word(grown->second);
    plain_.insert(id);
  } else if (e.op == ExprOp::Variable) {
    const Variable& var = ts.vars[e.var];
    if (var.role != VarRole::State || !ts.states[var.state].clock) return;
    // What it is before the last scan lies between these two, and comparisons
    // with it are watched from the first scan to the later of them.
    const ExprId running = ts.states[var.state].running;
    const AigLit runs = cone_->circuit().has(running)
                            ? cone_->circuit().bit(running)
                            : kAigTrue;
    stretched_[id] = word_choose(aig, runs, grown_word(var.state),
                                 cone_->circuit().next(var.state));
    plain_.insert(id);
  } else if (e.op == ExprOp::Equal || e.op == ExprOp::Less) {
    if (depends(e.a) || depends(e.b)) compare(id, e);
  } else if (e.type == Type::Word) {
    const Operands under = operands(e);
    const bool any =
        std::any_of(under.ids, under.ids + under.count,
                    [&](ExprId operand) { return depends(operand); });
    if (any) stretched_[id] = stretched_word(e);
    if (e.op == ExprOp::Ite && is_plain(e.b) && is_plain(e.c)) {
      plain_.insert(id);
    }
  }
}

/// Is it a word that stands still, or that grows as clocks do?
bool JumpCircuit::is_plain(ExprId id) const {
  return !depends(id) || plain_.count(id) != 0;
}

void JumpCircuit::compare(ExprId id, const Expr& e) {
  exact_ = exact_ && is_plain(e.a) && is_plain(e.b);
  StepCircuit& circuit = cone_->circuit();
  Aig& aig = circuit.aig();
  const auto keep = [&](AigLit before, AigLit after) {
    same_ = aig.conjunction(same_, aig_not(aig.exclusive_or(before, after)));
  };
  const Word& a = stretched(e.a);
  const Word& b = stretched(e.b);
  keep(word_less(aig, circuit.word(e.a), circuit.word(e.b)),
       word_less(aig, a, b));
  if (e.op == ExprOp::Equal) {  // true for one instant only: watch both sides
    keep(circuit.bit(id), word_equal(aig, a, b));
  }
}

Word JumpCircuit::stretched_word(const Expr& e) {
  Aig& aig = cone_->circuit().aig();
  switch (e.op) {
    case ExprOp::Add:
      return word_add(aig, stretched(e.a), stretched(e.b));
    case ExprOp::Multiply:
      return word_multiply(aig, stretched(e.a), stretched(e.b));
    case ExprOp::Divide:
      return word_divide(aig, stretched(e.a), cone_->ts().exprs[e.b].value);
    case ExprOp::Wrap16:
      return word_resize(stretched(e.a), 16);
    case ExprOp::Ite:
      // The condition is as in the first scan: no comparison under it flips.
      return word_choose(aig, cone_->circuit().bit(e.a), stretched(e.b),
                         stretched(e.c));
    case ExprOp::Constant:
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

void JumpCircuit::finish() {
  StepCircuit& circuit = cone_->circuit();
  Aig& aig = circuit.aig();
  const TransitionSystem& ts = cone_->ts();
  AigLit quiet = same_;
  bits_.clear();
  for (std::uint32_t state : cone_->states()) {
    const Word leaves = circuit.leaves(ts.states[state].var);
    const Word next = circuit.next(state);
    const Word later = word_resize(stretched(ts.states[state].next),
                                   static_cast<std::uint32_t>(leaves.size()));
    if (ts.states[state].clock) {
      append_bits(circuit, state, leaves,
                  word_resize(word_choose(aig, taken_, later, next),
                              static_cast<std::uint32_t>(leaves.size())),
                  bits_);
      continue;
    }
    quiet = aig.conjunction(quiet, word_equal(aig, leaves, next));
    quiet = aig.conjunction(quiet, word_equal(aig, next, later));
    append_bits(circuit, state, leaves, next, bits_);
  }
  allowed_ = aig.implication(taken_, aig.conjunction(allowed_, quiet));
}

}  // namespace rung
