#pragma once

#include <cstdint>
#include <vector>

#include "smt/aig.h"

namespace rung {

/// An integer as two's complement bits, least significant first; the last one
/// is the sign and repeats for ever. Never empty. Operations are exact: they
/// widen as far as their result may reach.
using Word = std::vector<AigLit>;

/// Bits that hold every value of [low, high], the sign included.
std::uint32_t word_width(std::int64_t low, std::int64_t high);

Word word_constant(std::int64_t value);
/// Sign-extends, or cuts: the value is kept modulo 2^width.
Word word_resize(Word a, std::uint32_t width);

Word word_add(Aig& aig, const Word& a, const Word& b);
Word word_negate(Aig& aig, const Word& a);
Word word_multiply(Aig& aig, const Word& a, const Word& b);
/// Truncates towards zero. Precondition: divisor is not 0.
Word word_divide(Aig& aig, const Word& a, std::int64_t divisor);
Word word_choose(Aig& aig, AigLit condition, const Word& then,
                 const Word& otherwise);
AigLit word_equal(Aig& aig, const Word& a, const Word& b);
AigLit word_less(Aig& aig, const Word& a, const Word& b);

}  // namespace rung
