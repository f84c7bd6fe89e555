#include "analysis/expr.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rung {
namespace {

std::int64_t saturate(__int128 value) {
  constexpr std::int64_t kLimit = ExprArena::kUnbounded;
  if (value > kLimit) return kLimit;
  if (value < -kLimit) return -kLimit;
  return static_cast<std::int64_t>(value);
}

constexpr std::int64_t kMin16 = -32768;
constexpr std::int64_t kMax16 = 32767;

std::int64_t wrapped16(std::int64_t value) {
  return static_cast<std::int16_t>(static_cast<std::uint64_t>(value) & 0xffff);
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e37'79b9'7f4a'7c15U + (hash << 6U) + (hash >> 2U);
  return hash * 0xff51'afd7'ed55'8ccdU;
}

std::uint64_t raw(ExprId id) { return id.has_value() ? id.index() + 1U : 0U; }

std::uint64_t hash_of(const Expr& expr) {
  std::uint64_t hash = static_cast<std::uint64_t>(expr.op) * 2U +
                       static_cast<std::uint64_t>(expr.type);
  hash = mix(hash, raw(expr.a));
  hash = mix(hash, raw(expr.b));
  hash = mix(hash, raw(expr.c));
  hash = mix(hash, expr.var.has_value() ? expr.var.index() + 1U : 0U);
  hash = mix(hash, static_cast<std::uint64_t>(expr.value));
  return hash ^ (hash >> 32U);
}

/// Bounds are a consequence of the term, not a part of its identity.
bool same_term(const Expr& left, const Expr& right) {
  return left.op == right.op && left.type == right.type && left.a == right.a &&
         left.b == right.b && left.c == right.c && left.var == right.var &&
         left.value == right.value;
}

}  // namespace

ExprArena::ExprArena() {
  table_.resize(1024);
  false_ = intern({.op = ExprOp::Constant, .value = 0, .low = 0, .high = 0});
  true_ = intern({.op = ExprOp::Constant, .value = 1, .low = 1, .high = 1});
}

ExprId ExprArena::intern(Expr expr) {
  if (exprs_.size() * 2 >= table_.size()) grow();
  const std::uint64_t mask = table_.size() - 1;
  std::uint64_t slot = hash_of(expr) & mask;
  for (; table_[slot] != 0; slot = (slot + 1) & mask) {
    Expr& found = exprs_[table_[slot] - 1];
    if (!same_term(found, expr)) continue;
    found.low = std::max(found.low, expr.low);
    found.high = std::min(found.high, expr.high);
    return ExprId(table_[slot] - 1);
  }
  exprs_.push_back(expr);
  table_[slot] = static_cast<std::uint32_t>(exprs_.size());
  return ExprId(static_cast<std::uint32_t>(exprs_.size() - 1));
}

