#include "smt/templates.h"

#include <algorithm>

#include "smt/thresholds.h"

namespace rung {
namespace {

constexpr std::size_t kAllPairs = 24;       // states of a small cone
constexpr std::size_t kGroup = 16;          // states that one term reads
constexpr std::size_t kClose = 6;           // of them, the nearest
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
    const State& state = ts.states[states[i]];
    columns_[i].word = ts.vars[state.var].type == Type::Word;
    if (state.clock) columns_[i].running = state.running;
  }
  find_neighbours(roots);
}

/// Places of the states that a term reads in its scan.
std::vector<std::uint32_t> Templates::read_by(ExprId term,
                                              std::size_t limit) const {
  std::vector<std::uint32_t> places = states_read(ts_, term, false, limit);
  for (std::uint32_t& place : places) place = place_.at(place);
  return places;
}

void Templates::connect(const std::vector<std::uint32_t>& group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      near_.emplace_back(std::min(group[i], group[j]),
                         std::max(group[i], group[j]));
    }
  }
}

bool Templates::near(std::uint32_t x, std::uint32_t y) const {
  return columns_.size() <= kAllPairs ||
         std::binary_search(near_.begin(), near_.end(),
                            std::pair(std::min(x, y), std::max(x, y)));
}

void Templates::find_neighbours(const std::vector<ExprId>& roots) {
  const bool small = columns_.size() <= kAllPairs;
  for (ExprId root : roots) connect(read_by(root, small ? kClose : kGroup));
  for (std::uint32_t i = 0; i < columns_.size(); ++i) {
    const ExprId next = ts_.states[cone_->states()[i]].next;
    for (std::uint32_t read : read_by(next, small ? kClose : kGroup)) {
      if (read != i) near_.emplace_back(std::min(i, read), std::max(i, read));
    }
  }
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  if (!small) return;
  for (std::uint32_t i = 0; i < columns_.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const std::pair pair(j, i);
      if (!std::binary_search(near_.begin(), near_.end(), pair))
        far_.push_back(pair);
    }
  }
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
    if (!column.running.has_value()) continue;
    // A monitor's clock runs always; that constant may be in no term.
    if (column.running == ts_.exprs.bit(true)) {
      column.runs.push_back(simulation.alive());
      continue;
    }
    const bool known = cone_->circuit().has(column.running);
    column.runs.push_back(
        known ? simulation.value(cone_->circuit().bit(column.running)) : 0);
  }
}

std::vector<std::uint64_t> Templates::signatures() const {
  constexpr std::uint64_t kPrime = 0x0000'0100'0000'01b3U;
  std::vector<std::uint64_t> result;
  for (const Column& column : columns_) {
    std::uint64_t hash = 0xcbf2'9ce4'8422'2325U;
    const auto mix = [&](std::uint64_t value) {
      hash = (hash ^ value) * kPrime;
      hash ^= hash >> 29U;
    };
    for (std::size_t i = 0; i < column.bits.size(); ++i) {
      mix(column.bits[i] & alive_[i]);
    }
    for (std::size_t at = 0; at < column.words.size(); ++at) {
      const bool alive = (alive_[at / 64] >> at % 64 & 1U) != 0;
      mix(alive ? static_cast<std::uint64_t>(column.words[at]) : 0);
    }
    result.push_back(hash);
  }
  return result;
}

void Templates::add_literal(std::uint32_t state, ExprId term, Lanes64 holds) {
  literals_of_[state].push_back(static_cast<std::uint32_t>(literals_.size()));
  literals_.push_back({term, state, std::move(holds)});
}

