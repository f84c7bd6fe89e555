#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// Random choices as a list of numbers: what is generated is a function of the
/// tape, so a failure is shrunk by shrinking its tape. Past its end there are
/// only zeros, and 0 is always the simplest choice.
class Tape {
 public:
  explicit Tape(const std::vector<std::uint32_t>& numbers)
      : numbers_(numbers) {}
  std::uint32_t pick(std::uint32_t count) {
    if (at_ >= numbers_.size()) return 0;
    return numbers_[at_++] % count;
  }

 private:
  const std::vector<std::uint32_t>& numbers_;
  std::size_t at_ = 0;
};

/// `count` numbers from `seed` (splitmix64).
std::vector<std::uint32_t> random_tape(std::uint64_t seed, std::size_t count);

struct GeneratorOptions {
  std::uint32_t max_rungs = 8;
  std::uint32_t inputs = 4;
  bool words = true;
  bool long_presets = true;  // up to 2.5 s, else up to 0.03 s
};

struct GeneratedProgram {
  std::string_view dialect;
  std::string text;
};

/// A rung script of either dialect, with every operator and element that the
/// dialect has, shared indices, and calls in right operands.
GeneratedProgram generate_program(Tape& tape, const GeneratorOptions& options);

}  // namespace rung
