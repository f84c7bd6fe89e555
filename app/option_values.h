#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/rule_selection.h"
#include "base/diagnostic.h"

namespace rung {

/// A value that is wrong: what() names it and says what it should have been.
class BadValue : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the command line and the configuration both may set. `name` is how it
/// is called there: `--scan`, or `scan`.
/// Errors: BadValue.
[[noreturn]] void refuse(std::string_view name, std::string_view value,
                         std::string_view expected);

/// `1..100`, also with a unit as the property line has it: `1..100ms`.
ScanInterval parse_scan(std::string_view name, std::string text);
Severity parse_severity(std::string_view name, const std::string& text);
Pack parse_pack(std::string_view name, const std::string& text);
double check_timeout(std::string_view name, double seconds);
void check_engine(std::string_view name, const std::string& engine);
void check_recheck(std::string_view name, const std::string& checker);

/// What a rule is set to.
struct RuleSetting {
  const Rule* rule = nullptr;
  std::optional<Severity> severity;  // nothing: off
};
/// `rule` by name or code; `severity` also `off`.
RuleSetting parse_rule_setting(std::string_view name, const std::string& rule,
                               const std::string& severity);
RuleSelection make_selection(const std::vector<Pack>& packs,
                             const std::vector<RuleSetting>& settings);

/// A whole number and nothing else.
std::optional<std::int64_t> whole_number(std::string_view text);
inline constexpr std::int64_t kMaxScanMs = 2147483647;

}  // namespace rung
