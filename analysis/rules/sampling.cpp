#include "analysis/rules/sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <random>
#include <utility>

namespace rung {
namespace {

constexpr std::size_t kLanes = 64;
using Bits = std::uint64_t;  // one run a bit
using Words = std::array<std::int64_t, kLanes>;

std::int64_t wrap16(std::int64_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint64_t>(value) & 0xffff);
}

/// 64 runs of a transition system side by side.
class Runs {
 public:
  Runs(const TransitionSystem& ts, const std::vector<ExprId>& observed)
      : ts_(ts), slot_(ts.exprs.size(), 0), needed_(ts.exprs.size()) {
    mark_needed(observed);
    std::uint32_t words = 0;
    for (std::size_t i = 0; i < ts.exprs.size(); ++i) {
      if (needed_[i] && expr(i).type == Type::Word) slot_[i] = words++;
    }
    cost_ = ts.exprs.size() + kLanes * words;
  }

  /// How many scans `work` allows.
  std::uint64_t scans_for(std::uint64_t work) const { return work / cost_; }

  /// Before the first scan.
  void start() {
    bits_.resize(ts_.exprs.size());
    words_.resize((cost_ - bits_.size()) / kLanes);
    collect_constants();
    reset();
  }

  void choose_inputs() {
    const Bits fast = random_() & 0xffff;
    const Bits slow = random_() & random_() & random_();
    for (const VarId id : ids_of(ts_.vars)) {
      const Variable& var = ts_.vars[id];
      if (!needed_[var.expr.index()]) continue;
      if (var.role == VarRole::Dt) choose_dt();
      if (var.role == VarRole::Choice) bits_[var.expr.index()] = ~Bits{0};
      if (var.role != VarRole::Input) continue;
      const Bits change = (random_() & fast) |
                          (random_() & slow & 0xffff'0000) |
                          (random_() & slow & random_() & random_());
      if (var.type == Type::Bit) {
        bits_[var.expr.index()] ^= change;
      } else {
        choose_words(var, change);
      }
    }
  }

  /// No time passes.
  void freeze() {
    const std::size_t dt = ts_.of(ts_.dt).index();
    if (needed_[dt]) words_[slot_[dt]].fill(0);
  }

  /// Computes one scan; the lanes whose inputs meet the assumptions.
  Bits evaluate() {
    for (std::size_t i = 0; i < bits_.size(); ++i) {
      if (needed_[i]) compute(i);
    }
    Bits valid = ~Bits{0};
    for (const ExprId constraint : ts_.constraints) {
      valid &= bits_[constraint.index()];
    }
    return valid;
  }

  /// The values at the scan's end become the state, in the lanes of `valid`.
  void advance(Bits valid) {
    next_bits_.clear();
    next_words_.clear();
    for (const State& state : ts_.states) {
      if (is_word(state)) {
        next_words_.push_back(words_[slot_[state.next.index()]]);
      } else {
        next_bits_.push_back(bits_[state.next.index()]);
      }
    }
    std::size_t bit = 0;
    std::size_t word = 0;
    for (const State& state : ts_.states) {
      const std::size_t var = ts_.of(state.var).index();
      if (!is_word(state)) {
        const Bits value = next_bits_[bit++];
        bits_[var] = (bits_[var] & ~valid) | (value & valid);
        continue;
      }
      Words& now = words_[slot_[var]];
      const Words& value = next_words_[word++];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if ((valid >> lane & 1) != 0) now[lane] = value[lane];
      }
    }
  }

  Bits bits(ExprId id) const { return bits_[id.index()]; }

  std::int64_t value(ExprId id, std::size_t lane) const {
    if (ts_.exprs[id].type == Type::Bit) {
      return static_cast<std::int64_t>(bits_[id.index()] >> lane & 1);
    }
    return words_[slot_[id.index()]][lane];
  }

  bool needed(ExprId id) const { return needed_[id.index()]; }

 private:
  const Expr& expr(std::size_t index) const {
    return ts_.exprs[ExprId(static_cast<std::uint32_t>(index))];
  }

  bool is_word(const State& state) const {
    return ts_.vars[state.var].type == Type::Word;
  }

