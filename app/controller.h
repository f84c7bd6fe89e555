#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/options.h"
#include "rungproof_machine.h"

namespace rung {

/// The machine of `runtime/` with a program in bytes, which must outlive it.
struct LoadedMachine {
  explicit LoadedMachine(const std::string& program);
  LoadedMachine(const LoadedMachine&) = delete;
  LoadedMachine& operator=(const LoadedMachine&) = delete;

  /// 32-bit words; 0 where the bytes are no program.
  static std::uint32_t memory_words(const std::string& program);

  std::vector<std::uint32_t> memory;
  rungproof::Machine machine;
  rungproof::Refusal refusal;
};

/// A lowered program, in bytes, as an array for a sketch: called after the file
/// that is written, else after the program's.
std::string controller_header(const std::string& bytes, const Options& options);

/// What `lower --report` prints of it.
std::string controller_report(const std::string& bytes);

}  // namespace rung
