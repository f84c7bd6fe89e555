#include "smt/region.h"

#include <algorithm>

namespace rung {
namespace {

ExprId at_bound(ExprArena& exprs, const Bound& bound, ExprId value) {
  if (exprs[value].type == Type::Bit) {
    const bool wanted = !bound.at_most;
    const bool trivial = bound.at_most ? bound.value >= 1 : bound.value <= 0;
    if (trivial) return exprs.bit(true);
    return wanted ? value : exprs.negation(value);
  }
  const ExprId number = exprs.word(bound.value);
  return bound.at_most ? exprs.less_equal(value, number)
                       : exprs.less_equal(number, value);
}

std::string name_of(const TransitionSystem& ts, std::uint32_t state) {
  return ts.vars[ts.states[state].var].name;
}

std::string to_string(const TransitionSystem& ts, const Bound& bound) {
  const Variable& var = ts.vars[ts.states[bound.state].var];
  if (var.type == Type::Bit) return (bound.at_most ? "!" : "") + var.name;
  std::string text = var.name;
  if (bound.minus != Bound::kNone) text += " - " + name_of(ts, bound.minus);
  text += bound.at_most ? " <= " : " >= ";
  return text + std::to_string(bound.value);
}

}  // namespace

ExprId before_scan(TransitionSystem& ts, const Bound& bound) {
  ExprId value = ts.state_expr(bound.state);
  if (bound.minus != Bound::kNone) {
    value = ts.exprs.subtract(value, ts.state_expr(bound.minus));
  }
  return at_bound(ts.exprs, bound, value);
}

ExprId after_scan(TransitionSystem& ts, const Bound& bound) {
  ExprId value = ts.states[bound.state].next;
  if (bound.minus != Bound::kNone) {
    value = ts.exprs.subtract(value, ts.states[bound.minus].next);
  }
  return at_bound(ts.exprs, bound, value);
}

ExprId before_scan(TransitionSystem& ts, const std::vector<Bound>& bounds) {
  ExprId all = ts.exprs.bit(true);
  for (const Bound& bound : bounds) {
    all = ts.exprs.conjunction(all, before_scan(ts, bound));
  }
  return all;
}

ExprId after_scan(TransitionSystem& ts, const std::vector<Bound>& bounds) {
  ExprId all = ts.exprs.bit(true);
  for (const Bound& bound : bounds) {
    all = ts.exprs.conjunction(all, after_scan(ts, bound));
  }
  return all;
}

ExprId holds_inputs(TransitionSystem& ts, const Region& region) {
  ExprId all = ts.exprs.bit(true);
  for (const Region::Held& held : region.held) {
    const bool bit = ts.vars[held.input].type == Type::Bit;
    const ExprId value =
        bit ? ts.exprs.bit(held.value != 0) : ts.exprs.word(held.value);
    all = ts.exprs.conjunction(all, ts.exprs.equal(ts.of(held.input), value));
  }
  return all;
}

ExprId clock_grows(TransitionSystem& ts, const Region& region) {
  return ts.exprs.less(ts.state_expr(region.clock),
                       ts.states[region.clock].next);
}

ExprId allowed(TransitionSystem& ts) {
  ExprId all = ts.exprs.bit(true);
  for (const ExprId constraint : ts.constraints) {
    all = ts.exprs.conjunction(all, constraint);
  }
  return all;
}

bool contains(const Region& region, const SliceState& values) {
  return std::all_of(
      region.bounds.begin(), region.bounds.end(), [&](const Bound& bound) {
        std::int64_t value = values[bound.state];
        if (bound.minus != Bound::kNone) value -= values[bound.minus];
        return bound.at_most ? value <= bound.value : value >= bound.value;
      });
}

std::string to_string(const TransitionSystem& ts, const Region& region) {
  std::string text;
  for (const Bound& bound : region.bounds) {
    if (!text.empty()) text += " && ";
    text += to_string(ts, bound);
  }
  if (text.empty()) text = "true";
  const char* separator = ": ";
  for (const Region::Held& held : region.held) {
    text += separator + ts.vars[held.input].name + " = " +
            std::to_string(held.value);
    separator = ", ";
  }
  if (region.clock != Bound::kNone) {
    text += separator;
    text += "until " + name_of(ts, region.clock) + " is large enough";
  }
  return text;
}

StartingAt::StartingAt(TransitionSystem& ts,
                       const std::vector<std::uint32_t>& states,
                       const SliceState& values)
    : ts_(ts), states_(states) {
  for (const std::uint32_t state : states_) {
    inits_.push_back(ts.states[state].init);
    ts.states[state].init = values[state];
  }
}

StartingAt::~StartingAt() {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    ts_.states[states_[i]].init = inits_[i];
  }
}

}  // namespace rung
