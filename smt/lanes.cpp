#include "smt/lanes.h"

#include <algorithm>

namespace rung {
namespace {

/// Rows to columns of a square of bits: bit j of word i becomes bit i of word
/// j. Source: Warren, "Hacker's Delight", 7-3.
void transpose(std::array<std::uint64_t, 64>& square) {
  std::uint64_t mask = 0xffff'ffffU;
  for (std::uint32_t width = 32; width != 0;
       width >>= 1U, mask ^= mask << width) {
    for (std::uint32_t i = 0; i < 64; i = ((i | width) + 1) & ~width) {
      const std::uint64_t swapped =
          (square[i] >> width ^ square[i | width]) & mask;
      square[i] ^= swapped << width;
      square[i | width] ^= swapped;
    }
  }
}

}  // namespace

void Lanes::set(AigLit leaf, std::uint64_t lanes) {
  if (values_.size() < aig_->size()) values_.resize(aig_->size(), 0);
  values_[aig_node(leaf)] = aig_inverted(leaf) ? ~lanes : lanes;
}

void Lanes::set(const Word& leaves, std::uint32_t lane, std::int64_t value) {
  if (values_.size() < aig_->size()) values_.resize(aig_->size(), 0);
  const std::uint64_t mask = std::uint64_t{1} << lane;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (aig_node(leaves[i]) == 0) continue;
    std::uint64_t& lanes = values_[aig_node(leaves[i])];
    const bool set = ((value >> std::min<std::size_t>(i, 63)) & 1) != 0;
    lanes = set ? lanes | mask : lanes & ~mask;
  }
}

void Lanes::set(const Word& leaves, const Values& values) {
  std::array<std::uint64_t, kCount> bits{};
  std::copy(values.begin(), values.end(), bits.begin());
  transpose(bits);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (aig_node(leaves[i]) != 0) {
      set(leaves[i], bits[std::min<std::size_t>(i, 63)]);
    }
  }
}

Lanes::Values Lanes::values(const Word& word) const {
  std::array<std::uint64_t, kCount> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bits[i] = value(word[std::min(i, word.size() - 1)]);
  }
  transpose(bits);
  Values values;
  std::copy(bits.begin(), bits.end(), values.begin());
  return values;
}

void Lanes::evaluate(std::uint32_t first) {
  values_.resize(aig_->size(), 0);
  for (std::uint32_t node = first; node < values_.size(); ++node) {
    if (!aig_->is_gate(node)) continue;
    values_[node] = value(aig_->left(node)) & value(aig_->right(node));
  }
}

std::int64_t Lanes::value(const Word& word, std::uint32_t lane) const {
  std::uint64_t bits = 0;
  std::uint64_t sign = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    sign = value(word[i]) >> lane & 1U;
    bits |= sign << i;
  }
  if (sign != 0 && word.size() < 64) bits |= ~std::uint64_t{0} << word.size();
  return static_cast<std::int64_t>(bits);
}

}  // namespace rung
