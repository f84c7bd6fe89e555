#pragma once

#include <functional>
#include <string>

#include "analysis/rules/rule_run.h"

namespace rung {

/// A timer or counter call whose result is never true.
struct NeverTrue {
  CallId call;
  std::string name;    // `T(0)`
  std::string reason;  // ": its input is never true", or empty
  std::string proof;
};

/// Asks of every call that runs an element of the family (not of resets).
/// Calls that are never executed are left out.
void ask_never_true(
    RuleRun& run, ElementFamily family,
    const std::function<void(RuleRun&, const NeverTrue&)>& report);

}  // namespace rung