/// By a factor of four: every growth reads all terms again.
void ExprArena::grow() {
  table_.assign(table_.size() * 4, 0);
  exprs_.reserve(table_.size() / 2);
  const std::uint64_t mask = table_.size() - 1;
  for (std::size_t i = 0; i < exprs_.size(); ++i) {
    std::uint64_t slot = hash_of(exprs_[i]) & mask;
    while (table_[slot] != 0) slot = (slot + 1) & mask;
    table_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

ExprId ExprArena::word(std::int64_t value) {
  return intern({.op = ExprOp::Constant,
                 .type = Type::Word,
                 .value = value,
                 .low = value,
                 .high = value});
}

ExprId ExprArena::variable(VarId var, Type type, std::int64_t low,
                           std::int64_t high) {
  return intern({.op = ExprOp::Variable,
                 .type = type,
                 .var = var,
                 .low = low,
                 .high = high});
}

ExprId ExprArena::negation(ExprId a) {
  const Expr& expr = exprs_[a.index()];
  assert(expr.type == Type::Bit);
  if (a == true_) return false_;
  if (a == false_) return true_;
  if (expr.op == ExprOp::Not) return expr.a;
  return intern({.op = ExprOp::Not, .a = a});
}

ExprId ExprArena::conjunction(ExprId a, ExprId b) {
  if (b < a) std::swap(a, b);
  if (a == false_ || b == false_) return false_;
  if (a == true_) return b;
  if (b == true_ || a == b) return a;
  const Expr& left = exprs_[a.index()];
  const Expr& right = exprs_[b.index()];
  assert(left.type == Type::Bit && right.type == Type::Bit);
  if (right.op == ExprOp::Not && right.a == a) return false_;
  if (left.op == ExprOp::Not && left.a == b) return false_;
  if (right.op == ExprOp::And && (right.a == a || right.b == a)) return b;
  if (left.op == ExprOp::And && (left.a == b || left.b == b)) return a;
  return intern({.op = ExprOp::And, .a = a, .b = b});
}

ExprId ExprArena::disjunction(ExprId a, ExprId b) {
  // One after the other: the order of arguments is the compiler's choice, and
  // terms are printed in the order in which they were made.
  const ExprId not_a = negation(a);
  const ExprId not_b = negation(b);
  return negation(conjunction(not_a, not_b));
}

ExprId ExprArena::implication(ExprId a, ExprId b) {
  return negation(conjunction(a, negation(b)));
}

ExprId ExprArena::exclusive_or(ExprId a, ExprId b) {
  if (a == b) return false_;
  if (b < a) std::swap(a, b);  // constants have the smallest ids
  if (a == false_) return b;
  if (a == true_) return negation(b);
  bool negated = false;
  if (exprs_[a.index()].op == ExprOp::Not) {
    a = exprs_[a.index()].a;
    negated = !negated;
  }
  if (exprs_[b.index()].op == ExprOp::Not) {
    b = exprs_[b.index()].a;
    negated = !negated;
  }
  if (a == b) return bit(negated);
  if (b < a) std::swap(a, b);
  const ExprId both = intern({.op = ExprOp::Xor, .a = a, .b = b});
  return negated ? negation(both) : both;
}

ExprId ExprArena::equivalence(ExprId a, ExprId b) {
  return negation(exclusive_or(a, b));
}

ExprId ExprArena::conjunction(const std::vector<ExprId>& terms) {
  ExprId result = true_;
  for (const ExprId term : terms) result = conjunction(result, term);
  return result;
}

ExprId ExprArena::disjunction(const std::vector<ExprId>& terms) {
  ExprId result = false_;
  for (const ExprId term : terms) result = disjunction(result, term);
  return result;
}

ExprId ExprArena::equal(ExprId a, ExprId b) {
  if (exprs_[a.index()].type == Type::Bit) return equivalence(a, b);
  return compare(ExprOp::Equal, a, b);
}

ExprId ExprArena::less(ExprId a, ExprId b) {
  return compare(ExprOp::Less, a, b);
}

/// A comparison of words, of which neither is taken apart.
ExprId ExprArena::compare_whole(ExprOp op, ExprId a, ExprId b) {
  const Expr& left = exprs_[a.index()];
  const Expr& right = exprs_[b.index()];
  assert(left.type == Type::Word && right.type == Type::Word);
  if (op == ExprOp::Less) {
    if (left.high < right.low) return true_;
    if (a == b || left.low >= right.high) return false_;
    return intern({.op = op, .a = a, .b = b});
  }
  if (a == b) return true_;
  if (left.high < right.low || right.high < left.low) return false_;
  if (is_constant(a) && is_constant(b)) return bit(left.value == right.value);
  // In one order, the constant, if there is one, on the right.
  const bool swapped = is_constant(a) || (b < a && !is_constant(b));
  return intern({.op = op, .a = swapped ? b : a, .b = swapped ? a : b});
}

/// Is it min(x, k)? Its comparison is the saturation's own.
bool ExprArena::is_minimum(const Expr& choice) const {
  const Expr& condition = exprs_[choice.a.index()];
  return condition.op == ExprOp::Less && condition.a == choice.b &&
         condition.b == choice.c;
}

/// `(c ? x : k) < m` is `c ? x < m : k < m`, which a constant k decides: what
/// a timer shows is then a term over bits and one comparison of its clock.
ExprId ExprArena::compare(ExprOp op, ExprId a, ExprId b) {
  constexpr std::size_t kMost = 16;  // choices of choices
  struct Peeled {
    ExprId condition;
    ExprId decided;
    bool then;  // the branch that is decided
  };
  std::vector<Peeled> peeled;
  const bool left = is_constant(b);
  ExprId rest = left ? a : b;
  const auto with = [&](ExprId x) {
    return left ? compare_whole(op, x, b) : compare_whole(op, a, x);
  };
  while (left != is_constant(a) && peeled.size() < kMost) {
    const Expr choice = exprs_[rest.index()];
    if (choice.op != ExprOp::Ite || is_minimum(choice)) break;
    const bool then = is_constant(choice.b);
    if (!then && !is_constant(choice.c)) break;
    peeled.push_back({choice.a, with(then ? choice.b : choice.c), then});
    rest = then ? choice.c : choice.b;
  }
  ExprId result = with(rest);
  for (auto one = peeled.rbegin(); one != peeled.rend(); ++one) {
    result = one->then ? ite(one->condition, one->decided, result)
                       : ite(one->condition, result, one->decided);
  }
  return result;
}

ExprId ExprArena::less_equal(ExprId a, ExprId b) {
  return negation(less(b, a));
}

bool ExprArena::is_number(ExprId id, std::int64_t value) const {
  const Expr& expr = exprs_[id.index()];
  return expr.op == ExprOp::Constant && expr.type == Type::Word &&
         expr.value == value;
}

// How readers write "x if c, else y": to_word(c) * x + to_word(!c) * y.

ExprId ExprArena::chosen_sum(ExprId a, ExprId b) {
  const Expr left = exprs_[a.index()];
  const Expr right = exprs_[b.index()];
  if (left.op != ExprOp::Ite || right.op != ExprOp::Ite || left.a != right.a) {
    return {};
  }
  if (is_number(left.c, 0) && is_number(right.b, 0)) {
    return ite(left.a, left.b, right.c);
  }
  if (is_number(left.b, 0) && is_number(right.c, 0)) {
    return ite(left.a, right.b, left.c);
  }
  return {};
}

ExprId ExprArena::chosen_product(ExprId choice, ExprId other) {
  const Expr expr = exprs_[choice.index()];
  if (expr.op != ExprOp::Ite) return {};
  if (is_number(expr.b, 1) && is_number(expr.c, 0)) {
    return ite(expr.a, other, word(0));
  }
  if (is_number(expr.b, 0) && is_number(expr.c, 1)) {
    return ite(expr.a, word(0), other);
  }
  return {};
}

ExprId ExprArena::add(ExprId a, ExprId b) {
  if (b < a) std::swap(a, b);
  const Expr& left = exprs_[a.index()];
  const Expr& right = exprs_[b.index()];
  assert(left.type == Type::Word && right.type == Type::Word);
  const std::int64_t low = saturate(__int128{left.low} + right.low);
  const std::int64_t high = saturate(__int128{left.high} + right.high);
  if (is_constant(a) && is_constant(b)) return word(low);
  if (is_constant(a) && left.value == 0) return b;
  if (is_constant(b) && right.value == 0) return a;
  if (const ExprId chosen = chosen_sum(a, b); chosen.has_value()) return chosen;
  return intern({.op = ExprOp::Add,
                 .type = Type::Word,
                 .a = a,
                 .b = b,
                 .low = low,
                 .high = high});
}

ExprId ExprArena::subtract(ExprId a, ExprId b) {
  if (a == b) return word(0);
  return add(a, negate(b));
}

ExprId ExprArena::negate(ExprId a) { return multiply(a, word(-1)); }

ExprId ExprArena::multiply(ExprId a, ExprId b) {
  if (b < a) std::swap(a, b);
  if (is_constant(a)) std::swap(a, b);
  const Expr left = exprs_[a.index()];
  const Expr right = exprs_[b.index()];
  const __int128 products[] = {
      __int128{left.low} * right.low, __int128{left.low} * right.high,
      __int128{left.high} * right.low, __int128{left.high} * right.high};
  const std::int64_t low =
      saturate(*std::min_element(std::begin(products), std::end(products)));
  const std::int64_t high =
      saturate(*std::max_element(std::begin(products), std::end(products)));
  if (is_constant(b)) {
    if (is_constant(a)) return word(low);
    if (right.value == 0) return b;
    if (right.value == 1) return a;
    const bool twice = left.op == ExprOp::Multiply && right.value == -1 &&
                       is_constant(left.b) &&
                       exprs_[left.b.index()].value == -1;
    if (twice) return left.a;
  }
  if (const ExprId product = chosen_product(a, b); product.has_value()) {
    return product;
  }
  if (const ExprId product = chosen_product(b, a); product.has_value()) {
    return product;
  }
  return intern({.op = ExprOp::Multiply,
                 .type = Type::Word,
                 .a = a,
                 .b = b,
                 .low = low,
                 .high = high});
}

ExprId ExprArena::divide(ExprId a, std::int64_t divisor) {
  assert(divisor != 0);
  const Expr left = exprs_[a.index()];
  if (divisor == 1) return a;
  if (divisor == -1) return negate(a);
  if (is_constant(a)) return word(left.value / divisor);
  const std::int64_t first = left.low / divisor;
  const std::int64_t last = left.high / divisor;
  return intern({.op = ExprOp::Divide,
                 .type = Type::Word,
                 .a = a,
                 .b = word(divisor),
                 .low = std::min(first, last),
                 .high = std::max(first, last)});
}

ExprId ExprArena::wrap16(ExprId a) {
  const Expr& expr = exprs_[a.index()];
  if (expr.low >= kMin16 && expr.high <= kMax16) return a;
  if (is_constant(a)) return word(wrapped16(expr.value));
  return intern({.op = ExprOp::Wrap16,
                 .type = Type::Word,
                 .a = a,
                 .low = kMin16,
                 .high = kMax16});
}

ExprId ExprArena::wrap_signed(ExprId a, std::int64_t bits) {
  if (bits == 16) return wrap16(a);
  if (bits == 8) return divide(wrap16(multiply(wrap16(a), word(256))), 256);
  // The upper half, rounded down, and the lower one, from 0.
  constexpr std::int64_t kHalf = 1 << 16;
  const std::int64_t low = exprs_[a.index()].low;
  const std::int64_t lift = low < 0 ? -(low / kHalf) + 1 : 0;
  const ExprId raised = add(a, word(lift * kHalf));
  const ExprId upper = subtract(divide(raised, kHalf), word(lift));
  const ExprId lower = add(wrap16(add(a, word(-kHalf / 2))), word(kHalf / 2));
  return add(multiply(wrap16(upper), word(kHalf)), lower);
}

ExprId ExprArena::wrap(ExprId a, std::int64_t bits, bool has_sign) {
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  const std::int64_t lowest = has_sign ? -half : 0;
  const Expr& expr = exprs_[a.index()];
  if (expr.low >= lowest && expr.high < lowest + 2 * half) return a;
  if (has_sign) return wrap_signed(a, bits);
  return add(wrap_signed(add(a, word(-half)), bits), word(half));
}

ExprId ExprArena::to_word(ExprId bit) { return ite(bit, word(1), word(0)); }

ExprId ExprArena::to_bit(ExprId word_id) {
  return negation(equal(word_id, word(0)));
}

ExprId ExprArena::minimum(ExprId a, ExprId b) { return ite(less(a, b), a, b); }

ExprId ExprArena::bit_ite(ExprId condition, ExprId then, ExprId otherwise) {
  if (is_constant(then) && is_constant(otherwise)) {
    return then == true_ ? condition : negation(condition);
  }
  if (then == true_ || then == condition) {
    return disjunction(condition, otherwise);
  }
  if (then == false_) return conjunction(negation(condition), otherwise);
  if (otherwise == true_) return implication(condition, then);
  if (otherwise == false_ || otherwise == condition) {
    return conjunction(condition, then);
  }
  return intern({.op = ExprOp::Ite, .a = condition, .b = then, .c = otherwise});
}

ExprId ExprArena::ite(ExprId condition, ExprId then, ExprId otherwise) {
  if (exprs_[condition.index()].op == ExprOp::Not) {
    condition = exprs_[condition.index()].a;
    std::swap(then, otherwise);
  }
  if (condition == true_ || then == otherwise) return then;
  if (condition == false_) return otherwise;
  if (exprs_[then.index()].type == Type::Bit) {
    return bit_ite(condition, then, otherwise);
  }
  const Expr& left = exprs_[then.index()];
  const Expr& right = exprs_[otherwise.index()];
  std::int64_t low = std::min(left.low, right.low);
  std::int64_t high = std::max(left.high, right.high);
  // min and max are tighter than the hull: without this no bound on a
  // saturating clock would be known.
  const Expr& test = exprs_[condition.index()];
  if (test.op == ExprOp::Less && test.a == then && test.b == otherwise) {
    high = std::min(left.high, right.high);
  }
  if (test.op == ExprOp::Less && test.a == otherwise && test.b == then) {
    low = std::max(left.low, right.low);
  }
  return intern({.op = ExprOp::Ite,
                 .type = Type::Word,
                 .a = condition,
                 .b = then,
                 .c = otherwise,
                 .low = low,
                 .high = high});
}

}  // namespace rung
