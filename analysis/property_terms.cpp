#include "analysis/property_terms.h"

#include <algorithm>
#include <cassert>

namespace rung {
namespace {

static_assert(kMaxHistory + 3 < 64, "views are bits of a 64-bit word");

/// States of one element at one moment, for the formulas of its `.q`.
class ElementNames : public NameResolver {
 public:
  enum Moment : int { End, Before, Initial };

  ElementNames(TransitionSystem& ts, const Instance& instance, InstanceId id,
               int moment)
      : ts_(ts), instance_(instance), id_(id), moment_(moment) {}

  ExprId resolve(std::string_view name) override {
    if (name == "p") return ts_.exprs.word(instance_.largest_parameter);
    const std::vector<std::uint32_t>& states = ts_.instance_states[id_.index()];
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (instance_.kind->states[i].name != name) continue;
      const State& state = ts_.states[states[i]];
      if (moment_ == End) return state.next;
      if (moment_ == Before) return ts_.of(state.var);
      return ts_.vars[state.var].type == Type::Bit
                 ? ts_.exprs.bit(state.init != 0)
                 : ts_.exprs.word(state.init);
    }
    return {};
  }

 private:
  TransitionSystem& ts_;
  const Instance& instance_;
  InstanceId id_;
  int moment_;
};

std::vector<std::uint32_t> operands_of(const Formula& formula,
                                       std::uint32_t node) {
  std::vector<std::uint32_t> result(formula.nodes[node].arguments);
  std::uint32_t root = node;
  for (std::size_t i = result.size(); i-- > 0;) {
    result[i] = root - 1;
    root -= formula.nodes[root - 1].size;
  }
  return result;
}

/// Calls `visit` with every position of a set bit.
template <class Visit>
void for_each_bit(std::uint64_t mask, Visit visit) {
  for (std::uint32_t bit = 0; mask != 0; ++bit, mask >>= 1) {
    if ((mask & 1) != 0) visit(bit);
  }
}

}  // namespace

ExprId PropertyTerms::term(std::string_view text) {
  text_ = text;
  const Formula formula = parse_formula(text);
  return lower(formula, formula.root(), 0);
}

ExprId PropertyTerms::before(std::string_view text) {
  text_ = text;
  const Formula formula = parse_formula(text);
  return lower(formula, formula.root(), 1);
}

ExprId PropertyTerms::left_side(std::string_view text) {
  text_ = text;
  const Formula formula = parse_formula(text);
  if (formula.nodes.back().op != FormulaOp::Implies) return {};
  return lower(formula, operands_of(formula, formula.root())[0], 0);
}

/// From the root down: which values of each node are needed. Then from the
/// leaves up: those values. Two loops, whatever the depth.
ExprId PropertyTerms::lower(const Formula& formula, std::uint32_t root,
                            std::uint32_t back) {
  values_.clear();
  std::vector<Demand> demands(formula.nodes.size());
  demands[root].end = std::uint64_t{1} << back;
  for (std::uint32_t node = root + 1; node-- > 0;) {
    demand_operands(formula, node, demands);
  }
  for (std::uint32_t node = 0; node <= root; ++node) {
    for_each_bit(demands[node].end, [&](std::uint32_t bit) {
      const View view = {.back = bit, .begin = false};
      values_[key(node, view)] = value(formula, node, view);
    });
    for_each_bit(demands[node].begin, [&](std::uint32_t bit) {
      const View view = {.back = bit, .begin = true};
      values_[key(node, view)] = value(formula, node, view);
    });
  }
  return operand_value(root, {.back = back, .begin = false});
}

void PropertyTerms::demand_operands(const Formula& formula, std::uint32_t node,
                                    std::vector<Demand>& demands) const {
  const Demand mine = demands[node];
  const FormulaNode& at = formula.nodes[node];
  for (const std::uint32_t operand : operands_of(formula, node)) {
    Demand& needed = demands[operand];
    if (at.op != FormulaOp::Call) {
      needed.end |= mine.end;
      needed.begin |= mine.begin;
    } else if (at.text == "prev") {
      needed.end |= mine.end << 1;
    } else if (at.text == "begin") {
      needed.begin |= mine.end;
    } else if (at.text == "once") {
      needed.end |= mine.end != 0 ? 1 : 0;
    } else {  // rose, fell
      needed.end |= mine.end | mine.end << 1;
    }
  }
}

ExprId PropertyTerms::value(const Formula& formula, std::uint32_t node,
                            View view) {
  const FormulaNode& at = formula.nodes[node];
  switch (at.op) {
    case FormulaOp::Name:
      return name(at.text, view);
    case FormulaOp::Number:
      return ts_.exprs.word(at.number);
    case FormulaOp::Bool:
      return ts_.exprs.bit(at.number != 0);
    case FormulaOp::Call:
      return call(at, node - 1, view);
    default:
      break;
  }
  std::vector<ExprId> operands;
  for (const std::uint32_t operand : operands_of(formula, node)) {
    operands.push_back(operand_value(operand, view));
  }
  return apply_operator(ts_.exprs, at, operands.data());
}

