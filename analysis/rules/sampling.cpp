#include "analysis/rules/sampling.h"

#include <algorithm>
#include <bit>

#include "analysis/rules/sampled_runs.h"

namespace rung {
namespace {

using Bits = SampledRuns::Bits;

constexpr std::uint64_t kMostScans = 1200;
constexpr std::uint64_t kFewestScans = 64;  // fewer show next to nothing
constexpr std::uint64_t kChosen = 16;  // scans with new inputs, then held ones
constexpr std::uint64_t kHeld = 8;

}  // namespace

std::vector<bool> sample(const TransitionSystem& ts,
                         const std::vector<ExprId>& conditions,
                         std::uint64_t work) {
  std::vector<bool> refuted(conditions.size());
  SampledRuns runs(ts, conditions);
  const std::uint64_t scans = std::min(runs.scans_for(work), kMostScans);
  if (scans < kFewestScans) return refuted;
  const auto observe = [&](Bits valid) {
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      if ((~runs.bits(conditions[i]) & valid) != 0) refuted[i] = true;
    }
  };
  runs.start();
  for (std::uint64_t scan = 0; scan < scans; ++scan) {
    const std::uint64_t phase = scan % (kChosen + kHeld);
    if (phase < kChosen) runs.choose_inputs();
    Bits valid = runs.evaluate();
    observe(valid);
    if (phase >= kChosen) {
      valid = runs.hold(valid);
      observe(valid);
      ++scan;
    }
    runs.advance(valid);
  }
  return refuted;
}

namespace {

/// By cell, the lanes in which it changed while nothing else did.
struct Restless {
  /// In every quarter of the scans: what only runs out, as a counter does when
  /// it comes to its end, is at rest later.
  std::vector<Bits> again_and_again;
  std::vector<Bits> every_scan;
};

Restless restless(const TransitionSystem& ts, SampledRuns runs) {
  constexpr std::uint32_t kQuarter = kRestScans / 4;
  const std::size_t cells = ts.cell_end.size();
  Restless found = {std::vector<Bits>(cells, ~Bits{0}),
                    std::vector<Bits>(cells, ~Bits{0})};
  std::vector<Bits> changed(cells, 0);
  runs.freeze();
  for (std::uint32_t scan = 1; scan <= 2 * kRestScans; ++scan) {
    const Bits valid = runs.evaluate();
    for (std::size_t i = 0; i < cells; ++i) {
      if (ts.exprs[ts.cell_end[i]].type == Type::Word) continue;
      const Bits change =
          (runs.bits(ts.cell_end[i]) ^ runs.bits(ts.cell_begin[i])) & valid;
      changed[i] |= change;
      if (scan > kRestScans) found.every_scan[i] &= change;
    }
    runs.advance(valid);
    if (scan % kQuarter != 0) continue;
    for (std::size_t i = 0; i < cells; ++i) {
      if (scan > kRestScans) found.again_and_again[i] &= changed[i];
    }
    changed.assign(cells, 0);
  }
  return found;
}

Unrest describe(const TransitionSystem& ts, const SampledRuns& runs,
                CellId cell, Bits lanes) {
  Unrest unrest{cell, {}, false};
  const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
  for (const Variable& var : ts.vars) {
    if (var.role != VarRole::Input || !runs.needed(var.expr)) continue;
    unrest.held.emplace_back(var.cell, runs.value(var.expr, lane));
  }
  return unrest;
}

}  // namespace

std::vector<Unrest> sample_unrest(const TransitionSystem& ts,
                                  std::uint64_t work) {
  std::vector<ExprId> observed = ts.cell_end;
  observed.insert(observed.end(), ts.cell_begin.begin(), ts.cell_begin.end());
  SampledRuns runs(ts, observed);
  const std::uint64_t affordable =
      std::min(runs.scans_for(work), kMostScans / 2);
  if (affordable <= std::uint64_t{2} * kRestScans) return {};
  runs.start();
  std::vector<Unrest> found;
  std::vector<bool> seen(ts.cell_end.size());
  std::uint64_t scans = 0;
  for (std::uint64_t next_look = 1;
       scans + std::uint64_t{2} * kRestScans <= affordable; next_look *= 2) {
    for (std::uint64_t i = 0; i < next_look; ++i, ++scans) {
      runs.choose_inputs();
      runs.advance(runs.evaluate());
    }
    const Restless lanes = restless(ts, runs);
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      if (lanes.again_and_again[i] == 0 || seen[i]) continue;
      seen[i] = true;
      const bool flickers = lanes.every_scan[i] != 0;
      found.push_back(
          describe(ts, runs, CellId(i),
                   flickers ? lanes.every_scan[i] : lanes.again_and_again[i]));
      found.back().every_scan = flickers;
    }
    scans += std::uint64_t{2} * kRestScans;
  }
  return found;
}

}  // namespace rung
