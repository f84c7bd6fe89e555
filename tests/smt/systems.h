#pragma once

#include <string>

#include "analysis/transition_system.h"

namespace rung::test {

/// Hand-made systems whose answers are known.
struct System {
  TransitionSystem ts;

  explicit System(std::int64_t min_ms = 1, std::int64_t max_ms = 100) {
    ts.scan = {min_ms, max_ms};
    ts.dt = ts.add_input("dt", VarRole::Dt, Type::Word, min_ms, max_ms);
  }
  ExprArena& e() { return ts.exprs; }
  ExprId input(const std::string& name) {
    return ts.of(ts.add_input(name, VarRole::Input, Type::Bit, 0, 1));
  }
  std::uint32_t bit_state(const std::string& name) {
    return ts.add_state(name, Type::Bit, 0, 1, 0);
  }
  ExprId of(std::uint32_t state) { return ts.state_expr(state); }
  ExprId end(std::uint32_t state) { return ts.states[state].next; }
  void next(std::uint32_t state, ExprId value) {
    ts.states[state].next = value;
  }

  /// A clock that is 0 at the end of a scan without `on`, else grows.
  ExprId on_delay(const std::string& name, ExprId on, std::int64_t ms) {
    const std::uint32_t clock = ts.add_clock(name, e().negation(on), ms + 100);
    return e().less_equal(e().word(ms), end(clock));
  }

  /// start/stop with stop dominant; returns the state.
  std::uint32_t latch(const std::string& name, ExprId start, ExprId stop) {
    const std::uint32_t q = bit_state(name);
    next(q, e().conjunction(e().disjunction(start, of(q)), e().negation(stop)));
    return q;
  }
};

}  // namespace rung::test
