#include "analysis/rules/sampled_runs.h"

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace rung {
namespace {

using Bits = SampledRuns::Bits;
using Words = SampledRuns::Words;
constexpr std::size_t kLanes = SampledRuns::kLanes;

std::int64_t wrap16(std::int64_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint64_t>(value) & 0xffff);
}

template <class Operation>
void each_lane(const Words& a, const Words& b, Words& out,
               Operation operation) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    out[lane] = operation(a[lane], b[lane]);
  }
}

template <class Relation>
Bits lanes_where(const Words& a, const Words& b, Relation holds) {
  Bits result = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    result |= Bits{holds(a[lane], b[lane])} << lane;
  }
  return result;
}

}  // namespace

SampledRuns::SampledRuns(const TransitionSystem& ts,
                         const std::vector<ExprId>& observed)
    : ts_(ts), slot_(ts.exprs.size(), 0), needed_(ts.exprs.size()) {
  mark_needed(observed);
  std::uint32_t words = 0;
  for (std::size_t i = 0; i < ts.exprs.size(); ++i) {
    if (!needed_[i]) continue;
    if (expr(i).type == Type::Word) slot_[i] = words++;
    if (expr(i).op != ExprOp::Variable) {
      order_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  cost_ = ts.exprs.size() + kLanes * words;
}

void SampledRuns::mark_needed(const std::vector<ExprId>& observed) {
  for (const ExprId id : observed) needed_[id.index()] = true;
  for (const ExprId id : ts_.constraints) needed_[id.index()] = true;
  for (const State& state : ts_.states) {
    needed_[state.next.index()] = true;
    needed_[ts_.of(state.var).index()] = true;
  }
  for (std::size_t i = needed_.size(); i-- > 0;) {
    if (!needed_[i]) continue;
    for (const ExprId operand : {expr(i).a, expr(i).b, expr(i).c}) {
      if (operand.has_value()) needed_[operand.index()] = true;
    }
  }
}

void SampledRuns::start() {
  bits_.assign(ts_.exprs.size(), 0);
  habits_.resize(ts_.exprs.size());
  words_.resize((cost_ - bits_.size()) / kLanes);
  collect_constants();
  reset();
}

/// Values at which a comparison may change: inputs are drawn from them too.
void SampledRuns::collect_constants() {
  for (std::size_t i = 0; i < needed_.size(); ++i) {
    const Expr& it = expr(i);
    if (!needed_[i] || it.op != ExprOp::Constant || it.type == Type::Bit) {
      continue;
    }
    for (std::int64_t near = -1; near <= 1; ++near) {
      constants_.push_back(it.value + near);
    }
    if (constants_.size() > 1000) return;
  }
}

void SampledRuns::reset() {
  for (const State& state : ts_.states) {
    const ExprId var = ts_.of(state.var);
    if (is_word(state)) {
      words_of(var).fill(state.init);
    } else {
      bits_[var.index()] = state.init != 0 ? ~Bits{0} : 0;
    }
  }
  for (const Variable& var : ts_.vars) {
    if (var.role != VarRole::Input || !needed_[var.expr.index()]) continue;
    if (var.type == Type::Bit) {
      bits_[var.expr.index()] = random_();
    } else {
      choose_words(var, ~Bits{0});
    }
  }
}

/// In a quarter of the lanes an input rests true, in a quarter false, and only
/// pulses: sequences go on for long when their resets are left alone.
void SampledRuns::choose_habits() {
  for (const Variable& var : ts_.vars) {
    if (var.role != VarRole::Input || var.type != Type::Bit) continue;
    habits_[var.expr.index()] = {random_(), random_()};
  }
}

void SampledRuns::choose_inputs() {
  if (chosen_++ % kHabit == 0) choose_habits();
  const Bits fast = random_() & 0xffff;
  const Bits slow = random_() & random_() & random_();
  for (const Variable& var : ts_.vars) {
    const std::size_t at = var.expr.index();
    if (!needed_[at]) continue;
    if (var.role == VarRole::Dt) choose_dt();
    if (var.role == VarRole::Choice) bits_[at] = ~Bits{0};
    if (var.role != VarRole::Input) continue;
    const Bits change = (random_() & fast) | (random_() & slow & 0xffff'0000) |
                        (random_() & slow & random_() & random_());
    if (var.type == Type::Word) {
      choose_words(var, change);
      continue;
    }
    const Habit& habit = habits_[at];
    const Bits pulse = change & random_() & random_();
    bits_[at] = (habit.rests & (habit.value ^ pulse)) |
                (~habit.rests & (bits_[at] ^ change));
  }
}

void SampledRuns::choose_words(const Variable& var, Bits change) {
  Words& words = words_of(var.expr);
  const auto span = static_cast<std::uint64_t>(var.high - var.low) + 1;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if ((change >> lane & 1) == 0) continue;
    const std::uint64_t draw = random_();
    std::int64_t value =
        var.low + static_cast<std::int64_t>((draw >> 8) % span);
    if ((draw & 3) != 0 && !constants_.empty()) {
      const std::int64_t near = constants_[(draw >> 8) % constants_.size()];
      if (near >= var.low && near <= var.high) value = near;
    }
    words[lane] = value;
  }
}

/// Half of the runs take the longest scans, so that timers come to an end.
void SampledRuns::choose_dt() {
  Words& words = words_of(ts_.of(ts_.dt));
  const auto span =
      static_cast<std::uint64_t>(ts_.scan.max_ms - ts_.scan.min_ms) + 1;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    words[lane] =
        lane % 2 == 0
            ? ts_.scan.max_ms
            : ts_.scan.min_ms + static_cast<std::int64_t>(random_() % span);
  }
}

void SampledRuns::freeze() {
  if (needed(ts_.of(ts_.dt))) words_of(ts_.of(ts_.dt)).fill(0);
}

Bits SampledRuns::evaluate() {
  for (const std::uint32_t i : order_) compute(expr(i), i);
  Bits valid = ~Bits{0};
  for (const ExprId constraint : ts_.constraints) valid &= bits(constraint);
  return valid;
}

void SampledRuns::compute(const Expr& it, std::size_t i) {
  if (it.type == Type::Word) {
    compute_words(it, words_[slot_[i]]);
  } else {
    bits_[i] = compute_bits(it);
  }
}

Bits SampledRuns::compute_bits(const Expr& it) const {
  switch (it.op) {
    case ExprOp::Constant:
      return it.value != 0 ? ~Bits{0} : 0;
    case ExprOp::Not:
      return ~bits(it.a);
    case ExprOp::And:
      return bits(it.a) & bits(it.b);
    case ExprOp::Xor:
      return bits(it.a) ^ bits(it.b);
    case ExprOp::Ite:
      return (bits(it.a) & bits(it.b)) | (~bits(it.a) & bits(it.c));
    case ExprOp::Equal:
    case ExprOp::Less:
      return compare(it);
    case ExprOp::Variable:
    case ExprOp::Add:
    case ExprOp::Multiply:
    case ExprOp::Divide:
    case ExprOp::Wrap16:
      break;
  }
  return 0;
}

Bits SampledRuns::compare(const Expr& it) const {
  const Words& a = words_of(it.a);
  const Words& b = words_of(it.b);
  if (it.op == ExprOp::Less) return lanes_where(a, b, std::less<>());
  return lanes_where(a, b, std::equal_to<>());
}

void SampledRuns::compute_words(const Expr& it, Words& out) const {
  if (it.op == ExprOp::Constant) return out.fill(it.value);
  if (it.op == ExprOp::Ite) {
    const Bits condition = bits(it.a);
    const Words& then = words_of(it.b);
    const Words& otherwise = words_of(it.c);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      out[lane] = (condition >> lane & 1) != 0 ? then[lane] : otherwise[lane];
    }
    return;
  }
  const Words& a = words_of(it.a);
  const Words& b = it.b.has_value() ? words_of(it.b) : a;
  // Terms stay within 62 bits (ExprArena); a product that could leave them was
  // clamped by the builder.
  if (it.op == ExprOp::Add) {
    each_lane(a, b, out, std::plus<>());
  } else if (it.op == ExprOp::Multiply) {
    each_lane(a, b, out, std::multiplies<>());
  } else if (it.op == ExprOp::Divide) {
    each_lane(a, b, out, [](std::int64_t left, std::int64_t right) {
      return right == 0 ? 0 : left / right;
    });
  } else {
    each_lane(a, a, out,
              [](std::int64_t left, std::int64_t) { return wrap16(left); });
  }
}

