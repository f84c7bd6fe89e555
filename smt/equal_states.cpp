#include "smt/equal_states.h"

#include <algorithm>
#include <functional>
#include <map>
#include <unordered_map>
#include <utility>

#include "smt/cone.h"

namespace rung {
namespace {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): the same runs everywhere.
class Random {
 public:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    const auto span = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<std::int64_t>(next() % span);
  }
  bool one_in(std::uint64_t n) { return next() % n == 0; }

 private:
  std::uint64_t state_ = 1;
};

/// Executes terms scan by scan. What it says is only a guess to be proved:
/// so it may let more time pass in a scan than one takes.
class Runs {
 public:
  Runs(const TransitionSystem& ts, const std::vector<bool>& in_cone)
      : ts_(ts), in_cone_(in_cone), value_(ts.exprs.size(), 0) {
    for (const State& state : ts.states) {
      longest_ = std::max(longest_, state.cap);
    }
    for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
      const Expr& e = ts.exprs[ExprId(i)];
      if (e.op == ExprOp::Constant) value_[i] = e.value;
      if (e.op != ExprOp::Constant && e.op != ExprOp::Variable) {
        terms_.push_back(ExprId(i));
      }
    }
  }

  std::size_t size() const { return terms_.size(); }
  std::int64_t state(std::uint32_t i) const {
    return value_[ts_.state_expr(i).index()];
  }

  void reset() {
    for (const State& state : ts_.states) {
      value_[ts_.of(state.var).index()] = state.init;
    }
  }
  /// New values for about one in `hold` inputs; all of them when it is 1.
  void draw_inputs(Random& random, std::uint64_t hold) {
    for (const Variable& variable : ts_.vars) {
      if (variable.role == VarRole::State || !random.one_in(hold)) continue;
      value_[variable.expr.index()] =
          random.one_in(3) ? variable.high
                           : random.between(variable.low, variable.high);
    }
    std::int64_t& dt = value_[ts_.of(ts_.dt).index()];
    dt = random.one_in(2)
             ? random.between(ts_.scan.min_ms, ts_.scan.max_ms)
             : random.between(1, longest_ >> random.between(0, 12));
    // Where all scans take the same time, elapsed times are multiples of it.
    const std::int64_t fixed = ts_.scan.min_ms;
    if (fixed == ts_.scan.max_ms) dt = (dt + fixed - 1) / fixed * fixed;
  }
  void scan() {
    for (const ExprId id : terms_) value_[id.index()] = evaluate(id);
    next_.clear();
    for (const State& state : ts_.states) {
      next_.push_back(value_[state.next.index()]);
    }
    for (std::size_t i = 0; i < next_.size(); ++i) {
      if (!in_cone_[ts_.states[i].var.index()]) continue;
      value_[ts_.of(ts_.states[i].var).index()] = next_[i];
    }
  }

 private:
  std::int64_t evaluate(ExprId id) const {
    const Expr& e = ts_.exprs[id];
    const auto of = [&](ExprId operand) { return value_[operand.index()]; };
    switch (e.op) {
      case ExprOp::Constant:
      case ExprOp::Variable:
        break;
      case ExprOp::Not:
        return 1 - of(e.a);
      case ExprOp::And:
        return of(e.a) & of(e.b);
      case ExprOp::Xor:
        return of(e.a) ^ of(e.b);
      case ExprOp::Equal:
        return of(e.a) == of(e.b) ? 1 : 0;
      case ExprOp::Less:
        return of(e.a) < of(e.b) ? 1 : 0;
      case ExprOp::Add:
        return wrapping(of(e.a), of(e.b), std::plus<>());
      case ExprOp::Multiply:
        return wrapping(of(e.a), of(e.b), std::multiplies<>());
      case ExprOp::Divide:
        return of(e.a) / of(e.b);
      case ExprOp::Wrap16:
        return static_cast<std::int16_t>(of(e.a) & 0xffff);
      case ExprOp::Ite:
        return of(e.a) != 0 ? of(e.b) : of(e.c);
    }
    return of(id);
  }

  template <class Op>
  static std::int64_t wrapping(std::int64_t a, std::int64_t b, Op op) {
    return static_cast<std::int64_t>(
        op(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b)));
  }

  const TransitionSystem& ts_;
  const std::vector<bool>& in_cone_;
  std::vector<std::int64_t> value_;  // by term
  std::vector<ExprId> terms_;        // to be evaluated, operands first
  std::vector<std::int64_t> next_;
  std::int64_t longest_ = 1 << 12;
};

