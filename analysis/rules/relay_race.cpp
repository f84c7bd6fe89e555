#include <vector>

#include "analysis/rules/sampling.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A cell that never comes to rest: in a run of the program, from some scan on with
all inputs held and no time passing, it changes again and again.

## Why it matters
The rungs contradict each other: the output flickers at the speed of the scan,
and what it drives wears out or does nothing.

## Example
Bad:

    Q0 = I0 && !Q1;
    Q1 = Q0;

Good:

    Q0 = I0 && !I1;
    Q1 = Q0;

## Limits
Races are searched by running the program from sampled states; what is found is
a race, but not every race is found. A cell that does not change in every single
scan is only noted: a sequence runs in circles as well when all its sensors are
true at once. So is a rung that only inverts itself (`M0 = !M0`). A blinker made
with timers is none: it waits for time to pass.
Source: Aiken, Faehndrich, Su, "Detecting races in relay ladder logic
programs", TACAS 1998.
)md";

std::string held_text(const RuleRun& run, const Unrest& unrest) {
  constexpr std::size_t kFew = 6;
  std::string text;
  for (const auto& [cell, value] : unrest.held) {
    if (unrest.held.size() > kFew) break;
    text += (text.empty() ? "seen with " : ", ") + quoted(run.program, cell) +
            " = " + std::to_string(value);
  }
  return text.empty() ? text : text + " held";
}

/// `M0 = !M0`: a clock that goes with the scan, and is meant to.
bool is_toggle(const RuleRun& run, const Rung& rung) {
  const Contact contact = contact_at(run.program, rung.root());
  return contact.cell == rung.target && contact.inverted;
}

void check(RuleRun& run) {
  if (!run.has_oracle) return;
  constexpr std::uint64_t kWork = 10'000'000;
  std::vector<bool> told(run.program.cells.size() +
                         run.program.instances.size());  // by component
  for (const Unrest& unrest : sample_unrest(run.ts, kWork)) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[unrest.cell.index()];
    // What only follows a racing cell, or shares its loop, is told with it.
    const std::uint32_t component = run.index.component[unrest.cell.index()];
    if (writers.empty() || !run.index.in_loop[unrest.cell.index()] ||
        told[component]) {
      continue;
    }
    told[component] = true;
    const Rung& rung = run.program.rungs[RungId(writers.back())];
    run.report(rung.where,
               quoted(run.program, unrest.cell) +
                   " never comes to rest: it changes from scan to scan while "
                   "all inputs are held",
               {.help = held_text(run, unrest),
                .downgrade = !unrest.every_scan || is_toggle(run, rung)});
  }
}

}  // namespace

constinit const Rule relay_race = {
    "RP601", "relay-race", Severity::Warning, Decision::Solver, kDoc, check};

}  // namespace rung
