#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer whose preset is no multiple of the scan time, where a line says that all
scans take the same time.

## Why it matters
A timer is looked at once a scan: 25 ms in scans of 10 ms are 30 ms. Tools round
in either direction.

## Example
Bad:

    //@ scan 10 ms
    Q0 = T(0, 0.025, I0);

Good:

    //@ scan 10 ms
    Q0 = T(0, 0.03, I0);

## Limits
Only with a fixed scan time. A preset shorter than a scan is told by
`preset-out-of-scan`.
)md";

void check(RuleRun& run) {
  const ScanInterval& scan = run.program.scan;
  if (scan.min_ms != scan.max_ms) return;
  for (const ElementCall& call : run.program.calls) {
    const Instance& instance = run.program.instances[call.instance];
    if (instance.kind->family != ElementFamily::Timer ||
        !call.operation->steps() || call.parameter < scan.max_ms ||
        call.parameter % scan.max_ms == 0) {
      continue;
    }
    const std::int64_t scans = call.parameter / scan.max_ms + 1;
    run.report(call.where, "the preset of " + quoted(instance.name) +
                               " is no multiple of the scan time: " +
                               std::to_string(call.parameter) + " ms take " +
                               std::to_string(scans * scan.max_ms) + " ms");
  }
}

}  // namespace

constinit const Rule preset_not_multiple = {
    "RP515", "preset-not-multiple", Severity::Note, Decision::Syntax, kDoc,
    check,   Pack::Pedantic};

}  // namespace rung
