#include "smt/equal_states.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "smt/cone.h"
#include "smt/interpret.h"

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

/// A fingerprint of each state's values in some random runs: states that are
/// always equal have equal ones. Runs are from power-up, inputs held for a
/// while, scans short or long, so that timers fire.
std::vector<std::uint64_t> fingerprints(const Product& product,
                                        const std::vector<bool>& in_cone) {
  constexpr std::size_t kWork = 4'000'000;
  constexpr std::size_t kRun = 64;
  const TransitionSystem& ts = product.ts;
  Interpreter terms(ts, product.same);
  const std::size_t scans =
      std::clamp<std::size_t>(kWork / (ts.exprs.size() + 1), kRun, 40 * kRun);
  Random random;
  std::vector<std::uint64_t> prints(ts.states.size(), 0);
  std::uint64_t hold = 2;
  for (std::size_t scan = 0; scan < scans; ++scan) {
    if (scan % kRun == 0) {
      terms.reset();
      hold = std::uint64_t{2} << (2 * (scan / kRun % 3));
    }
    for (const VarId id : ids_of(ts.vars)) {
      const Variable& variable = ts.vars[id];
      if (variable.role == VarRole::State || !in_cone[id.index()]) continue;
      if (scan % kRun != 0 && !random.one_in(hold)) continue;
      terms.set_input(id, random.one_in(3)
                              ? variable.high
                              : random.between(variable.low, variable.high));
    }
    terms.scan();
    for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
      if (!in_cone[ts.states[i].var.index()]) continue;
      const auto value = static_cast<std::uint64_t>(terms.state(i));
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

  std::vector<StatePair> find(const std::vector<StatePair>& by_name) {
    std::vector<bool> named(b_.states.size(), false);
    for (const StatePair& pair : by_name) {
      if (!may_be_equal(pair)) continue;
      pairs_.push_back(pair);
      named[pair.b] = true;
    }
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> alike;
    for (std::uint32_t i = 0; i < a_.states.size(); ++i) {
      if (in_cone(product_.state_a[i])) {
        alike[prints_[product_.state_a[i]]].push_back(i);
      }
    }
    for (std::uint32_t i = 0; i < b_.states.size(); ++i) {
      if (named[i] || !in_cone(product_.state_b[i])) continue;
      add_alike(i, alike[prints_[product_.state_b[i]]]);
    }
    return std::move(pairs_);
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

  void add_alike(std::uint32_t of_b, const std::vector<std::uint32_t>& of_a) {
    constexpr std::size_t kMost = 4;  // classes of idle states may be large
    std::size_t added = 0;
    for (const std::uint32_t first : of_a) {
      if (added == kMost) return;
      const StatePair pair{first, of_b};
      if (!may_be_equal(pair)) continue;
      pairs_.push_back(pair);
      ++added;
    }
  }

  const TransitionSystem& a_;
  const TransitionSystem& b_;
  const Product& product_;
  std::vector<bool> in_cone_;
  std::vector<std::uint64_t> prints_;
  std::vector<StatePair> pairs_;
};

}  // namespace

EqualStates find_equal_states(const TransitionSystem& a,
                              const TransitionSystem& b, Product& product,
                              const std::vector<StatePair>& by_name,
                              const Deadline& deadline) {
  constexpr std::int64_t kConflicts = 200'000;
  EqualStates result;
  result.outputs.assign(product.same.size(), false);
  const std::vector<StatePair> pairs =
      CandidatePairs(a, b, product).find(by_name);
  std::vector<ExprId> equal;
  for (const StatePair& pair : pairs) {
    equal.push_back(
        product.ts.exprs.equal(product.ts.state_expr(product.state_a[pair.a]),
                               product.ts.state_expr(product.state_b[pair.b])));
  }
  std::vector<ExprId> roots = product.same;
  roots.insert(roots.end(), equal.begin(), equal.end());
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
  result.outputs = candidates.condition_holds;
  result.all_outputs = std::all_of(result.outputs.begin(), result.outputs.end(),
                                   [](bool holds) { return holds; });
  return result;
}

}  // namespace rung
