#include "smt/script/numbers.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace rung::script {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 61;

/// Bits of two's complement, the sign's included.
std::size_t width(std::int64_t low, std::int64_t high) {
  const auto bits = [](std::int64_t value) {
    const auto magnitude =
        static_cast<std::uint64_t>(value < 0 ? -(value + 1) : value);
    return static_cast<std::size_t>(std::bit_width(magnitude)) + 1;
  };
  return std::max(bits(low), bits(high));
}

int bit(const Number& number, std::size_t i) {
  return number.bits[std::min(i, number.bits.size() - 1)];
}

std::int64_t floor_div(std::int64_t a, std::int64_t by) {
  return a >= 0 ? a / by : -((-a + by - 1) / by);
}

}  // namespace

/// The same value, of which it is known where it lies.
Number Numbers::within(Number number, std::int64_t low, std::int64_t high) {
  if (low < -kMost || high > kMost) {
    overflow_ = true;
    return constant(0);
  }
  number.bits.resize(width(low, high), number.bits.back());
  number.low = low;
  number.high = high;
  return number;
}

Number Numbers::constant(std::int64_t value) {
  Number number{{}, value, value};
  for (std::size_t i = 0; i < width(value, value); ++i) {
    number.bits.push_back(
        Gates::constant((value >> std::min<std::size_t>(i, 63) & 1) != 0));
  }
  return number;
}

Number Numbers::fresh(std::int64_t low, std::int64_t high) {
  if (low < -kMost || high > kMost || low > high) {
    overflow_ = true;
    return constant(0);
  }
  Number number;
  for (std::size_t i = 0; i < width(low, high); ++i) {
    number.bits.push_back(gates_->fresh());
  }
  if (low >= 0) number.bits.back() = -Gates::kTrue;
  // Compared as what its bits can be; only then is the range known.
  const auto span = std::int64_t{1} << (number.bits.size() - 1);
  number.low = low >= 0 ? 0 : -span;
  number.high = span - 1;
  gates_->require({-less(number, constant(low))});
  gates_->require({-less(constant(high), number)});
  number.low = low;
  number.high = high;
  return number;
}

/// Precondition: the interval of the sum was set by the caller.
Number Numbers::sum(const Number& a, const Number& b, int carry) {
  Number result;
  const std::size_t bits = std::max(a.bits.size(), b.bits.size()) + 1;
  for (std::size_t i = 0; i < bits; ++i) {
    const int x = bit(a, i);
    const int y = bit(b, i);
    result.bits.push_back(gates_->exclusive(gates_->exclusive(x, y), carry));
    carry = gates_->majority(x, y, carry);
  }
  return result;
}

Number Numbers::add(const Number& a, const Number& b) {
  return within(sum(a, b, -Gates::kTrue), a.low + b.low, a.high + b.high);
}

Number Numbers::negate(const Number& a) {
  Number flipped = a;
  for (int& literal : flipped.bits) literal = -literal;
  return within(sum(flipped, constant(0), Gates::kTrue), -a.high, -a.low);
}

Number Numbers::multiply(const Number& x, const Number& y) {
  const bool swapped = x.bits.size() < y.bits.size();
  const Number& a = swapped ? y : x;
  const Number& b = swapped ? x : y;
  if (a.bits.size() + b.bits.size() > 62) {
    overflow_ = true;
    return constant(0);
  }
  Number result = constant(0);
  for (std::size_t i = 0; i < b.bits.size(); ++i) {
    if (b.bits[i] == -Gates::kTrue) continue;
    Number part;
    part.bits.assign(i, -Gates::kTrue);
    for (const int literal : a.bits) {
      part.bits.push_back(gates_->conjunction(literal, b.bits[i]));
    }
    part.low = std::min<std::int64_t>(a.low, 0) * (std::int64_t{1} << i);
    part.high = std::max<std::int64_t>(a.high, 0) * (std::int64_t{1} << i);
    const bool sign = i + 1 == b.bits.size();
    result = add(result, sign ? negate(part) : part);
  }
  const std::int64_t corners[] = {a.low * b.low, a.low * b.high, a.high * b.low,
                                  a.high * b.high};
  const auto [low, high] =
      std::minmax_element(std::begin(corners), std::end(corners));
  return within(std::move(result), *low, *high);
}

Numbers::Quotient Numbers::divide(const Number& a, std::int64_t by) {
  const std::int64_t size = std::abs(by);
  Quotient result;
  if (std::has_single_bit(static_cast<std::uint64_t>(size))) {
    const auto shift = static_cast<std::size_t>(
        std::countr_zero(static_cast<std::uint64_t>(size)));
    Number quotient;
    for (std::size_t i = shift; i < a.bits.size() + shift; ++i) {
      quotient.bits.push_back(bit(a, i));
    }
    Number remainder;
    for (std::size_t i = 0; i < shift; ++i) {
      remainder.bits.push_back(bit(a, i));
    }
    remainder.bits.push_back(-Gates::kTrue);
    result = {within(std::move(quotient), floor_div(a.low, size),
                     floor_div(a.high, size)),
              within(std::move(remainder), 0, size - 1)};
  } else {
    result = {fresh(floor_div(a.low, size), floor_div(a.high, size)),
              fresh(0, size - 1)};
    const Number product = multiply(result.quotient, constant(size));
    gates_->require({equal(a, add(product, result.remainder))});
  }
  if (by < 0) result.quotient = negate(result.quotient);
  return result;
}

Number Numbers::choose(int condition, const Number& yes, const Number& no) {
  Number result;
  const std::size_t bits = std::max(yes.bits.size(), no.bits.size());
  for (std::size_t i = 0; i < bits; ++i) {
    result.bits.push_back(gates_->choice(condition, bit(yes, i), bit(no, i)));
  }
  result.low = std::min(yes.low, no.low);
  result.high = std::max(yes.high, no.high);
  return result;
}

int Numbers::less(const Number& a, const Number& b) {
  if (a.high < b.low) return Gates::kTrue;
  if (a.low >= b.high) return -Gates::kTrue;
  const std::size_t bits = std::max(a.bits.size(), b.bits.size());
  int result = -Gates::kTrue;
  for (std::size_t i = 0; i < bits; ++i) {
    const int x = bit(a, i);
    const int y = bit(b, i);
    const bool sign = i + 1 == bits;
    result = gates_->choice(gates_->exclusive(x, y), sign ? x : y, result);
  }
  return result;
}

int Numbers::equal(const Number& a, const Number& b) {
  if (a.high < b.low || b.high < a.low) return -Gates::kTrue;
  const std::size_t bits = std::max(a.bits.size(), b.bits.size());
  int result = Gates::kTrue;
  for (std::size_t i = 0; i < bits; ++i) {
    result =
        gates_->conjunction(result, -gates_->exclusive(bit(a, i), bit(b, i)));
  }
  return result;
}

}  // namespace rung::script
