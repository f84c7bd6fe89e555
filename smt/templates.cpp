#include "smt/templates.h"

#include <algorithm>

#include "smt/thresholds.h"

namespace rung {
namespace {

constexpr std::size_t kAllPairs = 24;       // states of a small cone
constexpr std::size_t kGroup = 16;          // states that one term reads
constexpr std::size_t kCandidates = 30000;  // in all

}  // namespace

AigLit signal_of(Cone& cone, const LemmaAtom& atom) {
  const AigLit signal = atom.term.has_value()
                            ? cone.circuit().bit(atom.term)
                            : cone.circuit().leaves(atom.var)[atom.bit];
  return atom.negated ? aig_not(signal) : signal;
}

AigLit signal_of(Cone& cone, const LemmaClause& clause) {
  AigLit any = kAigFalse;
  for (const LemmaAtom& atom : clause) {
    any = cone.circuit().aig().disjunction(any, signal_of(cone, atom));
  }
  return any;
}

Templates::Templates(TransitionSystem& ts, Cone& cone,
                     const std::vector<ExprId>& roots)
    : ts_(ts), cone_(&cone) {
  const std::vector<std::uint32_t>& states = cone.states();
  columns_.resize(states.size());
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    place_[states[i]] = i;
    columns_[i].word = ts.vars[ts.states[states[i]].var].type == Type::Word;
  }
  find_neighbours(roots);
}

/// Places of the states that a term reads in its scan.
std::vector<std::uint32_t> Templates::read_by(ExprId term) const {
  std::vector<std::uint32_t> places = states_read(ts_, term, false, kGroup);
  for (std::uint32_t& place : places) place = place_.at(place);
  return places;
}

void Templates::connect(const std::vector<std::uint32_t>& group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      pairs_.emplace_back(std::min(group[i], group[j]),
                          std::max(group[i], group[j]));
    }
  }
}

bool Templates::near(std::uint32_t x, std::uint32_t y) const {
  return columns_.size() <= kAllPairs ||
         std::binary_search(pairs_.begin(), pairs_.end(),
                            std::pair(std::min(x, y), std::max(x, y)));
}

void Templates::find_neighbours(const std::vector<ExprId>& roots) {
  if (columns_.size() <= kAllPairs) {
    std::vector<std::uint32_t> all(columns_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    return connect(all);
  }
  for (ExprId root : roots) connect(read_by(root));
  for (std::uint32_t i = 0; i < columns_.size(); ++i) {
    const ExprId next = ts_.states[cone_->states()[i]].next;
    for (std::uint32_t read : read_by(next)) {
      if (read != i) pairs_.emplace_back(std::min(i, read), std::max(i, read));
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

void Templates::sample(const Simulation& simulation) {
  alive_.push_back(simulation.alive());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Word& leaves = cone_->leaves(ts_.states[cone_->states()[i]].var);
    Column& column = columns_[i];
    if (!column.word) {
      column.bits.push_back(simulation.value(leaves.front()));
      continue;
    }
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      column.words.push_back(simulation.value(leaves, lane));
    }
  }
}

void Templates::add_literal(std::uint32_t state, ExprId term, Lanes64 holds) {
  literals_of_[state].push_back(static_cast<std::uint32_t>(literals_.size()));
  literals_.push_back({term, state, std::move(holds)});
}

void Templates::make_literals() {
  literals_.clear();
  const auto constants = thresholds(*cone_);
  literals_of_.assign(columns_.size(), {});
  for (std::uint32_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const ExprId x = ts_.state_expr(cone_->states()[i]);
    if (!column.word) {
      add_literal(i, x, column.bits);
      continue;
    }
    std::vector<std::int64_t> bounds = constants.at(cone_->states()[i]);
    bounds.push_back(ts_.exprs[x].low + 1);  // is it at its lowest
    for (std::int64_t c : bounds) {
      const ExprId term = ts_.exprs.less_equal(ts_.exprs.word(c), x);
      if (ts_.exprs.is_constant(term)) continue;
      Lanes64 holds(alive_.size(), 0);
      for (std::size_t at = 0; at < column.words.size(); ++at) {
        holds[at / 64] |= std::uint64_t{column.words[at] >= c} << at % 64;
      }
      add_literal(i, term, std::move(holds));
    }
  }
}

bool Templates::always(const Lanes64& holds, bool value) const {
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    if (((value ? ~holds[i] : holds[i]) & alive_[i]) != 0) return false;
  }
  return true;
}

bool Templates::always_either(const Lanes64& a, bool not_a, const Lanes64& b,
                              bool not_b) const {
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    const std::uint64_t either =
        (not_a ? ~a[i] : a[i]) | (not_b ? ~b[i] : b[i]);
    if ((~either & alive_[i]) != 0) return false;
  }
  return true;
}