void SampledRuns::advance(Bits valid) {
  next_bits_.clear();
  next_words_.clear();
  for (const State& state : ts_.states) {
    if (is_word(state)) {
      next_words_.push_back(words_of(state.next));
    } else {
      next_bits_.push_back(bits(state.next));
    }
  }
  std::size_t bit = 0;
  std::size_t word = 0;
  for (const State& state : ts_.states) {
    const ExprId var = ts_.of(state.var);
    if (!is_word(state)) {
      Bits& now = bits_[var.index()];
      now = (now & ~valid) | (next_bits_[bit++] & valid);
      continue;
    }
    Words& now = words_of(var);
    const Words& value = next_words_[word++];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((valid >> lane & 1) == 0) continue;
      now[lane] = value[lane] + skipped_[lane] * (value[lane] - now[lane]);
    }
  }
  skipped_.fill(0);
}

std::int64_t SampledRuns::value(ExprId id, std::size_t lane) const {
  if (ts_.exprs[id].type == Type::Bit) {
    return static_cast<std::int64_t>(bits(id) >> lane & 1);
  }
  return words_of(id)[lane];
}

/// Lanes in which the last two scans differ in nothing but words that grow by
/// the same in each scan: then all terms go on so until a comparison changes.
/// (Under fixed bits every word but products and the like is affine in the
/// words of the state.)
Bits SampledRuns::unmoved() const {
  Bits same = ~Bits{0};
  for (const std::uint32_t i : order_) {
    const Expr& it = expr(i);
    if (it.type == Type::Bit) {
      same &= ~(bits_[i] ^ earlier_bits_[i]);
    } else if (it.op == ExprOp::Multiply || it.op == ExprOp::Divide ||
               it.op == ExprOp::Wrap16) {
      same &= lanes_where(words_[slot_[i]], earlier_words_[slot_[i]],
                          std::equal_to<>());
    }
  }
  for (const State& state : ts_.states) {
    const ExprId var = ts_.of(state.var);
    if (!is_word(state)) {
      same &= ~(bits(state.next) ^ bits(var)) &
              ~(bits(var) ^ earlier_bits_[var.index()]);
      continue;
    }
    const Words& first = earlier_words_[slot_[var.index()]];
    const Words& second = words_of(var);
    const Words& third = words_of(state.next);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (third[lane] - second[lane] != second[lane] - first[lane]) {
        same &= ~(Bits{1} << lane);
      }
    }
  }
  return same;
}

