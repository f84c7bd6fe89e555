#pragma once

#include <vector>

#include "analysis/rules/rule_run.h"

namespace rung {

/// Two latching outputs: the one is interlocked against the other, which does
/// not read it.
struct OneSided {
  const Latch* locked = nullptr;
  const Latch* free = nullptr;
};
std::vector<OneSided> one_sided_pairs(const RuleRun& run);

/// Does the rung read the cell?
bool reads(const RuleRun& run, RungId rung, CellId cell);

/// The value of the rung's expression, were `cell` to have the value `term`
/// where the rung reads it. No value when something other than contacts
/// depends on the cell.
ExprId value_with(RuleRun& run, RungId rung, CellId cell, ExprId term);

}  // namespace rung
