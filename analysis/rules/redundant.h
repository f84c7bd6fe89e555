#pragma once

#include <functional>
#include <string>

#include "analysis/rules/rule_run.h"

namespace rung {

/// An operand of And or Or that its rung does without.
struct Redundant {
  std::uint32_t node = 0;
  NodeOp parent = NodeOp::And;
  std::string proof;
};

/// Asks of every operand of every And and Or: is the value that it goes into
/// the same, in every reachable state, when the operand is left out? By
/// induction over the scans the program without it then is the same program.
/// `report` is called at most once a rung, with the largest such operand (of
/// equal ones the last). Rungs whose value is a constant are left out.
void ask_redundant(
    RuleRun& run,
    const std::function<void(RuleRun&, const Redundant&)>& report);

}  // namespace rung
