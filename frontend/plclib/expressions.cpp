#include <utility>

#include "frontend/plclib/machine.h"

namespace rung::plclib {
namespace {

// A value is copied once for each operator around it.
constexpr std::size_t kDeepestExpression = 100;

struct Operator {
  std::string_view text;
  int weight;
};
constexpr std::array<Operator, 19> kBinary = {{{"*", 10},
                                               {"/", 10},
                                               {"%", 10},
                                               {"+", 9},
                                               {"-", 9},
                                               {"<<", 8},
                                               {">>", 8},
                                               {"<", 7},
                                               {"<=", 7},
                                               {">", 7},
                                               {">=", 7},
                                               {"==", 6},
                                               {"!=", 6},
                                               {"&", 5},
                                               {"^", 4},
                                               {"|", 3},
                                               {"&&", 2},
                                               {"||", 1},
                                               {"?", 0}}};
constexpr int kUnaryWeight = 11;

const Operator* find_binary(std::string_view text) {
  for (const Operator& row : kBinary) {
    if (row.text == text) return &row;
  }
  return nullptr;
}

/// An operator that waits for its right operand, or a bracket.
struct Pending {
  std::string_view text;  // "(": a bracket; "?": its second operand; ":"
  int weight = 0;
  bool unary = false;
  SourceRange where;
};

struct NamedNumber {
  std::string_view name;
  std::int64_t value;
};
constexpr std::array<NamedNumber, 7> kNumbers = {{{"true", 1},
                                                  {"false", 0},
                                                  {"HIGH", 1},
                                                  {"LOW", 0},
                                                  {"INPUT", 0},
                                                  {"OUTPUT", 1},
                                                  {"INPUT_PULLUP", 2}}};

/// Operators and operands of one expression, by weight.
class Builder {
 public:
  explicit Builder(Arithmetic& arithmetic) : arithmetic_(arithmetic) {}

  void push(Value value) { values_.push_back(std::move(value)); }
  bool failed() const { return !why_.empty(); }
  std::string_view code() const { return code_; }
  SourceRange where() const { return where_; }
  const std::string& why() const { return why_; }

  /// Where an operand is expected.
  bool take_prefix(std::string_view text, SourceRange where) {
    if (text.size() != 1 ||
        std::string_view("!-+(~").find(text) == std::string_view::npos) {
      return false;
    }
    pending_.push_back({text, kUnaryWeight, text != "(", where});
    if (pending_.size() > kDeepestExpression) {
      fail("RP059", where, "this expression is nested too deeply");
    }
    return true;
  }

  /// Behind an operand. False: the expression ends before `text`.
  bool take_operator(std::string_view text, SourceRange where, bool& has_left) {
    if (const Operator* const op = find_binary(text)) {
      // Of equal weight the left one binds first, but not of `?`.
      reduce_to(text == "?" ? 1 : op->weight);
      pending_.push_back({text, op->weight, false, where});
      has_left = false;
      return true;
    }
    if (text != ")" && text != ":") return false;
    const std::string_view opener = text == ")" ? "(" : "?";
    while (!failed() && !pending_.empty() && pending_.back().text != opener &&
           pending_.back().text != "(") {
      reduce();
    }
    if (failed() || pending_.empty() || pending_.back().text != opener) {
      return false;
    }
    if (text == ")") {
      pending_.pop_back();
    } else {
      pending_.back().text = ":";
      has_left = false;
    }
    return true;
  }

  std::optional<Value> finish() {
    while (!failed() && !pending_.empty()) reduce();
    if (failed()) return std::nullopt;
    return std::move(values_.back());
  }

 private:
  void fail(std::string_view code, SourceRange where, std::string why) {
    if (failed()) return;
    code_ = code;
    where_ = where;
    why_ = std::move(why);
  }

  void reduce_to(int weight) {
    while (!failed() && !pending_.empty() && pending_.back().text != "(" &&
           pending_.back().weight >= weight) {
      reduce();
    }
  }

  Value pop() {
    Value value = std::move(values_.back());
    values_.pop_back();
    return value;
  }

  std::optional<Value> chosen(Value otherwise, SourceRange where) {
    std::optional<Value> no = arithmetic_.settled(std::move(otherwise));
    std::optional<Value> yes = arithmetic_.settled(pop());
    std::optional<Value> condition = arithmetic_.settled(pop());
    if (!no || !yes || !condition) return std::nullopt;
    return arithmetic_.choose(std::move(*condition), std::move(*yes),
                              std::move(*no), where);
  }