  void mark_needed(const std::vector<ExprId>& observed) {
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

  /// Values at which a comparison may change: inputs are drawn from them too.
  void collect_constants() {
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

  void reset() {
    for (const State& state : ts_.states) {
      const std::size_t var = ts_.of(state.var).index();
      if (is_word(state)) {
        words_[slot_[var]].fill(state.init);
      } else {
        bits_[var] = state.init != 0 ? ~Bits{0} : 0;
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

  void choose_words(const Variable& var, Bits change) {
    Words& words = words_[slot_[var.expr.index()]];
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
  void choose_dt() {
    Words& words = words_[slot_[ts_.of(ts_.dt).index()]];
    const auto span =
        static_cast<std::uint64_t>(ts_.scan.max_ms - ts_.scan.min_ms) + 1;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      words[lane] =
          lane % 2 == 0
              ? ts_.scan.max_ms
              : ts_.scan.min_ms + static_cast<std::int64_t>(random_() % span);
    }
  }

  void compute(std::size_t i) {
    const Expr& it = expr(i);
    if (it.op == ExprOp::Variable) return;
    if (it.type == Type::Word) {
      compute_words(it, words_[slot_[i]]);
    } else {
      bits_[i] = compute_bits(it);
    }
  }

  Bits compute_bits(const Expr& it) const {
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

  Bits compare(const Expr& it) const {
    const Words& a = words_[slot_[it.a.index()]];
    const Words& b = words_[slot_[it.b.index()]];
    Bits result = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const bool holds =
          it.op == ExprOp::Less ? a[lane] < b[lane] : a[lane] == b[lane];
      result |= Bits{holds} << lane;
    }
    return result;
  }

  void compute_words(const Expr& it, Words& out) const {
    if (it.op == ExprOp::Constant) return out.fill(it.value);
    const Words& second = words_[slot_[it.b.has_value() ? it.b.index() : 0]];
    if (it.op == ExprOp::Ite) {
      const Bits condition = bits(it.a);
      const Words& third = words_[slot_[it.c.index()]];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        out[lane] = (condition >> lane & 1) != 0 ? second[lane] : third[lane];
      }
      return;
    }
    const Words& first = words_[slot_[it.a.index()]];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      out[lane] = arithmetic(it.op, first[lane], second[lane]);
    }
  }

  static std::int64_t arithmetic(ExprOp op, std::int64_t a, std::int64_t b) {
    // Terms stay within 62 bits (ExprArena); a product that could leave them
    // was clamped by the builder.
    if (op == ExprOp::Add) return a + b;
    if (op == ExprOp::Multiply) return a * b;
    if (op == ExprOp::Divide) return b == 0 ? 0 : a / b;
    return wrap16(a);
  }

  const TransitionSystem& ts_;
  std::uint64_t cost_ = 1;  // of a scan, about
  std::mt19937_64 random_{20200712};
  std::vector<std::uint32_t> slot_;
  std::vector<bool> needed_;
  std::vector<Bits> bits_;
  std::vector<Words> words_;
  std::vector<std::int64_t> constants_;
  std::vector<Bits> next_bits_;
  std::vector<Words> next_words_;
};

constexpr std::uint64_t kMostScans = 400;

}  // namespace

std::vector<bool> sample(const TransitionSystem& ts,
                         const std::vector<ExprId>& conditions,
                         std::uint64_t work) {
  std::vector<bool> refuted(conditions.size());
  Runs runs(ts, conditions);
  const std::uint64_t scans = std::min(runs.scans_for(work), kMostScans);
  if (scans == 0) return refuted;
  runs.start();
  for (std::uint64_t scan = 0; scan < scans; ++scan) {
    runs.choose_inputs();
    const Bits valid = runs.evaluate();
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      if ((~runs.bits(conditions[i]) & valid) != 0) refuted[i] = true;
    }
    runs.advance(valid);
  }
  return refuted;
}

namespace {

/// By cell, the lanes in which it changed while nothing else did.
struct Restless {
  /// In every quarter of the scans: what only runs out, as a counter does when
  /// it comes to its end, is at rest later.
  std::vector<Bits> again_and_again;
  std::vector<Bits> every_scan;
};

Restless restless(const TransitionSystem& ts, Runs runs) {
  constexpr std::uint32_t kQuarter = kRestScans / 4;
  const std::size_t cells = ts.cell_end.size();
  Restless found = {std::vector<Bits>(cells, ~Bits{0}),
                    std::vector<Bits>(cells, ~Bits{0})};
  std::vector<Bits> changed(cells, 0);
  runs.freeze();
  for (std::uint32_t scan = 1; scan <= 2 * kRestScans; ++scan) {
    const Bits valid = runs.evaluate();
    for (std::size_t i = 0; i < cells; ++i) {
      if (ts.exprs[ts.cell_end[i]].type == Type::Word) continue;
      const Bits change =
          (runs.bits(ts.cell_end[i]) ^ runs.bits(ts.cell_begin[i])) & valid;
      changed[i] |= change;
      if (scan > kRestScans) found.every_scan[i] &= change;
    }
    runs.advance(valid);
    if (scan % kQuarter != 0) continue;
    for (std::size_t i = 0; i < cells; ++i) {
      if (scan > kRestScans) found.again_and_again[i] &= changed[i];
    }
    changed.assign(cells, 0);
  }
  return found;
}

Unrest describe(const TransitionSystem& ts, const Runs& runs, CellId cell,
                Bits lanes) {
  Unrest unrest{cell, {}, false};
  const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
  for (const Variable& var : ts.vars) {
    if (var.role != VarRole::Input || !runs.needed(var.expr)) continue;
    unrest.held.emplace_back(var.cell, runs.value(var.expr, lane));
  }
  return unrest;
}

}  // namespace

std::vector<Unrest> sample_unrest(const TransitionSystem& ts,
                                  std::uint64_t work) {
  std::vector<ExprId> observed = ts.cell_end;
  observed.insert(observed.end(), ts.cell_begin.begin(), ts.cell_begin.end());
  Runs runs(ts, observed);
  const std::uint64_t affordable =
      std::min(runs.scans_for(work), kMostScans / 2);
  if (affordable <= std::uint64_t{2} * kRestScans) return {};
  runs.start();
  std::vector<Unrest> found;
  std::vector<bool> seen(ts.cell_end.size());
  std::uint64_t scans = 0;
  for (std::uint64_t next_look = 1;
       scans + std::uint64_t{2} * kRestScans <= affordable; next_look *= 2) {
    for (std::uint64_t i = 0; i < next_look; ++i, ++scans) {
      runs.choose_inputs();
      runs.advance(runs.evaluate());
    }
    const Restless lanes = restless(ts, runs);
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      if (lanes.again_and_again[i] == 0 || seen[i]) continue;
      seen[i] = true;
      const bool flickers = lanes.every_scan[i] != 0;
      found.push_back(
          describe(ts, runs, CellId(i),
                   flickers ? lanes.every_scan[i] : lanes.again_and_again[i]));
      found.back().every_scan = flickers;
    }
    scans += std::uint64_t{2} * kRestScans;
  }
  return found;
}

}  // namespace rung