/// A fingerprint of each state's values in some random runs: states that are
/// always equal have equal ones. Runs are from power-up, inputs held for a
/// while.
std::vector<std::uint64_t> fingerprints(const Product& product,
                                        const std::vector<bool>& in_cone) {
  constexpr std::size_t kWork = 8'000'000;
  constexpr std::size_t kRun = 64;
  const TransitionSystem& ts = product.ts;
  Runs runs(ts, in_cone);
  const std::size_t scans =
      std::clamp<std::size_t>(kWork / (runs.size() + 1), kRun, 60 * kRun);
  Random random;
  std::vector<std::uint64_t> prints(ts.states.size(), 0);
  for (std::size_t scan = 0; scan < scans; ++scan) {
    const bool first = scan % kRun == 0;
    if (first) runs.reset();
    runs.draw_inputs(random, first ? 1 : 2U << (2 * (scan / kRun % 3)));
    runs.scan();
    for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
      const auto value = static_cast<std::uint64_t>(runs.state(i));
      prints[i] = (prints[i] ^ value) * 0x9e3779b97f4a7c15U;
      prints[i] ^= prints[i] >> 32U;
    }
  }
  return prints;
}

/// Pairs with equal fingerprints: those of `by_name` first, then others, a few
/// for each state.
class CandidatePairs {
 public:
  CandidatePairs(const TransitionSystem& a, const TransitionSystem& b,
                 const Product& product)
      : a_(a),
        b_(b),
        product_(product),
        in_cone_(cone_of_influence(product.ts, product.same)),
        prints_(fingerprints(product, in_cone_)) {}

  EqualGuesses find(const std::vector<StatePair>& by_name) {
    std::vector<bool> named(b_.states.size(), false);
    for (const StatePair& pair : by_name) {
      if (!may_be_equal(pair)) continue;
      guesses_.likely.push_back(pair);
      named[pair.b] = true;
    }
    const std::vector<Part> parts_a = parts_of(a_);
    const std::vector<Part> parts_b = parts_of(b_);
    for (std::uint32_t i = 0; i < a_.states.size(); ++i) {
      if (!in_cone(product_.state_a[i])) continue;
      const std::uint64_t print = prints_[product_.state_a[i]];
      alike_[{print, kAnyPart}].push_back(i);
      alike_[{print, parts_a[i]}].push_back(i);
    }
    std::map<Class, std::size_t> rank;
    for (std::uint32_t i = 0; i < b_.states.size(); ++i) {
      if (!in_cone(product_.state_b[i])) continue;
      const Class of_b{prints_[product_.state_b[i]], parts_b[i]};
      const std::size_t at = rank[of_b]++;
      if (!named[i]) add_alike(i, of_b, at);
    }
    return std::move(guesses_);
  }

 private:
  bool in_cone(std::uint32_t state) const {
    return in_cone_[product_.ts.states[state].var.index()];
  }

  bool may_be_equal(const StatePair& pair) const {
    const std::uint32_t first = product_.state_a[pair.a];
    const std::uint32_t second = product_.state_b[pair.b];
    return in_cone(first) && in_cone(second) &&
           prints_[first] == prints_[second] &&
           a_.states[pair.a].init == b_.states[pair.b].init &&
           a_.vars[a_.states[pair.a].var].type ==
               b_.vars[b_.states[pair.b].var].type;
  }

