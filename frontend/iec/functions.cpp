// Scope: the functions of the standard.

#include "frontend/iec/functions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/text.h"
#include "frontend/iec/scope.h"
#include "frontend/iec/token.h"

namespace rung::iec {
namespace {

enum class Code : std::uint8_t {
  Fold,     // a op b op c
  Pair,     // a op b
  Compare,  // a op b AND b op c
  Not,
  Absolute,
  Move,
  Select,
  Multiplex,
  Limit,
  Minimum,
  Maximum,
};

struct Function {
  std::string_view name;
  Code code = Code::Fold;
  Operator op = Operator::And;
};

// By name.
constexpr std::array<Function, 22> kFunctions = {{
    {"ABS", Code::Absolute},
    {"ADD", Code::Fold, Operator::Add},
    {"AND", Code::Fold, Operator::And},
    {"DIV", Code::Pair, Operator::Divide},
    {"EQ", Code::Compare, Operator::Equal},
    {"GE", Code::Compare, Operator::GreaterEqual},
    {"GT", Code::Compare, Operator::Greater},
    {"LE", Code::Compare, Operator::LessEqual},
    {"LIMIT", Code::Limit},
    {"LT", Code::Compare, Operator::Less},
    {"MAX", Code::Maximum},
    {"MIN", Code::Minimum},
    {"MOD", Code::Pair, Operator::Modulo},
    {"MOVE", Code::Move},
    {"MUL", Code::Fold, Operator::Multiply},
    {"MUX", Code::Multiplex},
    {"NE", Code::Pair, Operator::NotEqual},
    {"NOT", Code::Not},
    {"OR", Code::Fold, Operator::Or},
    {"SEL", Code::Select},
    {"SUB", Code::Pair, Operator::Subtract},
    {"XOR", Code::Fold, Operator::Xor},
}};

const Function* find_function(std::string_view upper_name) {
  const auto* const found =
      std::find_if(kFunctions.begin(), kFunctions.end(),
                   [&](const Function& it) { return it.name == upper_name; });
  return found == kFunctions.end() ? nullptr : found;
}

struct Conversion {
  const Type* from = nullptr;
  const Type* to = nullptr;
  bool from_bcd = false;
  bool to_bcd = false;
};

std::optional<Conversion> find_conversion(std::string_view name) {
  const std::size_t middle = name.find("_TO_");
  if (middle == std::string_view::npos) return std::nullopt;
  const std::string_view from = name.substr(0, middle);
  const std::string_view to = name.substr(middle + 4);
  Conversion result{find_type(from), find_type(to), from == "BCD", to == "BCD"};
  // A BCD number is the WORD that shows it.
  if (result.from_bcd) result.from = find_type("WORD");
  if (result.to_bcd) result.to = find_type("WORD");
  const bool twice = result.from_bcd && result.to_bcd;
  if (result.from == nullptr || result.to == nullptr || twice) {
    return std::nullopt;
  }
  return result;
}

constexpr std::size_t kMaxInputs = 100;

/// The place of an input with this name; kMaxInputs: there is none.
std::size_t place_of(Code code, std::string_view name) {
  const auto in = [&](std::initializer_list<std::string_view> names) {
    std::size_t at = 0;
    for (const std::string_view it : names) {
      if (it == name) return at;
      ++at;
    }
    return kMaxInputs;
  };
  if (code == Code::Select) return in({"G", "IN0", "IN1"});
  if (code == Code::Limit) return in({"MN", "IN", "MX"});
  if (code == Code::Not || code == Code::Absolute || code == Code::Move) {
    return in({"IN"});
  }
  if (code == Code::Multiplex && name == "K") return 0;
  if (!name.starts_with("IN")) return kMaxInputs;
  std::size_t number = 0;
  const std::string_view digits = name.substr(2);
  const auto [stop, problem] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (problem != std::errc() || stop != digits.data() + digits.size()) {
    return kMaxInputs;
  }
  const std::size_t place = code == Code::Multiplex ? number + 1 : number - 1;
  return std::min(place, kMaxInputs);
}

std::pair<std::size_t, std::size_t> counts_of(Code code) {
  switch (code) {
    case Code::Not:
    case Code::Absolute:
    case Code::Move:
      return {1, 1};
    case Code::Pair:
      return {2, 2};
    case Code::Select:
    case Code::Limit:
      return {3, 3};
    default:
      return {2, kMaxInputs};
  }
}

/// What a call of a standard function computes, from its inputs in order.
class Computation {
 public:
  Computation(Scope& scope, SourceRange where) : scope_(scope), where_(where) {}

