#include "analysis/property_check.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

#include "base/text.h"

namespace rung {
namespace {

// Words and constants stay exact in the reports' and the browser's doubles.
constexpr std::int64_t kMaxWord = std::int64_t{1} << 53;
// An elapsed time saturates above this constant at the latest.
constexpr std::int64_t kMaxClock = std::int64_t{366} * 24 * 3'600'000;

struct Function {
  std::string_view name;
  bool bits_only;
  std::uint32_t history;
};
constexpr std::array<Function, 5> kFunctions = {{{"begin", false, 1},
                                                 {"fell", true, 1},
                                                 {"once", true, 0},
                                                 {"prev", false, 1},
                                                 {"rose", true, 1}}};

const Function* find_function(std::string_view name) {
  for (const Function& function : kFunctions) {
    if (function.name == name) return &function;
  }
  return nullptr;
}

bool is_comparison(FormulaOp op) {
  return op == FormulaOp::Equal || op == FormulaOp::NotEqual ||
         op == FormulaOp::Less || op == FormulaOp::LessEqual ||
         op == FormulaOp::Greater || op == FormulaOp::GreaterEqual;
}

}  // namespace

PropertyNames::PropertyNames(const Program& program) : program_(program) {
  cells_.reserve(program.cells.size());
  instances_.reserve(program.instances.size());
  for (const CellId id : ids_of(program.cells)) {
    cells_.emplace(program.cells[id].name, id);
  }
  for (const InstanceId id : ids_of(program.instances)) {
    instances_.emplace(program.instances[id].name, id);
  }
}

PropertyName PropertyNames::find(std::string_view name) const {
  const auto cell = cells_.find(name);
  if (cell != cells_.end()) {
    return {.kind = PropertyName::Kind::Cell, .cell = cell->second};
  }
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return {};
  const auto instance = instances_.find(name.substr(0, dot));
  if (instance == instances_.end()) return {};
  const ElementKind& kind = *program_.instances[instance->second].kind;
  const std::string_view member = name.substr(dot + 1);
  PropertyName found = {.instance = instance->second};
  const std::string_view value =
      kind.family == ElementFamily::Timer ? "elapsed" : "value";
  if (member == "q" && !kind.done.empty()) {
    found.kind = PropertyName::Kind::Done;
  } else if (member == "fired" && !kind.done.empty()) {
    found.kind = PropertyName::Kind::Fired;
  } else if (member == value && !kind.value.empty()) {
    found.kind = PropertyName::Kind::Value;
  }
  return found;
}

std::string PropertyNames::suggestion(std::string_view name) const {
  constexpr int kMaxSuggestions = 50;
  if (++suggestions_ > kMaxSuggestions) return {};
  std::vector<std::string> members;
  for (const Instance& instance : program_.instances) {
    const ElementKind& kind = *instance.kind;
    if (!kind.done.empty()) {
      members.push_back(instance.name + ".q");
      members.push_back(instance.name + ".fired");
    }
    if (kind.value.empty()) continue;
    members.push_back(instance.name + (kind.family == ElementFamily::Timer
                                           ? ".elapsed"
                                           : ".value"));
  }
  std::vector<std::string_view> candidates;
  for (const Cell& cell : program_.cells) candidates.push_back(cell.name);
  candidates.insert(candidates.end(), members.begin(), members.end());
  return did_you_mean(name, candidates);
}

bool FormulaChecker::check(const Slice& formula, bool inputs_only) {
  slice_ = formula;
  inputs_only_ = inputs_only;
  failed_ = false;
  formula_ = parse_formula(formula.text);
  if (!formula_.has_value()) {
    Slice at = formula.part(formula_.error_at);
    if (at.text.size() > 1) at = at.part(0, 1);
    report("RP061", at.where, formula_.error);
    return false;
  }
  values_.assign(formula_.nodes.size(), {});
  for (std::uint32_t i = 0; i < formula_.nodes.size() && !failed_; ++i) {
    visit(i);
  }
  operands_ = {formula_.root()};
  if (!failed_) need(Type::Bit, 0);
  return !failed_;
}

void FormulaChecker::fail(std::string_view code, const FormulaNode& node,
                          std::string message) {
  if (failed_) return;
  failed_ = true;
  report(code, slice_.part(node.begin, node.end).where, std::move(message));
}

void FormulaChecker::report(std::string_view code, SourceRange where,
                            std::string message) {
  sink_.report({.code = code,
                .severity = Severity::Error,
                .where = made_where_.has_value() ? made_where_ : where,
                .message = std::move(message)});
}

void FormulaChecker::need(Type type, std::uint32_t number) {
  if (value(number).type == type) return;
  const FormulaNode& node = formula_.nodes[operand(number)];
  const std::string text(slice_.part(node.begin, node.end).text);
  fail("RP063", node,
       type == Type::Bit
           ? "`" + text + "` is a word, and a bit is needed here"
           : "`" + text + "` is a bit, and a word is needed here");
}

void FormulaChecker::need_no_observation(std::uint32_t number) {
  if (!value(number).observed) return;
  const FormulaNode& node = formula_.nodes[operand(number)];
  fail("RP069", node,
       "`" + std::string(node.text) + "` can only be compared with a number");
}

void FormulaChecker::visit(std::uint32_t position) {
  const FormulaNode& node = formula_.nodes[position];
  operands_.resize(node.arguments);
  std::uint32_t root = position;
  for (std::uint32_t i = node.arguments; i-- > 0;) {
    operands_[i] = root - 1;
    root -= formula_.nodes[root - 1].size;
  }
  Value result;
  if (node.op == FormulaOp::Name) {
    result = name(node);
  } else if (node.op == FormulaOp::Number || node.op == FormulaOp::Bool) {
    result.type = node.op == FormulaOp::Number ? Type::Word : Type::Bit;
    result.constant = true;
    result.low = result.high = node.number;
  } else if (node.op == FormulaOp::Call) {
    result = call(node);
  } else if (is_comparison(node.op)) {
    result = comparison(node);
  } else if (node.op == FormulaOp::Choose) {
    result = choose(node);
  } else if (node.op == FormulaOp::Add || node.op == FormulaOp::Subtract ||
             node.op == FormulaOp::Multiply || node.op == FormulaOp::Negate) {
    result = arithmetic(node);
  } else {
    for (std::uint32_t i = 0; i < node.arguments; ++i) need(Type::Bit, i);
  }
  for (std::uint32_t i = 0; i < node.arguments; ++i) {
    result.only_cells = result.only_cells && value(i).only_cells;
    if (node.op == FormulaOp::Call) continue;
    result.history = std::max(result.history, value(i).history);
  }
  values_[position] = result;
}

FormulaChecker::Value FormulaChecker::name(const FormulaNode& node) {
  const PropertyName found = names_.find(node.text);
  Value result;
  switch (found.kind) {
    case PropertyName::Kind::Unknown:
      fail("RP062", node,
           "the program has no `" + std::string(node.text) + "`" +
               names_.suggestion(node.text));
      return result;
    case PropertyName::Kind::Cell: {
      const Cell& cell = program_.cells[found.cell];
      result.type = cell.type;
      result.low = cell.low;
      result.high = cell.high;
      if (inputs_only_ && cell.role != CellRole::Input) {
        fail("RP068", node,
             "`" + cell.name + "` is no input: an assumption is about inputs");
      }
      return result;
    }
    case PropertyName::Kind::Done:
    case PropertyName::Kind::Fired:
    case PropertyName::Kind::Value:
      break;
  }
  result.only_cells = false;
  if (found.kind == PropertyName::Kind::Value) {
    result.type = Type::Word;
    result.observed = true;
    result.instance = found.instance;
  }
  if (inputs_only_) {
    fail("RP068", node,
         "`" + std::string(node.text) +
             "` is no input: an assumption is about inputs");
  }
  return result;
}

FormulaChecker::Value FormulaChecker::call(const FormulaNode& node) {
  const std::string text(node.text);
  const Function* const function = find_function(node.text);
  Value result;
  if (function == nullptr) {
    std::vector<std::string_view> known;
    known.reserve(kFunctions.size());
    for (const Function& row : kFunctions) known.push_back(row.name);
    fail("RP062", node,
         "properties have no function `" + text + "`" +
             did_you_mean(node.text, known));
    return result;
  }
  if (node.arguments != 1) {
    fail("RP063", node, "`" + text + "` has one operand");
    return result;
  }
  if (function->bits_only) need(Type::Bit, 0);
  need_no_observation(0);
  if (text == "begin" && !value(0).only_cells) {
    fail("RP069", node,
         "`begin` is of signals: timers, counters and functions have no value "
         "of their own there");
  }
  result = value(0);
  result.only_cells = false;
  result.constant = false;
  // `once` keeps its operand's history to itself.
  result.history = text == "once" ? 0 : value(0).history + function->history;
  if (result.history > kMaxHistory) {
    fail("RP069", node,
         "this looks back more than " + std::to_string(kMaxHistory) + " scans");
  }
  return result;
}

FormulaChecker::Value FormulaChecker::comparison(const FormulaNode& node) {
  const bool equality =
      node.op == FormulaOp::Equal || node.op == FormulaOp::NotEqual;
  if (equality && value(0).type == Type::Bit && value(1).type == Type::Bit) {
    return {};
  }
  need(Type::Word, 0);
  need(Type::Word, 1);
  observe(value(0), value(1), formula_.nodes[operand(0)]);
  observe(value(1), value(0), formula_.nodes[operand(1)]);
  return {};
}

/// A saturating clock is exact only up to its cap, and the encoding of a
/// counter that counts down only above its floor: so both are compared with
/// numbers in that range, and nothing else.
void FormulaChecker::observe(const Value& observed, const Value& other,
                             const FormulaNode& node) {
  if (!observed.observed) return;
  const std::string text(node.text);
  if (!other.constant) {
    return fail("RP069", node,
                "`" + text + "` can only be compared with a number");
  }
  Instance& instance = program_.instances[observed.instance];
  const std::int64_t number = other.low;
  if (instance.kind->family == ElementFamily::Timer) {
    if (number >= kMaxClock) {
      return fail("RP069", node,
                  "`" + text +
                      "` is compared with more than a "
                      "year");
    }
    instance.clock_cap = std::max(instance.clock_cap, number + 1);
  } else if (number <= std::numeric_limits<std::int16_t>::min()) {
    fail("RP069", node,
         "`" + text +
             "` is compared with -32768 or less: so far down the "
             "count is not followed");
  }
}

FormulaChecker::Value FormulaChecker::arithmetic(const FormulaNode& node) {
  Value result;
  result.type = Type::Word;
  result.constant = true;
  for (std::uint32_t i = 0; i < node.arguments; ++i) {
    need(Type::Word, i);
    need_no_observation(i);
    result.constant = result.constant && value(i).constant;
  }
  if (failed_) return result;
  const Value& a = value(0);
  if (node.op == FormulaOp::Negate) {
    result.low = -a.high;
    result.high = -a.low;
    return result;
  }
  const Value& b = value(1);
  __int128 low = __int128{a.low} + b.low;
  __int128 high = __int128{a.high} + b.high;
  if (node.op == FormulaOp::Subtract) {
    low = __int128{a.low} - b.high;
    high = __int128{a.high} - b.low;
  } else if (node.op == FormulaOp::Multiply) {
    const std::array<__int128, 4> corners = {
        __int128{a.low} * b.low, __int128{a.low} * b.high,
        __int128{a.high} * b.low, __int128{a.high} * b.high};
    low = *std::min_element(corners.begin(), corners.end());
    high = *std::max_element(corners.begin(), corners.end());
  }
  if (low < -kMaxWord || high > kMaxWord) {
    fail("RP063", node, "the value of this can leave 53 bits");
    return result;
  }
  result.low = static_cast<std::int64_t>(low);
  result.high = static_cast<std::int64_t>(high);
  return result;
}

FormulaChecker::Value FormulaChecker::choose(const FormulaNode& /*node*/) {
  need(Type::Bit, 0);
  need(value(1).type, 2);
  need_no_observation(1);
  need_no_observation(2);
  Value result = value(1);
  result.constant = false;
  result.low = std::min(value(1).low, value(2).low);
  result.high = std::max(value(1).high, value(2).high);
  return result;
}

}  // namespace rung
