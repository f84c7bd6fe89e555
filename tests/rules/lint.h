#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/rule.h"

namespace rung::testing {

/// One text, read and linted, with the explicit oracle and scans of 100 ms.
struct Linted {
  SourceSet sources;
  std::vector<Diagnostic> findings;  // of the readers too
  RuleSummary summary;
};

/// Fills `linted`; returns it for convenience.
Linted& lint(std::string_view text, Linted& linted, bool with_oracle = true);

/// Is there a finding of that rule?
bool has_finding(const Linted& linted, std::string_view rule);

/// A line a finding, then its labels and its help, indented.
std::string to_text(const Linted& linted);

}  // namespace rung::testing
