#include "smt/words.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace rung {
namespace {

AigLit at(const Word& a, std::size_t bit) {
  return bit < a.size() ? a[bit] : a.back();
}

/// Sum modulo 2^width.
Word add_modulo(Aig& aig, const Word& a, const Word& b, AigLit carry,
                std::size_t width) {
  Word sum(width);
  for (std::size_t i = 0; i < width; ++i) {
    const AigLit x = at(a, i);
    const AigLit y = at(b, i);
    const AigLit half = aig.exclusive_or(x, y);
    sum[i] = aig.exclusive_or(half, carry);
    carry =
        aig.disjunction(aig.conjunction(x, y), aig.conjunction(half, carry));
  }
  return sum;
}

Word inverted(const Word& a) {
  Word result(a.size());
  std::transform(a.begin(), a.end(), result.begin(), aig_not);
  return result;
}

/// Drops bits that only repeat the sign.
Word trimmed(Word a) {
  while (a.size() > 1 && a[a.size() - 2] == a.back()) a.pop_back();
  return a;
}

}  // namespace

std::uint32_t word_width(std::int64_t low, std::int64_t high) {
  const auto magnitude = [](std::int64_t v) {
    return static_cast<std::uint64_t>(v < 0 ? ~v : v);
  };
  const auto bits =
      std::max(std::bit_width(magnitude(low)), std::bit_width(magnitude(high)));
  return static_cast<std::uint32_t>(bits) + 1;
}

Word word_constant(std::int64_t value) {
  Word word(word_width(value, value));
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool set = ((value >> std::min<std::size_t>(i, 63)) & 1) != 0;
    word[i] = set ? kAigTrue : kAigFalse;
  }
  return word;
}

Word word_resize(Word a, std::uint32_t width) {
  a.resize(width, a.back());
  return a;
}

Word word_add(Aig& aig, const Word& a, const Word& b) {
  return trimmed(
      add_modulo(aig, a, b, kAigFalse, std::max(a.size(), b.size()) + 1));
}

Word word_negate(Aig& aig, const Word& a) {
  return trimmed(
      add_modulo(aig, inverted(a), {kAigFalse}, kAigTrue, a.size() + 1));
}

Word word_multiply(Aig& aig, const Word& a, const Word& b) {
  const std::size_t width = a.size() + b.size();
  // The factor with more constant bits steers: each of those is no adder.
  const auto variable_bits = [](const Word& w) {
    return std::count_if(w.begin(), w.end(),
                         [](AigLit bit) { return bit > kAigTrue; });
  };
  const bool swap = variable_bits(a) < variable_bits(b);
  const Word& steer = swap ? a : b;
  const Word& other = swap ? b : a;
  Word sum(width, kAigFalse);
  for (std::size_t i = 0; i < steer.size(); ++i) {
    if (steer[i] == kAigFalse) continue;
    Word part(i, kAigFalse);
    for (AigLit bit : other) part.push_back(aig.conjunction(bit, steer[i]));
    // The sign bit weighs -2^i.
    const bool minus = i + 1 == steer.size();
    sum = add_modulo(aig, sum, minus ? inverted(part) : part,
                     minus ? kAigTrue : kAigFalse, width);
  }
  return trimmed(sum);
}

Word word_divide(Aig& aig, const Word& a, std::int64_t divisor) {
  assert(divisor != 0);
  const Word magnitude = word_choose(aig, a.back(), word_negate(aig, a), a);
  // Long division of the magnitudes, one quotient bit at a time.
  const std::int64_t by = divisor < 0 ? -divisor : divisor;
  const Word minus_by = word_constant(-by);
  Word quotient(magnitude.size(), kAigFalse);
  Word rest = {kAigFalse};
  for (std::size_t i = magnitude.size() - 1; i-- > 0;) {
    rest.insert(rest.begin(), magnitude[i]);
    const Word reduced = word_add(aig, rest, minus_by);
    quotient[i] = aig_not(reduced.back());
    rest = word_choose(aig, quotient[i], reduced, rest);
    // 0 <= rest < by, so the sign is known.
    rest = word_resize(std::move(rest), word_width(0, by - 1));
    rest.back() = kAigFalse;
  }
  const AigLit minus = divisor < 0 ? aig_not(a.back()) : a.back();
  return trimmed(word_choose(aig, minus, word_negate(aig, quotient), quotient));
}

Word word_choose(Aig& aig, AigLit condition, const Word& then,
                 const Word& otherwise) {
  Word result(std::max(then.size(), otherwise.size()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = aig.choose(condition, at(then, i), at(otherwise, i));
  }
  return trimmed(std::move(result));
}

AigLit word_equal(Aig& aig, const Word& a, const Word& b) {
  AigLit equal = kAigTrue;
  for (std::size_t i = std::max(a.size(), b.size()); i-- > 0;) {
    equal =
        aig.conjunction(equal, aig_not(aig.exclusive_or(at(a, i), at(b, i))));
  }
  return equal;
}

AigLit word_less(Aig& aig, const Word& a, const Word& b) {
  const std::size_t sign = std::max(a.size(), b.size()) - 1;
  AigLit less = kAigFalse;
  for (std::size_t i = 0; i < sign; ++i) {
    const AigLit differ = aig.exclusive_or(at(a, i), at(b, i));
    less = aig.choose(differ, at(b, i), less);
  }
  const AigLit differ = aig.exclusive_or(at(a, sign), at(b, sign));
  return aig.choose(differ, at(a, sign), less);
}

}  // namespace rung