void Templates::make_literals() {
  literals_.clear();
  const auto constants = thresholds(*cone_);
  literals_of_.assign(columns_.size(), {});
  thresholds_.assign(columns_.size(), {});
  for (std::uint32_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const ExprId x = ts_.state_expr(cone_->states()[i]);
    if (!column.word) {
      add_literal(i, x, column.bits);
      continue;
    }
    std::vector<std::int64_t> bounds = constants.at(cone_->states()[i]);
    thresholds_[i] = bounds;
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
  if (signal == kAigTrue || !offered_.insert(signal).second) return;
  result.push_back({std::move(clause), signal});
}

void Templates::pair_up(Constants constants, const Pairs& pairs,
                        std::vector<Candidate>& result) {
  std::vector<bool> settled(literals_.size(), false);
  for (std::size_t i = 0; i < literals_.size(); ++i) {
    for (const bool value : {false, true}) {
      if (settled[i] || !always(literals_[i].holds, value)) continue;
      settled[i] = constants == Constants::Alone;
      add({{literals_[i].term, {}, 0, !value}}, result);
    }
  }
  for (const auto& [x, y] : pairs) {
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

void Templates::relate(std::uint32_t x, std::uint32_t y, bool guarded,
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
  for (std::uint32_t i = 0;
       guarded && i < columns_.size() && guards.size() < kAllPairs; ++i) {
    if (!columns_[i].word && (near(i, x) || near(i, y)))
      guards.push_back(literals_of_[i].front());
  }
  offer(ts_.exprs.less_equal(p, q), less, guards, result);
  offer(ts_.exprs.less_equal(q, p), more, guards, result);
}

/// The most that the clock x was behind y below `p`, while x ran: first
/// whatever y did, then while y ran as well. No value: there was no such scan.
Templates::Lags Templates::lags(const Column& x, const Column& y,
                                std::int64_t p) const {
  Lags most;
  const auto raise = [](std::optional<std::int64_t>& lag, std::int64_t value) {
    if (!lag || *lag < value) lag = value;
  };
  for (std::size_t at = 0; at < x.words.size(); ++at) {
    const std::uint64_t counts = x.runs[at / 64] & alive_[at / 64];
    if ((counts >> at % 64 & 1U) == 0 || x.words[at] >= p) continue;
    const std::int64_t lag = y.words[at] - x.words[at];
    raise(most.any, lag);
    if ((y.runs[at / 64] >> at % 64 & 1U) != 0) raise(most.both, lag);
  }
  return most;
}

/// How far the clock x is behind y while x runs, and has not come to what it
/// is compared with. Seldom needed, so only from afar: the same of a clock that
/// always runs, and, closer, while both of them run.
void Templates::follow(std::uint32_t x, std::uint32_t y, Reach reach,
                       std::vector<Candidate>& result) {
  const Column& of_x = columns_[x];
  const Column& of_y = columns_[y];
  if (!of_x.running.has_value() || !of_y.running.has_value()) return;
  const bool far = reach == Reach::Far;
  if (!far && ts_.exprs.is_constant(of_x.running)) return;
  const ExprId clock = ts_.state_expr(cone_->states()[x]);
  const ExprId other = ts_.state_expr(cone_->states()[y]);
  for (const std::int64_t p : thresholds_[x]) {
    if (p <= ts_.exprs[clock].low + 1) continue;
    const ExprId done = ts_.exprs.less_equal(ts_.exprs.word(p), clock);
    const auto offer_lag = [&](std::int64_t lag, bool both) {
      const ExprId behind = ts_.exprs.less_equal(
          other, ts_.exprs.add(clock, ts_.exprs.word(lag)));
      if (ts_.exprs.is_constant(behind) || ts_.exprs.is_constant(done)) return;
      LemmaClause clause = {{behind, {}, 0, false}, {done, {}, 0, false}};
      const auto while_runs = [&](ExprId running) {
        if (ts_.exprs.is_constant(running)) return;
        clause.push_back({running, {}, 0, true});
      };
      while_runs(of_x.running);
      if (both) while_runs(of_y.running);
      add(std::move(clause), result);
    };
    const Lags most = lags(of_x, of_y, p);
    if (!most.any) continue;
    const bool limits = *most.any < ts_.exprs[other].high - 1;
    if (limits) offer_lag(*most.any, false);
    if (far && most.both && *most.both < *most.any) {
      offer_lag(*most.both, true);
    }
  }
}

std::vector<Candidate> Templates::candidates(Constants constants, Reach reach) {
  std::vector<Candidate> result;
  offered_.clear();
  make_literals();
  pair_up(constants, reach == Reach::Near ? near_ : far_, result);
  for (const Pairs* pairs : {&near_, &far_}) {
    for (const auto& [x, y] : *pairs) {
      if (!columns_[x].word || !columns_[y].word) continue;
      relate(x, y, constants == Constants::Pairs, result);
      follow(x, y, reach, result);
      follow(y, x, reach, result);
    }
  }
  return result;
}

}  // namespace rung