  std::optional<Value> run(const Function& function,
                           std::vector<Value> inputs) {
    switch (function.code) {
      case Code::Fold:
      case Code::Pair:
        return fold(function.op, std::move(inputs));
      case Code::Compare:
        return compare(function.op, std::move(inputs));
      case Code::Not:
        return scope_.invert(std::move(inputs[0]), where_);
      case Code::Move:
        return std::move(inputs[0]);
      case Code::Absolute:
        return absolute(std::move(inputs[0]));
      case Code::Select:
        return select(std::move(inputs));
      case Code::Multiplex:
        return multiplex(std::move(inputs));
      case Code::Limit: {
        auto low = extreme(Operator::Less, std::move(inputs[1]), inputs[0]);
        if (!low) return std::nullopt;
        return extreme(Operator::Greater, std::move(*low), inputs[2]);
      }
      case Code::Minimum:
        return extreme_of(Operator::Greater, std::move(inputs));
      case Code::Maximum:
        return extreme_of(Operator::Less, std::move(inputs));
    }
    return std::nullopt;
  }

  std::optional<Value> convert(const Conversion& conversion, Value value) {
    const bool time = conversion.from->kind == Kind::Time ||
                      conversion.to->kind == Kind::Time;
    if (time && conversion.from != conversion.to) {
      scope_.fail("RP041", where_, "a conversion of TIME is not supported");
      return std::nullopt;
    }
    auto from = scope_.convert(std::move(value), *conversion.from, where_);
    if (!from) return std::nullopt;
    if (conversion.from_bcd) from = from_bcd(std::move(*from));
    if (conversion.to_bcd) return to_bcd(std::move(*from));
    return fit(std::move(*from), *conversion.to);
  }

 private:
  std::optional<Value> fold(Operator op, std::vector<Value> inputs) {
    std::optional<Value> result = std::move(inputs[0]);
    for (std::size_t i = 1; i < inputs.size() && result; ++i) {
      result =
          scope_.binary(op, std::move(*result), std::move(inputs[i]), where_);
    }
    return result;
  }

  std::optional<Value> compare(Operator op, std::vector<Value> inputs) {
    for (std::size_t i = 1; i + 1 < inputs.size(); ++i) {
      inputs[i] = scope_.once(std::move(inputs[i]), where_);
    }
    auto result = scope_.binary(op, inputs[0], inputs[1], where_);
    for (std::size_t i = 2; i < inputs.size() && result; ++i) {
      auto next = scope_.binary(op, inputs[i - 1], inputs[i], where_);
      if (!next) return std::nullopt;
      result = scope_.binary(Operator::And, std::move(*result),
                             std::move(*next), where_);
    }
    return result;
  }

  std::optional<Value> absolute(Value value) {
    value = scope_.once(std::move(value), where_);
    auto negative = scope_.binary(Operator::Less, value,
                                  scope_.number(0, kLiteral, where_), where_);
    auto opposite = scope_.negate(value, where_);
    if (!negative || !opposite) return std::nullopt;
    return scope_.choose(std::move(*negative), *opposite, value, where_);
  }

  std::optional<Value> select(std::vector<Value> inputs) {
    auto g = scope_.convert(std::move(inputs[0]), kBool, where_);
    if (!g || !same_type(inputs[1], inputs[2])) return std::nullopt;
    return scope_.choose(std::move(*g), inputs[2], inputs[1], where_);
  }

  bool same_type(Value& a, Value& b) {
    if (!scope_.unify(a, b, "a choice", where_)) return false;
    if (a.type != &kLiteral) return true;
    auto left = scope_.convert(std::move(a), kInt, where_);
    auto right = scope_.convert(std::move(b), kInt, where_);
    if (!left || !right) return false;
    a = std::move(*left);
    b = std::move(*right);
    return true;
  }

