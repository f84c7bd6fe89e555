#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::check {

/// What a result file says of one property.
struct ClaimedProperty {
  std::string name;
  std::string kind;
  std::string text;
  std::string goal;  // "invariant", "reach", "recover"
  std::string verdict;
  bool has_certificate = false;
  std::uint32_t k = 0;
  std::vector<std::string> lemmas;
  std::vector<std::string> conditions;
  std::vector<std::string> ways;
};

/// A result of `rungproof check` or `rungproof prove` about one file, or of
/// `rungproof equiv` about two: then each output is a property of its name.
struct ClaimedResult {
  std::string error;  // it is no such result
  bool is_equivalence = false;
  bool is_settled = false;  // `equiv --settled`
  std::uint32_t delay = 0;  // scans by which the second program lags behind
  std::string language;
  std::string dialect;
  std::string semantics;
  std::int64_t scan_min_ms = 0;
  std::int64_t scan_max_ms = 0;
  std::vector<ClaimedProperty> properties;
};

/// Reads rungproof.result/1 and rungproof.equiv/1. Nothing in it is believed:
/// what it says of the program is compared with the source, and what it claims
/// is proved.
ClaimedResult read_result(std::string_view text);

}  // namespace rung::check