ExprId PropertyTerms::call(const FormulaNode& node, std::uint32_t operand,
                           View view) {
  ExprArena& exprs = ts_.exprs;
  const View before = {.back = view.back + 1, .begin = false};
  if (node.text == "prev") return operand_value(operand, before);
  if (node.text == "begin") {
    return operand_value(operand, {.back = view.back, .begin = true});
  }
  if (node.text == "once") {
    const ExprId now = operand_value(operand, {});
    return once(now, text_.substr(node.begin, node.end - node.begin),
                view.back);
  }
  const ExprId now = operand_value(operand, view);
  const ExprId then = operand_value(operand, before);
  if (node.text == "rose") {
    return exprs.conjunction(now, exprs.negation(then));
  }
  assert(node.text == "fell");
  return exprs.conjunction(exprs.negation(now), then);
}

ExprId PropertyTerms::name(std::string_view text, View view) {
  const PropertyName found = names_.find(text);
  if (found.kind != PropertyName::Kind::Cell) {
    return element(found, text, view.back);
  }
  // When a scan begins, the inputs have been sampled and no rung has run.
  const bool sampled =
      program_.cells[found.cell].role == CellRole::Input || !view.begin;
  return cell(found.cell, sampled ? view.back : view.back + 1);
}

ExprId PropertyTerms::cell(CellId id, std::uint32_t back) {
  const Cell& cell = program_.cells[id];
  const ExprId end = ts_.cell_end[id.index()];
  if (back == 0) return end;
  if (cell.role == CellRole::Input) {
    return older(end, cell.initial, cell.name, 0, back);
  }
  return older(ts_.cell_begin[id.index()], cell.initial, cell.name, 1, back);
}

ExprId PropertyTerms::element(const PropertyName& name, std::string_view text,
                              std::uint32_t back) {
  if (name.kind == PropertyName::Kind::Fired) {
    return fired(name.instance, text, back);
  }
  const Instance& instance = program_.instances[name.instance];
  const std::string_view formula = name.kind == PropertyName::Kind::Done
                                       ? instance.kind->done
                                       : instance.kind->value;
  const auto at = [&](ElementNames::Moment moment) {
    return observation(instance, name.instance, formula, moment);
  };
  if (back == 0) return at(ElementNames::End);
  const ExprId initial = at(ElementNames::Initial);
  assert(ts_.exprs.is_constant(initial));
  return older(at(ElementNames::Before), ts_.exprs[initial].value, text, 1,
               back);
}

/// A call gave true in the scan. A timer that is reset in the scan in which it
/// fires is not on at its end: `.q` would never see it.
ExprId PropertyTerms::fired(InstanceId id, std::string_view text,
                            std::uint32_t back) {
  ExprId any = ts_.exprs.bit(false);
  for (const CallId call : calls_[id.index()]) {
    any = ts_.exprs.disjunction(any, ts_.call_value[call.index()]);
  }
  return older(any, 0, text, 0, back);
}

ExprId PropertyTerms::observation(const Instance& instance, InstanceId id,
                                  std::string_view formula, int moment) {
  ElementNames names(ts_, instance, id, moment);
  return compile_formula(ts_.exprs, parse_formula(formula), names);
}

ExprId PropertyTerms::once(ExprId now, std::string_view text,
                           std::uint32_t back) {
  const auto [entry, is_new] = once_.try_emplace(now, 0);
  if (is_new) {
    entry->second = ts_.add_state(std::string(text), Type::Bit, 0, 1, 0);
    State& state = ts_.states[entry->second];
    state.next = ts_.exprs.disjunction(ts_.of(state.var), now);
  }
  const State& state = ts_.states[entry->second];
  if (back == 0) return state.next;
  return older(ts_.of(state.var), 0, text, 1, back);
}

/// `term` is the value of `name` `from` scans back.
ExprId PropertyTerms::older(ExprId term, std::int64_t initial,
                            std::string_view name, std::uint32_t from,
                            std::uint32_t back) {
  for (std::uint32_t scans = from; scans < back; ++scans) {
    std::string text;
    for (std::uint32_t i = 0; i <= scans; ++i) text += "prev(";
    text += name;
    text.append(scans + 1, ')');
    term = remembered(term, initial, std::move(text));
  }
  return term;
}

ExprId PropertyTerms::remembered(ExprId now, std::int64_t initial,
                                 std::string name) {
  if (ts_.exprs.is_constant(now) && ts_.exprs[now].value == initial) return now;
  const auto [entry, is_new] = remembered_.try_emplace({now, initial}, 0);
  if (is_new) {
    const Expr expr = ts_.exprs[now];
    entry->second =
        ts_.add_state(std::move(name), expr.type, std::min(expr.low, initial),
                      std::max(expr.high, initial), initial);
    ts_.states[entry->second].next = now;
  }
  return ts_.state_expr(entry->second);
}

}  // namespace rung