  /// What a state is: that of a cell, or which one of an element. A coil and
  /// the memory of the timer that it drives are often equal.
  using Part = std::pair<std::size_t, std::size_t>;
  using Class = std::pair<std::uint64_t, Part>;  // with the fingerprint
  static constexpr Part kAnyPart = {0, 1};

  static std::vector<Part> parts_of(const TransitionSystem& ts) {
    std::vector<Part> parts(ts.states.size(), {0, 0});
    for (const std::vector<std::uint32_t>& states : ts.instance_states) {
      for (std::size_t i = 0; i < states.size(); ++i) {
        parts[states[i]] = {states.size(), i};
      }
    }
    return parts;
  }

  /// Those that are the same part first, and of them the one at the same place:
  /// programs that are alike mostly name their states in one order.
  void add_alike(std::uint32_t of_b, const Class& of, std::size_t rank) {
    constexpr std::size_t kMost = 4;  // classes of idle states may be large
    std::vector<std::uint32_t> chosen;
    const auto choose = [&](const Class& from, std::size_t begin) {
      const auto found = alike_.find(from);
      if (found == alike_.end()) return;
      const std::vector<std::uint32_t>& all = found->second;
      for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) {
        const std::uint32_t candidate = all[(begin + i) % all.size()];
        const bool is_new =
            std::find(chosen.begin(), chosen.end(), candidate) == chosen.end();
        if (is_new && chosen.size() < kMost) chosen.push_back(candidate);
      }
    };
    choose(of, rank);
    choose({of.first, kAnyPart}, rank);
    bool first = true;
    for (const std::uint32_t candidate : chosen) {
      const StatePair pair{candidate, of_b};
      if (!may_be_equal(pair)) continue;
      (first ? guesses_.likely : guesses_.more).push_back(pair);
      first = false;
    }
  }

  const TransitionSystem& a_;
  const TransitionSystem& b_;
  const Product& product_;
  std::vector<bool> in_cone_;
  std::vector<std::uint64_t> prints_;
  std::map<Class, std::vector<std::uint32_t>> alike_;  // states of the first
  EqualGuesses guesses_;
};

}  // namespace

EqualGuesses guess_equal_states(const TransitionSystem& a,
                                const TransitionSystem& b,
                                const Product& product,
                                const std::vector<StatePair>& by_name) {
  return CandidatePairs(a, b, product).find(by_name);
}

EqualStates find_equal_states(Product& product,
                              const std::vector<StatePair>& guesses,
                              const std::vector<ExprId>& lemmas,
                              const Deadline& deadline) {
  constexpr std::int64_t kConflicts = 50'000;
  EqualStates result;
  result.lemma_holds.assign(lemmas.size(), false);
  std::vector<StatePair> pairs;
  std::vector<ExprId> roots = product.same;
  for (const StatePair& pair : guesses) {
    const ExprId equal =
        product.ts.exprs.equal(product.ts.state_expr(product.state_a[pair.a]),
                               product.ts.state_expr(product.state_b[pair.b]));
    if (product.ts.exprs.is_true(equal)) continue;  // merged already
    pairs.push_back(pair);
    roots.push_back(equal);
  }
  roots.insert(roots.end(), lemmas.begin(), lemmas.end());
  Cone cone(product.ts, roots);
  if (cone.circuit().overflow()) return result;
  Candidates candidates;
  const auto middle =
      cone.roots().begin() + static_cast<std::ptrdiff_t>(product.same.size());
  candidates.conditions.assign(cone.roots().begin(), middle);
  candidates.lemmas.assign(middle, cone.roots().end());
  if (!prove_by_induction(cone, {}, 0, candidates, kConflicts, deadline)) {
    return result;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (candidates.lemma_holds[i]) result.pairs.push_back(pairs[i]);
  }
  for (std::size_t i = 0; i < lemmas.size(); ++i) {
    result.lemma_holds[i] = candidates.lemma_holds[pairs.size() + i];
  }
  result.all_outputs = std::all_of(candidates.condition_holds.begin(),
                                   candidates.condition_holds.end(),
                                   [](bool holds) { return holds; });
  return result;
}

}  // namespace rung