/// After how many scans more, at the earliest, does the comparison change?
void SampledRuns::limit_skip(const Expr& comparison) {
  const Words& a = words_of(comparison.a);
  const Words& b = words_of(comparison.b);
  const Words& a_before = earlier_words_[slot_[comparison.a.index()]];
  const Words& b_before = earlier_words_[slot_[comparison.b.index()]];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::int64_t gap = b[lane] - a[lane];
    const std::int64_t speed = gap - (b_before[lane] - a_before[lane]);
    if (speed == 0 || (gap > 0 && speed > 0) || (gap < 0 && speed < 0)) {
      continue;
    }
    // Less holds while the gap is positive, Equal while it is 0; one scan less
    // than would be possible does no harm.
    const std::int64_t left = std::abs(gap) / std::abs(speed) - 1;
    skipped_[lane] = std::min(skipped_[lane], std::max<std::int64_t>(left, 0));
  }
}

Bits SampledRuns::hold(Bits valid) {
  earlier_bits_ = bits_;
  earlier_words_ = words_;
  advance(valid);
  const Bits again = evaluate();
  const Bits alike = valid & again & unmoved();
  constexpr std::int64_t kMostScans = 10'000'000;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    skipped_[lane] = (alike >> lane & 1) != 0 ? kMostScans : 0;
  }
  for (const std::uint32_t i : order_) {
    const Expr& it = expr(i);
    if (it.op == ExprOp::Less || it.op == ExprOp::Equal) limit_skip(it);
  }
  return again;
}

}  // namespace rung
