#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer whose preset is shorter than a scan may take, or longer than the
controller's clock runs before it wraps (2^32 ms, 49.7 days).

## Why it matters
A timer is looked at once a scan, so a shorter preset is no more exact than the
scan; one that is too long never comes to its end on a controller.

## Example
Bad:

    Q0 = T(0, 0.05, I0);

Good:

    Q0 = T(0, 0.5, I0);

## Limits
The longest scan is 100 ms unless a `//@ scan` line says otherwise; without such
a line the finding is a note. Preset 0 is
told by `zero-preset`.
)md";

constexpr std::int64_t kClockWraps = std::int64_t{1} << 32;

/// Does a line say how long a scan takes?
bool scan_is_declared(const RuleRun& run) {
  return std::any_of(
      run.program.annotations.begin(), run.program.annotations.end(),
      [](const AstAnnotation& line) { return line.text.starts_with("scan "); });
}

void check(RuleRun& run) {
  const bool declared = scan_is_declared(run);
  for (const ElementCall& call : run.program.calls) {
    const Instance& instance = run.program.instances[call.instance];
    if (instance.kind->family != ElementFamily::Timer ||
        call.operation->resets || call.parameter == 0) {
      continue;
    }
    if (call.parameter < run.program.scan.max_ms) {
      run.report(call.where,
                 "the preset of " + quoted(instance.name) +
                     " is shorter than a scan may take (" +
                     std::to_string(run.program.scan.max_ms) + " ms)",
                 {.help = "`//@ scan MIN..MAX ms` says how long a scan takes",
                  .downgrade = !declared});
    } else if (call.parameter >= kClockWraps) {
      run.report(call.where, "the preset of " + quoted(instance.name) +
                                 " is longer than the clock of a controller");
    }
  }
}

}  // namespace

constinit const Rule preset_out_of_scan = {
    "RP502", "preset-out-of-scan", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