void Templates::add(LemmaClause clause, std::vector<Candidate>& result) {
  if (result.size() >= kCandidates) return;
  const AigLit signal = signal_of(*cone_, clause);
  if (signal != kAigTrue) result.push_back({std::move(clause), signal});
}

void Templates::pair_up(std::vector<Candidate>& result) {
  std::vector<bool> settled(literals_.size(), false);
  for (std::size_t i = 0; i < literals_.size(); ++i) {
    for (const bool value : {false, true}) {
      if (settled[i] || !always(literals_[i].holds, value)) continue;
      settled[i] = true;
      add({{literals_[i].term, {}, 0, !value}}, result);
    }
  }
  for (const auto& [x, y] : pairs_) {
    for (std::uint32_t i : literals_of_[x]) {
      for (std::uint32_t j : literals_of_[y]) {
        if (settled[i] || settled[j]) continue;
        for (unsigned signs = 0; signs < 4; ++signs) {
          const bool not_i = (signs & 1U) != 0;
          const bool not_j = (signs & 2U) != 0;
          if (!always_either(literals_[i].holds, not_i, literals_[j].holds,
                             not_j)) {
            continue;
          }
          add({{literals_[i].term, {}, 0, not_i},
               {literals_[j].term, {}, 0, not_j}},
              result);
        }
      }
    }
  }
}

/// A relation of two words, by itself or else under one bit.
void Templates::offer(ExprId relation, const Lanes64& holds,
                      const std::vector<std::uint32_t>& guards,
                      std::vector<Candidate>& result) {
  if (ts_.exprs.is_constant(relation)) return;
  if (always(holds, true)) return add({{relation, {}, 0, false}}, result);
  for (std::uint32_t guard : guards) {
    for (const bool negated : {false, true}) {
      const Literal& g = literals_[guard];
      if (always(g.holds, negated)) continue;
      if (!always_either(holds, false, g.holds, negated)) continue;
      add({{relation, {}, 0, false}, {g.term, {}, 0, negated}}, result);
    }
  }
}

void Templates::relate(std::uint32_t x, std::uint32_t y,
                       std::vector<Candidate>& result) {
  const Variable& a = ts_.vars[ts_.states[cone_->states()[x]].var];
  const Variable& b = ts_.vars[ts_.states[cone_->states()[y]].var];
  Lanes64 equal(alive_.size(), 0);
  Lanes64 less(alive_.size(), 0);
  Lanes64 more(alive_.size(), 0);
  const std::int64_t cap = std::min(a.high, b.high);
  for (std::size_t at = 0; at < columns_[x].words.size(); ++at) {
    const std::int64_t p = std::min(columns_[x].words[at], cap);
    const std::int64_t q = std::min(columns_[y].words[at], cap);
    equal[at / 64] |= std::uint64_t{p == q} << at % 64;
    less[at / 64] |= std::uint64_t{p <= q} << at % 64;
    more[at / 64] |= std::uint64_t{p >= q} << at % 64;
  }
  // The wider one as the narrower would have it.
  const auto capped = [&](const Variable& v) {
    return v.high > cap ? ts_.exprs.minimum(v.expr, ts_.exprs.word(cap))
                        : v.expr;
  };
  const ExprId p = capped(a);
  const ExprId q = capped(b);
  std::vector<std::uint32_t> guards;
  for (std::uint32_t i = 0; i < columns_.size() && guards.size() < kAllPairs;
       ++i) {
    if (!columns_[i].word && (near(i, x) || near(i, y)))
      guards.push_back(literals_of_[i].front());
  }
  offer(ts_.exprs.less_equal(p, q), less, guards, result);
  offer(ts_.exprs.less_equal(q, p), more, guards, result);
}

std::vector<Candidate> Templates::candidates() {
  std::vector<Candidate> result;
  make_literals();
  pair_up(result);
  for (const auto& [x, y] : pairs_) {
    if (columns_[x].word && columns_[y].word) relate(x, y, result);
  }
  return result;
}

}  // namespace rung