  // Behind the last input matiec gives 0.
  std::optional<Value> multiplex(std::vector<Value> inputs) {
    for (std::size_t i = 2; i < inputs.size(); ++i) {
      if (!same_type(inputs[1], inputs[i])) return std::nullopt;
    }
    const Value k = scope_.once(std::move(inputs[0]), where_);
    Value result = scope_.number(0, *inputs[1].type, where_);
    for (std::size_t i = inputs.size(); --i > 0;) {
      const auto number = static_cast<std::int64_t>(i - 1);
      auto here = scope_.binary(
          Operator::Equal, k, scope_.number(number, kLiteral, where_), where_);
      auto input = scope_.convert(std::move(inputs[i]), *result.type, where_);
      if (!here || !input) return std::nullopt;
      result = scope_.choose(std::move(*here), *input,
                             scope_.once(std::move(result), where_), where_);
    }
    return result;
  }

  /// `a op b ? b : a`.
  std::optional<Value> extreme(Operator op, Value a, Value b) {
    if (!same_type(a, b)) return std::nullopt;
    a = scope_.once(std::move(a), where_);
    b = scope_.once(std::move(b), where_);
    auto beyond = scope_.binary(op, a, b, where_);
    if (!beyond) return std::nullopt;
    return scope_.choose(std::move(*beyond), b, a, where_);
  }

  std::optional<Value> extreme_of(Operator op, std::vector<Value> inputs) {
    std::optional<Value> result = std::move(inputs[0]);
    for (std::size_t i = 1; i < inputs.size() && result; ++i) {
      result = extreme(op, std::move(*result), std::move(inputs[i]));
    }
    return result;
  }

  /// As C casts: what does not fit wraps; a number that is not 0 is TRUE.
  Value fit(Value value, const Type& to) {
    if (value.type == &to) return value;
    if (to.kind == Kind::Bool) {
      push_leaf(value.nodes, AstOp::Number, "0", where_);
      push_binary(value.nodes, AstOp::NotEqual, where_);
    } else if (value.type->kind == Kind::Bool) {
      push_conversion(value.nodes, "to_word", where_);
    } else if (!to.holds(value.type->low) || !to.holds(value.type->high)) {
      push_conversion(value.nodes, to.wrap, where_);
    }
    value.type = &to;
    value.constant.reset();
    value.symbol = nullptr;
    return value;
  }

  /// x + sum of factor * (x / divisor): how one base becomes another.
  Value digits(Value value, std::array<std::pair<int, int>, 3> terms,
               const Type& type) {
    value = scope_.once(std::move(value), where_);
    Value result = value;
    for (const auto& [factor, divisor] : terms) {
      push_all(result.nodes, value.nodes);
      push_leaf(result.nodes, AstOp::Number, number_text(divisor), where_);
      push_binary(result.nodes, AstOp::Divide, where_);
      push_leaf(result.nodes, AstOp::Number, number_text(factor), where_);
      push_binary(result.nodes, AstOp::Multiply, where_);
      push_binary(result.nodes, AstOp::Add, where_);
    }
    push_conversion(result.nodes, type.wrap, where_);
    result.type = &type;
    result.constant.reset();
    result.symbol = nullptr;
    return result;
  }

  std::string_view number_text(int number) {
    return scope_.writer().keep_text(std::to_string(number));
  }

  Value from_bcd(Value value) {
    return digits(std::move(value), {{{-6, 16}, {-60, 256}, {-600, 4096}}},
                  kInt);
  }
  std::optional<Value> to_bcd(Value value) {
    if (value.type->kind != Kind::Integer) {
      scope_.fail("RP049", where_, "BCD of a BOOL");
      return std::nullopt;
    }
    return digits(std::move(value), {{{6, 10}, {96, 100}, {1536, 1000}}},
                  *find_type("WORD"));
  }

