#include "app/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "analysis/rule.h"
#include "app/options.h"
#include "base/text.h"
#include "smt/verify.h"

namespace rung {

void refuse(std::string_view name, std::string_view value,
            std::string_view expected) {
  throw BadValue(fmt::format("{}: `{}` is not {}", name, value, expected));
}

bool is_given(const Options& options, std::string_view option) {
  const std::string name = "--" + std::string(option);
  return std::any_of(options.given.begin(), options.given.end(),
                     [&](const auto& one) { return one.first == name; });
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

ScanInterval parse_scan(std::string_view name, std::string text) {
  const std::string written = text;
  const std::string_view expected =
      "MIN..MAX in whole milliseconds, 1 <= MIN <= MAX <= 2147483647";
  if (text.ends_with("ms")) text.resize(text.size() - 2);
  while (text.ends_with(' ')) text.pop_back();
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) refuse(name, written, expected);
  const auto low = whole_number(std::string_view(text).substr(0, dots));
  const auto high = whole_number(std::string_view(text).substr(dots + 2));
  if (!low || !high || *low < 1 || *low > *high || *high > kMaxScanMs) {
    refuse(name, written, expected);
  }
  return {*low, *high};
}

Severity parse_severity(std::string_view name, const std::string& text) {
  for (const Severity severity :
       {Severity::Note, Severity::Warning, Severity::Error}) {
    if (to_string(severity) == text) return severity;
  }
  refuse(name, text, "one of note, warning, error");
}

Pack parse_pack(std::string_view name, const std::string& text) {
  if (const auto pack = find_pack(text)) return *pack;
  refuse(name, text, "one of default, safety, pedantic");
}

double check_timeout(std::string_view name, double seconds) {
  if (!(seconds > 0) || seconds > 1e9) {
    refuse(name, fmt::format("{}", seconds), "a number of seconds above 0");
  }
  return seconds;
}

void check_engine(std::string_view name, const std::string& engine) {
  if (engine.empty()) return;
  std::string known;
  for (const EngineInfo& one : engines()) {
    if (one.name == engine) return;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", one.name);
  }
  refuse(name, engine, "one of " + known);
}

void check_recheck(std::string_view name, const std::string& checker) {
  if (checker.empty() || checker == "cvc5" || checker == "z3") return;
  refuse(name, checker, "a checker that is known: cvc5, z3");
}

RuleSetting parse_rule_setting(std::string_view name, const std::string& rule,
                               const std::string& severity) {
  RuleSetting setting;
  setting.rule = find_rule(rule);
  if (setting.rule == nullptr) {
    std::vector<std::string_view> known;
    for (const Rule* one : all_rules()) known.push_back(one->name);
    throw BadValue(
        fmt::format("{}: there is no rule `{}`{}; `rungproof rule` lists them",
                    name, rule, did_you_mean(rule, known)));
  }
  if (severity == "off") return setting;
  for (const Severity one :
       {Severity::Note, Severity::Warning, Severity::Error}) {
    if (to_string(one) == severity) setting.severity = one;
  }
  if (!setting.severity) {
    refuse(name, severity, "one of off, note, warning, error");
  }
  return setting;
}

RuleSelection make_selection(const std::vector<Pack>& packs,
                             const std::vector<RuleSetting>& settings) {
  RuleSelection selection(packs);
  for (const RuleSetting& one : settings) {
    selection.set(*one.rule, one.severity);
  }
  return selection;
}

}  // namespace rung
