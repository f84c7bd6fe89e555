#include "analysis/rules/support.h"
#include "analysis/rules/suppress.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An `//@ allow` line that gives no reason, or that names no rule.

## Why it matters
Who reads the program later has to know why a finding is no mistake here. Such
a line suppresses nothing.

## Example
Bad:

    //@ allow set-without-reset
    Q0 = Q0 || I0;

Good:

    //@ allow set-without-reset: the alarm is cleared by cutting the power
    Q0 = Q0 || I0;

## Limits
That there is a text is checked, not what it says.
)md";

void check(RuleRun& run) {
  for (const AstAnnotation& annotation : run.program.annotations) {
    if (!is_allow(annotation.text)) continue;
    const Allow allow = parse_allow(annotation);
    if (allow.rules.empty()) {
      run.report(allow.where, "this line names no rule to allow",
                 {.help = "write `//@ allow NAME: reason`"});
    } else if (allow.reason.empty()) {
      run.report(allow.where, "no reason is given, so nothing is allowed",
                 {.help = "write `//@ allow NAME: reason`"});
    }
  }
}

}  // namespace

constinit const Rule allow_without_reason = {
    "RP801", "allow-without-reason", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
