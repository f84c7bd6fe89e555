#include "check/terms.h"

#include <algorithm>
#include <initializer_list>

namespace rung::check {
namespace {

using Wide = __int128;

constexpr std::int64_t kFar = std::int64_t{1} << 62;

std::int64_t near(Wide value) {
  return static_cast<std::int64_t>(std::clamp<Wide>(value, -kFar, kFar));
}

struct Bounds {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

Bounds around(std::initializer_list<Wide> values) {
  return {near(std::min(values)), near(std::max(values))};
}

Bounds product(const Term& a, const Term& b) {
  const auto times = [](std::int64_t x, std::int64_t y) {
    return static_cast<Wide>(x) * y;
  };
  return around({times(a.low, b.low), times(a.low, b.high),
                 times(a.high, b.low), times(a.high, b.high)});
}

Bounds wrapped(std::int64_t bits) {
  const bool has_sign = bits < 0;
  const std::int64_t count = std::int64_t{1} << (has_sign ? -bits : bits);
  if (has_sign) return {-count / 2, count / 2 - 1};
  return {0, count - 1};
}

}  // namespace

std::size_t Terms::Hash::operator()(const Term& term) const {
  std::uint64_t hash = static_cast<std::uint64_t>(term.op);
  for (const std::uint64_t part :
       {std::uint64_t{term.a}, std::uint64_t{term.b}, std::uint64_t{term.c},
        static_cast<std::uint64_t>(term.value), std::uint64_t{term.word}}) {
    hash = (hash ^ part) * 0x9e37'79b9'7f4a'7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

void Terms::set_bounds(Term& term) const {
  if (!term.word || term.op == Op::State || term.op == Op::Input) return;
  const Term a = list_.empty() ? Term{} : list_[term.a];
  const Term b = list_.empty() ? Term{} : list_[term.b];
  Bounds bounds = {term.value, term.value};
  if (term.op == Op::Add) {
    bounds = {near(Wide{a.low} + b.low), near(Wide{a.high} + b.high)};
  } else if (term.op == Op::Subtract) {
    bounds = {near(Wide{a.low} - b.high), near(Wide{a.high} - b.low)};
  } else if (term.op == Op::Multiply) {
    bounds = product(a, b);
  } else if (term.op == Op::Divide) {
    bounds = around({0, a.low / term.value, a.high / term.value});
  } else if (term.op == Op::Wrap) {
    bounds = wrapped(term.value);
  } else if (term.op == Op::Choose) {
    const Term& c = list_[term.c];
    bounds = {std::min(b.low, c.low), std::max(b.high, c.high)};
    // The smaller one of two.
    if (a.op == Op::Less && a.a == term.b && a.b == term.c) {
      bounds.high = std::min(b.high, c.high);
    }
  }
  term.low = bounds.low;
  term.high = bounds.high;
}

Value Terms::add(Term term) {
  set_bounds(term);
  const auto [entry, is_new] =
      known_.try_emplace(term, static_cast<std::uint32_t>(list_.size()));
  if (is_new) {
    inexact_ =
        inexact_ || (term.word && (term.low < -kExact || term.high > kExact));
    list_.push_back(term);
  }
  return {this, entry->second};
}

Value Terms::bit(bool value) {
  return add({.op = Op::Bit, .value = value ? 1 : 0});
}

Value Terms::number(std::int64_t value) {
  return add({.op = Op::Number, .word = true, .value = value});
}

Value Terms::leaf(Op op, bool word, std::int64_t index, std::int64_t low,
                  std::int64_t high) {
  return add(
      {.op = op, .word = word, .value = index, .low = low, .high = high});
}

void Terms::set_leaf_bounds(std::uint32_t leaf, std::int64_t low,
                            std::int64_t high) {
  list_[leaf].low = low;
  list_[leaf].high = high;
}

Value Terms::make(Op op, bool word, Value a, Value b, Value c,
                  std::int64_t value) {
  return add({.op = op,
              .word = word,
              .a = a.id,
              .b = b.id,
              .c = c.id,
              .value = value});
}

namespace {

const Term& at(Value value) { return (*value.terms)[value.id]; }
bool is_bit(Value value, bool wanted) {
  return at(value).op == Op::Bit && (at(value).value != 0) == wanted;
}
Value same_list(Value a, std::int64_t b) { return a.terms->number(b); }

bool is_negation(Value a, Value b) {
  return at(a).op == Op::Not && at(a).a == b.id;
}
bool are_opposite(Value a, Value b) {
  return is_negation(a, b) || is_negation(b, a);
}

/// Two numbers whose sum is one.
bool are_small(Value a, Value b) {
  const auto is_small = [](const Term& term) {
    return term.op == Op::Number && term.value <= Terms::kExact &&
           term.value >= -Terms::kExact;
  };
  return is_small(at(a)) && is_small(at(b));
}

}  // namespace

Value operator~(Value a) {
  if (at(a).op == Op::Bit) return a.terms->bit(at(a).value == 0);
  if (at(a).op == Op::Not) return {a.terms, at(a).a};
  return a.terms->make(Op::Not, false, a);
}

Value operator&(Value a, Value b) {
  if (is_bit(a, false) || is_bit(b, true)) return a;
  if (is_bit(b, false) || is_bit(a, true)) return b;
  if (a.id == b.id) return a;
  if (are_opposite(a, b)) return a.terms->bit(false);
  return a.terms->make(Op::And, false, a, b);
}

Value operator|(Value a, Value b) {
  if (is_bit(a, true) || is_bit(b, false)) return a;
  if (is_bit(b, true) || is_bit(a, false)) return b;
  if (a.id == b.id) return a;
  if (are_opposite(a, b)) return a.terms->bit(true);
  return a.terms->make(Op::Or, false, a, b);
}

Value operator^(Value a, Value b) {
  if (a.id == b.id) return a.terms->bit(false);
  if (are_opposite(a, b)) return a.terms->bit(true);
  return a.terms->make(Op::Xor, false, a, b);
}

Value operator==(Value a, Value b) {
  if (!at(a).word) return ~(a ^ b);
  return a.terms->make(Op::Equal, false, a, b);
}

Value operator<(Value a, Value b) {
  return a.terms->make(Op::Less, false, a, b);
}
Value operator<=(Value a, Value b) {
  return a.terms->make(Op::LessEqual, false, a, b);
}
Value operator>(Value a, Value b) { return b < a; }
Value operator>=(Value a, Value b) { return b <= a; }
Value operator+(Value a, Value b) {
  if (are_small(a, b)) return same_list(a, at(a).value + at(b).value);
  return a.terms->make(Op::Add, true, a, b);
}
Value operator-(Value a, Value b) {
  if (are_small(a, b)) return same_list(a, at(a).value - at(b).value);
  return a.terms->make(Op::Subtract, true, a, b);
}
Value operator*(Value a, Value b) {
  return a.terms->make(Op::Multiply, true, a, b);
}
Value operator+(Value a, std::int64_t b) { return a + same_list(a, b); }
Value operator-(Value a, std::int64_t b) { return a - same_list(a, b); }
Value operator==(Value a, std::int64_t b) { return a == same_list(a, b); }
Value operator<(Value a, std::int64_t b) { return a < same_list(a, b); }
Value operator<=(Value a, std::int64_t b) { return a <= same_list(a, b); }
Value operator>(Value a, std::int64_t b) { return a > same_list(a, b); }
Value operator>=(Value a, std::int64_t b) { return a >= same_list(a, b); }

Value choose(Value condition, Value then, Value otherwise) {
  if (is_bit(condition, true) || then.id == otherwise.id) return then;
  if (is_bit(condition, false)) return otherwise;
  return condition.terms->make(Op::Choose, at(then).word, condition, then,
                               otherwise);
}

Value choose(Value condition, std::int64_t then, Value otherwise) {
  return choose(condition, same_list(otherwise, then), otherwise);
}

Value smaller(Value a, Value b) { return choose(a < b, a, b); }

}  // namespace rung::check
