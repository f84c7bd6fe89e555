#pragma once

#include <cstdint>
#include <unordered_map>

namespace rung {

/// A value for each state of a slice, by state index. It is as large as the
/// slice and not as the program: a plant asks of thousands of slices.
class SliceState {
 public:
  void set(std::uint32_t state, std::int64_t value) { values_[state] = value; }
  /// Precondition: it has a value.
  std::int64_t operator[](std::uint32_t state) const {
    return values_.at(state);
  }

 private:
  std::unordered_map<std::uint32_t, std::int64_t> values_;
};

}  // namespace rung
