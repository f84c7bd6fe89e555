#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "smt/aig.h"
#include "smt/words.h"

namespace rung {

/// A graph evaluated for 64 independent cases at once, one a bit.
class Lanes {
 public:
  static constexpr std::uint32_t kCount = 64;

  explicit Lanes(const Aig& aig) : aig_(&aig) {}

  void set(AigLit leaf, std::uint64_t lanes);
  /// Writes a word's leaves of one lane; constant bits are left alone.
  void set(const Word& leaves, std::uint32_t lane, std::int64_t value);
  /// The same of all lanes: one value each.
  using Values = std::array<std::int64_t, kCount>;
  void set(const Word& leaves, const Values& values);
  Values values(const Word& word) const;
  /// Gates from node `first` on: those before it must be up to date.
  void evaluate(std::uint32_t first = 1);

  std::uint64_t value(AigLit a) const {
    return values_[aig_node(a)] ^ (aig_inverted(a) ? ~std::uint64_t{0} : 0);
  }
  std::int64_t value(const Word& word, std::uint32_t lane) const;

 private:
  const Aig* aig_;
  std::vector<std::uint64_t> values_;  // by node
};

}  // namespace rung
