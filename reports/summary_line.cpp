#include "reports/summary_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/explain.h"

namespace rung {
namespace {

/// "10 proved, 1 violated": the verdicts that occur.
std::string verdict_counts(const Summary& summary) {
  std::string out;
  const auto add = [&](std::size_t count, std::string_view word) {
    if (count > 0) {
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, word);
    }
  };
  add(summary.proved, "proved");
  add(summary.violated, "violated");
  add(summary.bounded, "bounded");
  add(summary.vacuous, "vacuous");
  add(summary.unknown, "unknown");
  return out;
}

std::string finding_counts(const Summary& summary) {
  std::string out;
  const auto add = [&](std::size_t count, std::string_view noun) {
    if (count > 0) out += (out.empty() ? "" : ", ") + quantity(count, noun);
  };
  add(summary.input_errors, "input error");
  add(summary.errors, "error");
  add(summary.warnings, "warning");
  add(summary.notes, "note");
  if (out.empty()) out = "no findings";
  if (summary.allowed > 0) out += fmt::format(", {} allowed", summary.allowed);
  if (summary.baselined > 0) {
    out += fmt::format(", {} in the baseline", summary.baselined);
  }
  return out;
}

/// What the programs were taken to mean. Scripts have one meaning, that of
/// their dialect.
std::string semantics_of(const Report& report) {
  std::vector<std::string_view> names;
  for (const FileReport& file : report.files) {
    const bool one = file.language == "script" || file.language == "postfix";
    if (one || !file.program || file.semantics.empty()) continue;
    if (std::find(names.begin(), names.end(), file.semantics) == names.end()) {
      names.push_back(file.semantics);
    }
  }
  return names.empty()
             ? ""
             : fmt::format(" under `{}` semantics", fmt::join(names, "`, `"));
}

}  // namespace

std::string summary_line(const Report& report, const Painter& paint) {
  const Summary summary = summarise(report);
  std::string out = "checked ";
  if (summary.read < summary.files) {
    out += fmt::format("{} of ", summary.read);
  }
  out += quantity(summary.files, "file") + ", " +
         quantity(summary.rungs, "rung") + semantics_of(report);
  if (report.proved) {
    if (summary.obligations == 0) {
      out += ", no obligations";
    } else if (summary.obligations == summary.proved) {
      out += ": " + paint(Ink::Good, summary.proved == 1
                                         ? "the obligation is proved"
                                         : fmt::format("all {} obligations "
                                                       "proved",
                                                       summary.proved));
    } else {
      out += ", " + quantity(summary.obligations, "obligation") + ": " +
             verdict_counts(summary);
    }
  }
  if (report.linted || summary.input_errors > 0) {
    out += "; " + finding_counts(summary);
  }
  if (summary.failures > 0) {
    out += "; " + quantity(summary.failures, "failed self-check");
  }
  return out;
}

std::string rule_counts(const Report& report) {
  constexpr std::size_t kMany = 20;  // fewer are seen at a glance
  std::map<std::string_view, std::size_t> counts;
  std::size_t all = 0;
  for (const FileReport& file : report.files) {
    for (const Diagnostic& finding : file.findings) {
      ++counts[rule_name(finding)];
      ++all;
    }
  }
  if (all < kMany || counts.size() < 2) return {};
  std::vector<std::pair<std::string_view, std::size_t>> sorted(counts.begin(),
                                                               counts.end());
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string out;
  for (const auto& [rule, count] : sorted) {
    out +=
        fmt::format("{}{} {}", out.empty() ? "by rule: " : ", ", count, rule);
  }
  return out + "\n";
}

}  // namespace rung
