#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two rungs with three or more contacts that compute the same function of the
same state, for different targets.

## Why it matters
It is copied logic: the next change is made in one place and forgotten in the
other. Often one copy was to be edited and was not.

## Example
Bad:

    Q0 = (I0 || I1) && !I2;
    Q1 = !I2 && (I1 || I0);

Good:

    Q0 = (I0 || I1) && !I2;
    Q1 = Q0;

## Limits
Functions are compared as normalised terms: what differs only in the order of
its contacts is equal, what needs a proof is not seen. Rungs with timers,
counters or edges are never equal.
)md";

constexpr std::size_t kFewContacts = 3;

std::size_t count_contacts(const RuleRun& run, const Rung& rung) {
  std::size_t contacts = 0;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    if (run.program.nodes[i].op == NodeOp::Call) return 0;
    if (run.program.nodes[i].op == NodeOp::Read) ++contacts;
  }
  return contacts;
}

void check(RuleRun& run) {
  std::vector<RungId> first(run.ts.exprs.size());
  for (const RungId id : ids_of(run.program.rungs)) {
    const Rung& rung = run.program.rungs[id];
    if (run.program.cells[rung.target].type != Type::Bit ||
        count_contacts(run, rung) < kFewContacts ||
        run.ts.exprs.is_constant(run.ts.rung_value[id.index()])) {
      continue;
    }
    RungId& known = first[run.ts.rung_value[id.index()].index()];
    if (!known.has_value()) {
      known = id;
      continue;
    }
    const Rung& other = run.program.rungs[known];
    if (other.target == rung.target) continue;  // double-coil
    run.report(rung.where,
               quoted(run.program, rung.target) + " repeats the logic of " +
                   quoted(run.program, other.target),
               {.labels = {{other.where, "the same function"}}});
  }
}

}  // namespace

constinit const Rule duplicate_rung = {
    "RP309", "duplicate-rung", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
