#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rung {

/// Outputs, and which combinations of them some scan of some run ends with:
/// a digit for each output, 0 or 1, in the order of the outputs.
struct OutputGroup {
  std::vector<std::string> outputs;
  std::vector<std::string> combinations;  // sorted
  bool operator==(const OutputGroup&) const = default;
};

/// The most that may pass from P to Q; nothing: there is no such bound.
struct LockedResponse {
  std::string cause;
  std::string response;
  std::optional<std::int64_t> milliseconds;
  std::optional<std::int64_t> scans;
  bool operator==(const LockedResponse&) const = default;
};

/// What is proved of one program.
struct LockedProgram {
  std::string semantics;
  std::int64_t scan_min_ms = 0;
  std::int64_t scan_max_ms = 0;
  std::string slice;  // a digest of all that this depends on
  std::map<std::string, std::string> verdicts;  // by what the property says
  std::vector<OutputGroup> groups;
  std::string not_listed;  // why combinations of some outputs are not
  std::vector<LockedResponse> responses;
  bool operator==(const LockedProgram&) const = default;
};

/// By path, as seen from the lock's directory.
struct Lock {
  std::map<std::string, LockedProgram> programs;
  bool operator==(const Lock&) const = default;
};

inline constexpr std::string_view kLockName = "rungproof.lock";

std::string write_lock(const Lock& lock);
/// The lock in `text`, or what is wrong with it. Nothing is read of a text that
/// write_lock() would not write.
std::variant<Lock, std::string> read_lock(std::string_view text);

/// The name under which a lock at `lock_path` has a program.
std::string locked_path(const std::string& path, const std::string& lock_path);

}  // namespace rung
