#include "check/encode_formula.h"

#include <algorithm>
#include <cassert>

#include "check/elements.h"

namespace rung::check {

FormulaEncoder::FormulaEncoder(const Program& program,
                               const ProgramValues& values, Model& model)
    : program_(program), values_(values), model_(model) {
  for (const CellId id : ids_of(program.cells)) {
    cells_.emplace(program.cells[id].name, id);
  }
  for (const InstanceId id : ids_of(program.instances)) {
    instances_.emplace(program.instances[id].name, id);
  }
}

Value FormulaEncoder::value(std::string_view text, std::uint32_t back) {
  text_ = text;
  formula_ = parse_formula(text);
  assert(formula_.has_value());
  return value_of({formula_.root(), back, false});
}

/// Operands first, with a list of what is still to be done for a stack.
Value FormulaEncoder::value_of(const View& root) {
  known_.clear();
  std::vector<View> open = {root};
  while (!open.empty()) {
    const View view = open.back();
    std::vector<Value> operands;
    bool ready = true;
    for (const View& operand : operands_of(view)) {
      const auto found = known_.find(operand);
      if (found == known_.end()) {
        open.push_back(operand);
        ready = false;
      } else {
        operands.push_back(found->second);
      }
    }
    if (!ready) continue;
    open.pop_back();
    if (known_.count(view) == 0) known_.emplace(view, compute(view, operands));
  }
  return known_.at(root);
}

std::vector<FormulaEncoder::View> FormulaEncoder::operands_of(
    const View& view) const {
  const FormulaNode& node = formula_.nodes[view.node];
  std::vector<View> result;
  std::uint32_t at = view.node;
  for (std::uint32_t i = 0; i < node.arguments; ++i) {
    result.push_back({at - 1, view.back, view.begin});
    at -= formula_.nodes[at - 1].size;
  }
  std::reverse(result.begin(), result.end());
  if (node.op != FormulaOp::Call) return result;
  View& operand = result.front();
  if (node.text == "prev") {
    operand = {operand.node, view.back + 1, false};
  } else if (node.text == "begin") {
    operand.begin = true;
  } else if (node.text == "once") {
    operand = {operand.node, 0, false};
  } else {  // rose, fell
    result.push_back({operand.node, view.back + 1, false});
  }
  return result;
}

Value FormulaEncoder::compute(const View& view,
                              const std::vector<Value>& operands) {
  const FormulaNode& node = formula_.nodes[view.node];
  const auto a = [&] { return operands[0]; };
  const auto b = [&] { return operands[1]; };
  switch (node.op) {
    case FormulaOp::Name:
      return leaf(node.text, view);
    case FormulaOp::Number:
      return model_.terms().number(node.number);
    case FormulaOp::Bool:
      return model_.terms().bit(node.number != 0);
    case FormulaOp::Not:
      return ~a();
    case FormulaOp::Negate:
      return model_.terms().number(0) - a();
    case FormulaOp::And:
      return a() & b();
    case FormulaOp::Or:
      return a() | b();
    case FormulaOp::Xor:
      return a() ^ b();
    case FormulaOp::Implies:
      return ~a() | b();
    case FormulaOp::Equivalent:
      return ~(a() ^ b());
    case FormulaOp::Choose:
      return choose(a(), b(), operands[2]);
    case FormulaOp::Equal:
      return a() == b();
    case FormulaOp::NotEqual:
      return ~(a() == b());
    case FormulaOp::Less:
      return a() < b();
    case FormulaOp::LessEqual:
      return a() <= b();
    case FormulaOp::Greater:
      return a() > b();
    case FormulaOp::GreaterEqual:
      return a() >= b();
    case FormulaOp::Add:
      return a() + b();
    case FormulaOp::Subtract:
      return a() - b();
    case FormulaOp::Multiply:
      return a() * b();
    case FormulaOp::Call:
      break;
  }
  return call(view, operands);
}

Value FormulaEncoder::call(const View& view,
                           const std::vector<Value>& operands) {
  const std::string_view name = formula_.nodes[view.node].text;
  if (name == "rose") return operands[0] & ~operands[1];
  if (name == "fell") return ~operands[0] & operands[1];
  if (name == "once") return once(operands[0], view);
  return operands[0];  // prev and begin: the operand's view says it
}

/// A bit that stays, from the first scan end with the operand.
Value FormulaEncoder::once(Value now, const View& view) {
  const FormulaNode& node = formula_.nodes[view.node];
  const std::string_view text = text_.substr(node.begin, node.end - node.begin);
  const auto [entry, is_new] = once_.try_emplace(now.id, 0);
  if (is_new) {
    entry->second = model_.add_state(std::string(text), false, 0);
    StateVariable& state = model_.states[entry->second];
    state.next = state.now | now;
  }
  const StateVariable state = model_.states[entry->second];
  model_.name(std::string(text), state.now);
  if (view.back == 0) return state.next;
  return older(state.now, 0, text, 1, view.back);
}

Value FormulaEncoder::leaf(std::string_view name, const View& view) {
  const auto found = cells_.find(name);
  if (found == cells_.end()) return member(name, view.back);
  // As a scan begins the inputs are sampled, and nothing is written yet.
  const bool written =
      program_.cells[found->second].role != CellRole::Input && view.begin;
  return cell(found->second, view.back + (written ? 1 : 0));
}

Value FormulaEncoder::cell(CellId id, std::uint32_t back) {
  const Cell& cell = program_.cells[id];
  if (back == 0) return values_.cells[id.index()];
  const std::uint32_t state = values_.cell_state[id.index()];
  if (state == ProgramValues::kNoState) {
    return older(values_.cells[id.index()], cell.initial, cell.name, 0, back);
  }
  return older(model_.states[state].now, cell.initial, cell.name, 1, back);
}

/// T(0).q, T(0).fired, T(0).elapsed, C(0).value.
Value FormulaEncoder::member(std::string_view name, std::uint32_t back) {
  const std::size_t dot = name.rfind('.');
  assert(dot != std::string_view::npos);
  const InstanceId id = instances_.at(name.substr(0, dot));
  const std::string_view what = name.substr(dot + 1);
  if (what == "fired") {
    return older(values_.fired[id.index()], 0, name, 0, back);
  }
  if (back == 0) return observed(id, what, false);
  const Value before = observed(id, what, true);
  return older(before, initial_value(before), name, 1, back);
}

Value FormulaEncoder::observed(InstanceId id, std::string_view what,
                               bool before) {
  const Instance& instance = program_.instances[id];
  const Kind* const kind = find_kind(instance.kind->id);
  std::vector<Value> states = values_.elements[id.index()];
  if (before) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = model_.states[values_.element_state[id.index()][i]].now;
    }
  }
  const std::vector<Value> none;
  Element element(model_.terms(), states, none, instance.largest_parameter,
                  program_.scan.max_ms);
  const bool known = what == "q" ? kind->done != nullptr : kind->value >= 0;
  if (!known) {
    model_.unknown_element = instance.name + "." + std::string(what);
    return what == "q" ? element.bit(false) : element.number(0);
  }
  if (what == "q") return kind->done(element);
  return states[static_cast<std::size_t>(kind->value)];
}

