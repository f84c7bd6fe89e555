#include "analysis/rollover.h"
#include "analysis/rules/support.h"
#include "analysis/rules/twin.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A timer that does something else when the controller's clock of 32 bits begins
anew, after 49.7 days: in the yun dialect a run shows an output that changes by
it; of plcLib it is the call of a timer that compares the clock itself.

## Why it matters
It works on the bench and in every test. On the fiftieth day an output drops for
the length of the preset, or a delay ends at once.

## Example
Bad:

    //@ dialect yun
    y0 = TR(0, !pin2);
    pin3 = T(0, 5, pin2);

Good:

    //@ dialect yun
    y0 = TR(0, !pin2 || y1);
    y1 = T(0, 5, pin2);
    pin3 = y1 && pin4;

## Limits
Runs are tried, in which inputs are held for 50 days: nothing found says
nothing. `--rollover` makes the clock part of every proof (docs/rollover.md).
)md";

/// The library of the thesis computes `now > start + period`.
void report_comparisons(RuleRun& run) {
  for (const ElementCall& call : run.program.calls) {
    const Instance& instance = run.program.instances[call.instance];
    if (instance.kind->id != "timer-plclib") continue;
    run.report(call.where,
               quoted(instance.name) +
                   " compares the clock itself: when it begins anew, after "
                   "49.7 days, the time is over at once or does not end",
               {.help = "by the library's own text: `millis() > start + "
                        "period`"});
  }
}

void report_parting(RuleRun& run, const Parting& parting) {
  const std::span<const std::uint32_t> writers =
      run.index.writers[parting.cell.index()];
  if (writers.empty()) return;
  run.report(run.program.rungs[RungId(writers.back())].where,
             quoted(run.program, parting.cell) +
                 " changes when the controller's clock begins anew, after "
                 "49.7 days",
             {.help = parting_text(run.program, parting)});
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  report_comparisons(run);
  Program rolling = run.program;
  if (!use_rollover(rolling)) return;
  constexpr std::uint64_t kWork = 1'000'000;
  const std::optional<Parting> parting =
      find_parting(run.program, rolling, kRolloverMs + kRolloverMs / 64, kWork);
  if (parting) report_parting(run, *parting);
}

}  // namespace

constinit const Rule clock_rollover = {
    "RP514", "clock-rollover", Severity::Warning, Decision::Solver, kDoc,
    check,   Pack::Safety};

}  // namespace rung
