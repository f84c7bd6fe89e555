#pragma once

#include <cstdint>
#include <string>

#include "analysis/trace.h"
#include "smt/product.h"
#include "smt/signals.h"

namespace rung {

/// Two programs executed on the same inputs, up to the first scan at whose end
/// an output that they share differs.
struct LockStep {
  bool differs = false;
  std::string output;  // the first that differs, as the first program names it
  Stimulus stimulus_a;
  Stimulus stimulus_b;
};

/// `stimulus` is of their product: its inputs are indices of shared.inputs.
/// Of settled programs only the last scan counts: there the run ends.
LockStep run_lockstep(const Program& a, const Program& b,
                      const SharedSignals& shared, const Stimulus& stimulus,
                      const Comparison& comparison = {});

/// Makes steps of both in which no cell of either program changes, as far as
/// simulate_changes() does.
void split_where_cells_change(const Program& a, const Program& b,
                              LockStep& run);

}  // namespace rung
