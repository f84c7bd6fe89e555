#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An `//@ allow` line that suppresses nothing: the finding is gone, it is on
another line, or no rule has that name.

## Why it matters
A line that outlives its finding would hide the next one.

## Example
Bad:

    //@ allow double-coil: the second rung is the manual mode
    Q0 = I0 || I1;

Good:

    Q0 = I0;
    //@ allow double-coil: the second rung is the manual mode
    Q0 = I1;

## Limits
A comment covers the findings that begin on its line and, where it has a line of
its own, on the line below and in the rung below, of the rules that it names.
)md";

/// What is unused is known when every rule has spoken: see suppress().
void check(RuleRun& /*run*/) {}

}  // namespace

constinit const Rule unused_allow = {
    "RP802", "unused-allow", Severity::Warning, Decision::Syntax, kDoc, check};

}  // namespace rung