  void reduce() {
    const Pending top = pending_.back();
    pending_.pop_back();
    if (top.text == "?" || top.text == "(") {
      return fail("RP056", top.where,
                  top.text == "?" ? "this `?` has no `:`"
                                  : "this bracket is not closed");
    }
    Value right = pop();
    std::optional<Value> result;
    if (top.unary) {
      result = arithmetic_.unary(top.text, std::move(right), top.where);
    } else if (top.text == ":") {
      result = chosen(std::move(right), top.where);
    } else {
      result = arithmetic_.binary(top.text, pop(), std::move(right), top.where);
    }
    if (!result) return fail("RP055", top.where, arithmetic_.why());
    values_.push_back(std::move(*result));
  }

  Arithmetic& arithmetic_;
  std::vector<Value> values_;
  std::vector<Pending> pending_;
  std::string_view code_;
  SourceRange where_;
  std::string why_;
};

}  // namespace

/// Does a call begin here that does more than to look?
bool Machine::at_effect() const {
  if (!cursor_.at_word()) return false;
  if (cursor_.at("(", 1)) {
    return find_call(cursor_.text()) != nullptr ||
           sketch_.find(cursor_.text()) != nullptr;
  }
  return cursor_.at(".", 1) && objects_.contains(cursor_.text()) &&
         cursor_.text(2) != "count" && cursor_.text(2) != "presetValue";
}

/// An expression, which may begin with a call: C++ does not say when an operand
/// is read that stands beside a call which changes it.
std::optional<Value> Machine::rvalue() {
  std::size_t negations = 0;
  const std::size_t begin = cursor_.position();
  while (cursor_.accept("!")) ++negations;
  if (!at_effect()) {
    cursor_.go_to(begin);
    return expression();
  }
  const SourceRange where = cursor_.here();
  if (sketch_.find(cursor_.text()) != nullptr) {
    fail("RP055", where,
         "the value of a function of the sketch is not supported");
    return std::nullopt;
  }
  std::optional<Value> value = call(true);
  if (!value) return std::nullopt;
  if (value->type == CType::Void) {
    fail("RP058", where, "this call has no value");
    return std::nullopt;
  }
  for (; negations > 0; --negations) {
    value = arithmetic_.unary("!", std::move(*value), where);
  }
  called_ = true;
  std::optional<Value> result = expression(std::move(value));
  called_ = false;
  return result;
}

std::optional<Value> Machine::expression(std::optional<Value> first) {
  Builder builder(arithmetic_);
  bool has_left = first.has_value();
  if (first) builder.push(std::move(*first));
  bool goes_on = true;
  while (goes_on && !builder.failed()) {
    const SourceRange where = cursor_.here();
    const bool symbol = cursor_.peek().kind == TokenKind::Symbol;
    const std::string_view text = symbol ? cursor_.text() : "";
    if (has_left) {
      goes_on = builder.take_operator(text, where, has_left);
      if (goes_on) cursor_.take();
    } else if (builder.take_prefix(text, where)) {
      cursor_.take();
    } else {
      std::optional<Value> value = operand();
      if (!value) return std::nullopt;
      builder.push(std::move(*value));
      has_left = true;
    }
  }
  std::optional<Value> value = builder.finish();
  if (!value) fail(builder.code(), builder.where(), builder.why());
  return value;
}

std::optional<Value> Machine::operand() {
  const SourceRange where = cursor_.here();
  if (cursor_.peek().kind == TokenKind::Number) {
    const auto literal = read_literal(cursor_.text(), reading_.int_bits());
    if (!literal) {
      fail("RP056", where,
           cursor_.shown() + " is no whole number that is supported");
      return std::nullopt;
    }
    cursor_.take();
    return arithmetic_.number(literal->value, literal->type, where);
  }
  if (!cursor_.at_word()) {
    fail("RP056", where, "expected a value and found " + cursor_.shown());
    return std::nullopt;
  }
  if (at_effect()) {
    fail("RP055", where,
         "a call beside other operands is not supported: only an expression "
         "that begins with it");
    return std::nullopt;
  }
  if (cursor_.at("(", 1) || cursor_.at(".", 1)) return pure_call();
  return name_value();
}

std::optional<Value> Machine::name_value() {
  const SourceRange where = cursor_.here();
  std::optional<Value> value = named_value(cursor_.text(), where);
  if (!value) return std::nullopt;
  if (called_ && !value->constant()) {
    fail("RP055", where,
         "a variable beside a call is not supported: C++ does not say which "
         "comes first");
    return std::nullopt;
  }
  cursor_.take();
  return value;
}

/// What the name of a variable, a constant or a pin is worth: a pin is its
/// number.
std::optional<Value> Machine::named_value(std::string_view name,
                                          SourceRange where) {
  const auto counter = counters_.find(name);
  if (counter != counters_.end()) {
    return arithmetic_.number(*counter->second.constant(), counter->second.type,
                              where);
  }
  if (name == "scanValue" && !in_setup_) {
    keep_accumulator();
    Value value = acc_;
    value.where = where;
    return value;
  }
  for (const NamedNumber& row : kNumbers) {
    if (row.name == name)
      return arithmetic_.number(row.value, CType::Int, where);
  }
  const auto found = variables_.find(name);
  if (found == variables_.end()) {
    if (const auto pin = pin_number(name)) {
      return arithmetic_.number(*pin, CType::Int, where);
    }
    fail("RP057", where, "there is no variable " + quoted_excerpt(name));
    return std::nullopt;
  }
  const Variable& variable = found->second;
  if (variable.timer) {
    fail("RP058", where,
         quoted_excerpt(name) +
             " holds the start of a timer: its value is "
             "not supported");
    return std::nullopt;
  }
  if (in_setup_) {
    return arithmetic_.number(variable.initial, variable.type, where);
  }
  const Range range = estimate(name, variable);
  if (range.low == range.high) {
    return arithmetic_.number(range.low, variable.type, where);
  }
  return Arithmetic::cell(name, is_word(name, variable), range, variable.type,
                          where);
}

/// A call that only looks: `digitalRead(X0)`, `counter1.count()`.
std::optional<Value> Machine::pure_call() {
  const SourceRange where = cursor_.here();
  const std::string_view name = cursor_.text();
  const auto object = objects_.find(name);
  if (cursor_.at(".", 1) && object != objects_.end()) {
    const bool preset = cursor_.text(2) == "presetValue";
    if (called_) {
      fail("RP055", where,
           "two calls in one expression: C++ does not say which comes first");
      return std::nullopt;
    }
    for (int i = 0; i < 3; ++i) cursor_.take();
    if (object->second.kind != ObjectKind::Counter) {
      fail("RP058", where, quoted_excerpt(name) + " has no such value");
      return std::nullopt;
    }
    if (!expect("(") || !expect(")")) return std::nullopt;
    return preset ? arithmetic_.number(object->second.preset, CType::Unsigned,
                                       where)
                  : count_of(object->second, where);
  }
  const bool digital = name == "digitalRead";
  if (in_setup_ || called_ || (!digital && name != "analogRead")) {
    fail("RP055", where,
         "the call of " + cursor_.shown() + " is not supported here");
    return std::nullopt;
  }
  cursor_.take();
  cursor_.take();
  Argument argument;
  argument.name = cursor_.text();
  argument.where = cursor_.here();
  cursor_.take();
  if (!expect(")")) return std::nullopt;
  Pin* const pin = pin_of(argument);
  if (pin == nullptr) return std::nullopt;
  return sample(*pin, !digital, where);
}

std::optional<std::int64_t> Machine::constant_expression(
    std::string_view what) {
  const SourceRange where = cursor_.here();
  const std::optional<Value> value = expression();
  if (!value) return std::nullopt;
  const auto constant = value->constant();
  if (!constant) {
    fail("RP055", where,
         std::string(what) + " that is not constant is not supported");
  }
  return constant;
}

/// The arguments of a call, behind its opening bracket and with the closing
/// one.
std::optional<std::vector<Machine::Argument>> Machine::arguments() {
  std::vector<Argument> result;
  if (cursor_.accept(")")) return result;
  do {
    Argument argument;
    argument.where = cursor_.here();
    const bool name =
        cursor_.at_word() && (cursor_.at(",", 1) || cursor_.at(")", 1));
    if (name) {
      argument.name = cursor_.text();
      cursor_.take();
    } else {
      std::optional<Value> value = expression();
      if (!value) return std::nullopt;
      argument.value = std::move(*value);
    }
    result.push_back(std::move(argument));
  } while (cursor_.accept(","));
  if (!expect(")")) return std::nullopt;
  return result;
}

}  // namespace rung::plclib