  Scope& scope_;
  SourceRange where_;
};

/// The inputs in their order; EN and ENO apart.
struct Inputs {
  std::vector<std::optional<Value>> values;
  std::optional<Value> enable;
  Argument* enabled = nullptr;
};

bool sort_inputs(Scope& scope, std::string_view name, Code code,
                 std::vector<Argument>& arguments, Inputs& inputs) {
  for (Argument& argument : arguments) {
    if (argument.name == "ENO" && argument.output) {
      inputs.enabled = &argument;
      continue;
    }
    if (argument.name == "EN" && !argument.output) {
      inputs.enable =
          scope.convert(std::move(argument.value), kBool, argument.where);
      if (!inputs.enable) return false;
      continue;
    }
    const std::size_t place = argument.name.empty()
                                  ? inputs.values.size()
                                  : place_of(code, argument.name);
    if (place >= kMaxInputs || argument.output) {
      scope.fail("RP049", argument.where,
                 quoted_excerpt(name) + " has no " +
                     (argument.output ? "output " : "input ") +
                     quoted_excerpt(argument.name));
      return false;
    }
    if (place >= inputs.values.size()) inputs.values.resize(place + 1);
    if (inputs.values[place]) {
      scope.fail("RP049", argument.where,
                 quoted_excerpt(argument.name) + " is given a second time");
      return false;
    }
    inputs.values[place] = std::move(argument.value);
  }
  return true;
}

/// Does a call of this function, null: a standard one, change a variable?
bool writes(const Pou* pou, const std::vector<Argument>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(),
                     [](const Argument& it) { return it.output; }) ||
         (pou != nullptr &&
          std::any_of(
              pou->variables.begin(), pou->variables.end(),
              [](const Variable& it) { return it.role == Role::InOut; }));
}

/// The inputs, all there; empty: it is the wrong number of them.
std::vector<Value> take_values(Inputs& inputs, Code code) {
  std::vector<Value> values;
  for (std::optional<Value>& value : inputs.values) {
    if (value) values.push_back(std::move(*value));
  }
  const auto [fewest, most] = counts_of(code);
  const bool fits = values.size() == inputs.values.size() &&
                    values.size() >= fewest && values.size() <= most;
  if (!fits) values.clear();
  return values;
}

}  // namespace

bool is_standard_function(std::string_view upper_name) {
  return find_function(upper_name) != nullptr ||
         find_conversion(upper_name).has_value();
}

bool Scope::is_function(std::string_view name) const {
  const Pou* const pou = expansion_->find_pou(name);
  return (pou != nullptr && pou->kind == PouKind::Function) ||
         is_standard_function(upper(name));
}

std::optional<Value> Scope::function(std::string_view name,
                                     std::vector<Argument> arguments,
                                     SourceRange where, bool alone) {
  const Pou* const pou = expansion_->find_pou(name);
  if (!alone && writes(pou, arguments)) {
    fail("RP049", where,
         quoted_excerpt(name) +
             " has outputs and stands inside of an expression: that is not "
             "supported");
    return std::nullopt;
  }
  if (pou != nullptr && pou->kind == PouKind::Function) {
    return own_function(*pou, std::move(arguments), where);
  }
  const std::string key = upper(name);
  const Function* const function = find_function(key);
  const auto conversion = find_conversion(key);
  if (function == nullptr && !conversion) {
    fail("RP041", where,
         "there is no function " + quoted_excerpt(name) +
             ", or it is not supported");
    return std::nullopt;
  }
  const Code code = function != nullptr ? function->code : Code::Move;
  Inputs inputs;
  if (!sort_inputs(*this, name, code, arguments, inputs)) return std::nullopt;
  auto values = take_values(inputs, code);
  if (values.empty()) {
    fail("RP049", where,
         quoted_excerpt(name) + " is given the wrong number of inputs");
    return std::nullopt;
  }
  Computation computation(*this, where);
  auto result = function != nullptr
                    ? computation.run(*function, std::move(values))
                    : computation.convert(*conversion, std::move(values[0]));
  if (!result) return std::nullopt;
  Value on = inputs.enable ? once(std::move(*inputs.enable), where, "en")
                           : bit(true, where);
  if (inputs.enabled != nullptr) {
    if (code == Code::Multiplex) {
      fail("RP049", where, "ENO of MUX is not supported");
      return std::nullopt;
    }
    Symbol* const target = inputs.enabled->variable;
    if (target == nullptr ||
        !write(*target, on, inputs.enabled->where, where)) {
      return std::nullopt;
    }
  }
  if (on.constant == 1) return result;
  // A function that is not executed gives 0, as in matiec.
  if (result->type == &kLiteral) {
    result = convert(std::move(*result), kInt, where);
    if (!result) return std::nullopt;
  }
  Value zero = number(0, *result->type, where);
  return choose(std::move(on), *result, zero, where);
}

}  // namespace rung::iec
