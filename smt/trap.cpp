#include "smt/trap.h"

#include <utility>

namespace rung {
namespace {

constexpr std::int64_t kConflicts = 5000;  // a query
constexpr std::uint32_t kRounds = 500;

class TrapMaker {
 public:
  TrapMaker(TransitionSystem& ts, Cone& cone, ExprId bad,
            const Deadline& deadline)
      : ts_(ts),
        circuit_(cone.circuit()),
        bad_(bad),
        sat_(&deadline),
        clauses_(circuit_.aig(), sat_) {
    clauses_.require(cone.ranges());
    clauses_.require(cone.constraint());
  }

  std::vector<Bound> make(std::vector<Bound> bounds) {
    for (std::uint32_t round = 0; round < kRounds; ++round) {
      switch (breaks(bounds, true)) {
        case SatAnswer::Unsat:
          return fewest(std::move(bounds));
        case SatAnswer::Unknown:
          return {};
        case SatAnswer::Sat:
          if (clauses_.value(circuit_.bit(bad_))) return {};
          std::erase_if(bounds, [&](const Bound& bound) {
            return !clauses_.value(circuit_.bit(after_scan(ts_, bound)));
          });
      }
    }
    return {};
  }

 private:
  /// Does a scan from the bounds break one, or end badly?
  SatAnswer breaks(const std::vector<Bound>& bounds, bool asks_values) {
    const ExprId good = ts_.exprs.conjunction(after_scan(ts_, bounds),
                                              ts_.exprs.negation(bad_));
    std::vector<int> assumptions = {-clauses_.literal(circuit_.bit(good))};
    for (const Bound& bound : bounds) {
      assumptions.push_back(
          clauses_.literal(circuit_.bit(before_scan(ts_, bound))));
      if (asks_values) clauses_.literal(circuit_.bit(after_scan(ts_, bound)));
    }
    if (asks_values) clauses_.literal(circuit_.bit(bad_));
    for (const int literal : assumptions) sat_.assume(literal);
    return sat_.solve(kConflicts);
  }

  std::vector<Bound> fewest(std::vector<Bound> bounds) {
    for (std::size_t i = bounds.size(); i-- > 0;) {
      std::vector<Bound> less = bounds;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
      if (breaks(less, false) == SatAnswer::Unsat) bounds = std::move(less);
    }
    return bounds;
  }

  TransitionSystem& ts_;
  StepCircuit& circuit_;
  ExprId bad_;
  Sat sat_;
  AigClauses clauses_;
};

}  // namespace

std::vector<Bound> trap_around(TransitionSystem& ts, Cone& cone, ExprId bad,
                               const SliceState& state,
                               const Deadline& deadline) {
  return TrapMaker(ts, cone, bad, deadline).make(exactly(cone, state));
}

std::vector<Bound> exactly(const Cone& cone, const SliceState& state) {
  std::vector<Bound> bounds;
  const TransitionSystem& ts = cone.ts();
  for (const std::uint32_t i : cone.states()) {
    const bool bit = ts.vars[ts.states[i].var].type == Type::Bit;
    if (!bit || state[i] != 0) {
      bounds.push_back({i, Bound::kNone, false, state[i]});
    }
    if (!bit || state[i] == 0) {
      bounds.push_back({i, Bound::kNone, true, state[i]});
    }
  }
  return bounds;
}

}  // namespace rung
