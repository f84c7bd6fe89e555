#include "check/lemma.h"

#include <array>
#include <vector>

namespace rung::check {
namespace {

enum class Sign : std::uint8_t {
  Open,
  Wrap,
  Question,
  Choose,
  Or,
  And,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Not,
};

struct Infix {
  std::string_view text;
  Sign sign;
  int strength;
};

// The longest spelling first.
constexpr std::array<Infix, 12> kInfixes = {{
    {"||", Sign::Or, 2},
    {"&&", Sign::And, 3},
    {"==", Sign::Equal, 4},
    {"!=", Sign::NotEqual, 4},
    {"<=", Sign::LessEqual, 4},
    {">=", Sign::GreaterEqual, 4},
    {"<", Sign::Less, 4},
    {">", Sign::Greater, 4},
    {"+", Sign::Add, 5},
    {"-", Sign::Subtract, 5},
    {"*", Sign::Multiply, 6},
    {"/", Sign::Divide, 6},
}};
constexpr int kPrefix = 7;
constexpr std::size_t kMostDigits = 16;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Reader {
 public:
  Reader(std::string_view text, const Names& names, Terms& terms)
      : rest_(text), names_(names), terms_(terms) {}

  Lemma read() {
    if (rest_.ends_with(" ...")) return {{}, "it is cut off", true};
    while (error_.empty()) {
      skip_blanks();
      if (rest_.empty()) break;
      if (wants_operand_) {
        operand();
      } else {
        after_operand();
      }
    }
    return finish();
  }

 private:
  struct Pending {
    Sign sign = Sign::Open;
    int strength = 0;
  };

  void skip_blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  void fail(std::string what) {
    if (error_.empty()) error_ = std::move(what);
  }
  std::string where() const {
    return "`" + std::string(rest_.substr(0, 40)) + "`";
  }
  bool is_word(Value value) const { return terms_[value.id].word; }

  void push(Value value) {
    values_.push_back(value);
    wants_operand_ = false;
  }

  // A name first: one may begin like a sign.
  void operand() {
    const std::size_t length = names_.longest(rest_);
    if (length > 0) return name(length);
    if (take("!")) return pending_.push_back({Sign::Not, kPrefix});
    if (take("wrap16(")) return pending_.push_back({Sign::Wrap, 0});
    if (take("(")) return pending_.push_back({Sign::Open, 0});
    if (take("true")) return push(terms_.bit(true));
    if (take("false")) return push(terms_.bit(false));
    const bool negative = take("-");
    if (rest_.empty() || !is_digit(rest_.front())) {
      return fail("nothing is called " + where());
    }
    const std::int64_t value = number();
    push(terms_.number(negative ? -value : value));
  }

  std::int64_t number() {
    std::int64_t value = 0;
    std::size_t digits = 0;
    while (digits < rest_.size() && is_digit(rest_[digits])) {
      if (digits < kMostDigits) value = value * 10 + (rest_[digits] - '0');
      ++digits;
    }
    if (digits > kMostDigits) fail("a number is too long");
    rest_.remove_prefix(digits);
    return value;
  }

  void name(std::size_t length) {
    const std::string text(rest_.substr(0, length));
    const std::optional<Value> value = names_.find(text);
    if (!value) return fail("two things are called `" + text + "`");
    rest_.remove_prefix(length);
    if (!rest_.starts_with("[") || !is_word(*value)) return push(*value);
    rest_.remove_prefix(1);
    const std::int64_t bit = number();
    if (bit > 60 || !take("]")) return fail("`" + text + "` has no such bit");
    const Value low = terms_.make(Op::Wrap, true, *value, {}, {}, bit + 1);
    push(low >= (std::int64_t{1} << bit));
  }

  void after_operand() {
    if (take(")")) return close();
    if (take("?")) {
      reduce(2);
      pending_.push_back({Sign::Question, 0});
      wants_operand_ = true;
      return;
    }
    if (take(":")) return colon();
    for (const Infix& infix : kInfixes) {
      if (!take(infix.text)) continue;
      reduce(infix.strength);
      pending_.push_back({infix.sign, infix.strength});
      wants_operand_ = true;
      return;
    }
    fail("an operator is missing before " + where());
  }

  void close() {
    reduce(1);
    if (pending_.empty() || pending_.back().sign == Sign::Question) {
      return fail("`)` without `(`");
    }
    const Sign sign = pending_.back().sign;
    pending_.pop_back();
    if (sign != Sign::Wrap) return;
    if (!is_word(values_.back())) return fail("a bit is no number");
    values_.back() = terms_.make(Op::Wrap, true, values_.back(), {}, {}, -16);
  }

  void colon() {
    reduce(1);
    if (pending_.empty() || pending_.back().sign != Sign::Question) {
      return fail("`:` without `?`");
    }
    pending_.back() = {Sign::Choose, 1};
    wants_operand_ = true;
  }

  /// Applies what binds at least as tight as `strength`.
  void reduce(int strength) {
    while (error_.empty() && !pending_.empty() &&
           pending_.back().strength >= strength) {
      const Sign sign = pending_.back().sign;
      pending_.pop_back();
      apply(sign);
    }
  }

  Value pop() {
    const Value value = values_.back();
    values_.pop_back();
    return value;
  }

  void apply(Sign sign) {
    const Value b = pop();
    if (sign == Sign::Not) {
      if (is_word(b)) return fail("`!` of a number");
      return values_.push_back(~b);
    }
    const Value a = pop();
    if (sign == Sign::Choose) return apply_choice(a, b);
    const bool bits = sign == Sign::Or || sign == Sign::And;
    const bool either = sign == Sign::Equal || sign == Sign::NotEqual;
    if (is_word(a) != is_word(b) || (!either && is_word(a) == bits)) {
      return fail("a number where a bit is wanted, or a bit for a number");
    }
    values_.push_back(applied(sign, a, b));
  }

  void apply_choice(Value then, Value otherwise) {
    const Value condition = pop();
    if (is_word(condition) || is_word(then) != is_word(otherwise)) {
      return fail("a choice that is none");
    }
    values_.push_back(choose(condition, then, otherwise));
  }

  Value applied(Sign sign, Value a, Value b) {
    switch (sign) {
      case Sign::Or:
        return a | b;
      case Sign::And:
        return a & b;
      case Sign::Equal:
        return a == b;
      case Sign::NotEqual:
        return ~(a == b);
      case Sign::Less:
        return a < b;
      case Sign::LessEqual:
        return a <= b;
      case Sign::Greater:
        return a > b;
      case Sign::GreaterEqual:
        return a >= b;
      case Sign::Add:
        return a + b;
      case Sign::Subtract:
        return a - b;
      case Sign::Multiply:
        return a * b;
      default:
        return divided(a, b);
    }
  }

  Value divided(Value a, Value b) {
    const Term divisor = terms_[b.id];
    if (divisor.op != Op::Number || divisor.value == 0) {
      fail("a division by what is no number");
      return a;
    }
    return terms_.make(Op::Divide, true, a, {}, {}, divisor.value);
  }

  Lemma finish() {
    if (error_.empty() && wants_operand_) fail("it ends too early");
    if (error_.empty()) reduce(1);
    if (error_.empty() && !pending_.empty()) fail("`(` without `)`");
    if (error_.empty() && is_word(values_.back())) fail("it is a number");
    if (!error_.empty()) return {{}, error_, false};
    return {values_.back(), {}, false};
  }

  std::string_view rest_;
  const Names& names_;
  Terms& terms_;
  std::vector<Value> values_;
  std::vector<Pending> pending_;
  bool wants_operand_ = true;
  std::string error_;
};

}  // namespace

Lemma read_lemma(std::string_view text, Model& model) {
  return Reader(text, model.names, model.terms()).read();
}

Lemma read_condition(std::string_view text, Model& model) {
  return Reader(text, model.scan_names, model.terms()).read();
}

}  // namespace rung::check
