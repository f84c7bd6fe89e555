#include <algorithm>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung whose value nothing reads before a later rung overwrites it in the same
scan.

## Why it matters
The rung has no effect at all. Either it is a leftover, or the later rung was
meant for another cell.

## Example
Bad:

    M0 = I0 && I1;
    M0 = I2;
    Q0 = M0;

Good:

    M0 = I0 && I1;
    Q0 = M0 || I2;

## Limits
A read that a short-circuit skips counts as a read.
)md";

/// The first read of `cell` behind rung `after` and not behind rung `last`,
/// whose own reads come before its write.
bool read_between(const RuleRun& run, std::uint32_t cell, std::uint32_t after,
                  std::uint32_t last) {
  const std::uint32_t begin = run.program.rungs[RungId(after)].end;
  const std::uint32_t end = run.program.rungs[RungId(last)].end;
  const std::span<const std::uint32_t> reads = run.index.reads[cell];
  const auto first = std::lower_bound(reads.begin(), reads.end(), begin);
  return first != reads.end() && *first < end;
}

bool has_call(const RuleRun& run, const Rung& rung) {
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    if (run.program.nodes[i].op == NodeOp::Call) return true;
  }
  return false;
}

void check(RuleRun& run) {
  for (const CellId cell : ids_of(run.program.cells)) {
    if (is_implicit(run.program, cell)) continue;
    const std::span<const std::uint32_t> writers =
        run.index.writers[cell.index()];
    for (std::size_t i = 1; i < writers.size(); ++i) {
      if (read_between(run, cell.index(), writers[i - 1], writers[i])) continue;
      const Rung& lost = run.program.rungs[RungId(writers[i - 1])];
      const Rung& winner = run.program.rungs[RungId(writers[i])];
      run.report(lost.target_where,
                 "the value written to " + quoted(run.program, cell) +
                     " is overwritten before anything reads it",
                 {.labels = {{winner.target_where, "overwritten here"}},
                  .help = has_call(run, lost)
                              ? "the rung still runs its timer or counter"
                              : "the rung has no effect"});
    }
  }
}

}  // namespace

constinit const Rule overwritten_value = {"RP102",        "overwritten-value",
                                          Severity::Note, Decision::Syntax,
                                          kDoc,           check};

}  // namespace rung