std::int64_t FormulaEncoder::initial_value(Value term) const {
  std::vector<std::int64_t> states;
  for (const StateVariable& state : model_.states) {
    states.push_back(state.initial);
  }
  std::vector<std::int64_t> inputs;
  for (const InputVariable& input : model_.inputs) inputs.push_back(input.low);
  return evaluate(model_.terms(), states, inputs)[term.id];
}

/// `term` is the value `from` scans back.
Value FormulaEncoder::older(Value term, std::int64_t initial,
                            std::string_view name, std::uint32_t from,
                            std::uint32_t back) {
  std::string called(name);
  for (std::uint32_t i = 0; i < back; ++i) {
    called.insert(0, "prev(").push_back(')');
    if (i >= from) term = remembered(term, initial, called);
  }
  return term;
}

Value FormulaEncoder::remembered(Value now, std::int64_t initial,
                                 const std::string& name) {
  const Term term = model_.terms()[now.id];
  const bool constant = term.op == Op::Bit || term.op == Op::Number;
  if (constant && term.value == initial) return now;
  const auto [entry, is_new] = memory_.try_emplace({now.id, initial}, 0);
  if (is_new) {
    entry->second = model_.add_state(name, term.word, initial);
    if (term.word) {
      model_.claim(entry->second, std::min(term.low, initial),
                   std::max(term.high, initial));
    }
    model_.states[entry->second].next = now;
  }
  const Value before = model_.states[entry->second].now;
  model_.name(name, before);
  return before;
}

}  // namespace rung::check
