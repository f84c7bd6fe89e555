#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/rule.h"

namespace rung::testing {

/// One text, read and linted.
struct Linted {
  SourceSet sources;
  std::vector<Diagnostic> findings;  // of the readers too
  std::vector<Diagnostic> waived;
  RuleSummary summary;
  RuleSelection rules;  // set before: what is on
};

/// Who answers the rules' questions about a program.
using OracleMaker =
    std::function<std::unique_ptr<Oracle>(const Program&, TransitionSystem&)>;
OracleMaker explicit_oracle();
OracleMaker no_oracle();

/// Fills `linted`; returns it for convenience. A scan takes 100 ms, unless the
/// text says otherwise: so every state can be visited.
Linted& lint(std::string_view text, Linted& linted,
             const OracleMaker& make_oracle = explicit_oracle());

/// Is there a finding of that rule?
bool has_finding(const Linted& linted, std::string_view rule);

/// A line a finding, then its labels and its help, indented.
std::string to_text(const Linted& linted);

}  // namespace rung::testing
