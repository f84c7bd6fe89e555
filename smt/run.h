#pragma once

#include <cstdint>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "smt/cone.h"

namespace rung {

class Interpreter;

/// One scan of a found run and the stretch behind it: see JumpCircuit.
struct RunStep {
  std::vector<std::int64_t> inputs;  // in the order of Cone::inputs()
  std::int64_t delta = 0;            // ms of the stretch; 0: none
};
using Run = std::vector<RunStep>;

/// A run, and which inputs its values are of.
struct FoundRun {
  std::vector<VarId> inputs;
  Run steps;
};

/// Scans that a run has when its stretches take as few as they can.
std::uint64_t scan_count(const Run& run, const ScanInterval& scan);

/// What the environment does in `run`: stretches become as few scans as they
/// can, of at most two lengths. Inputs that the run does not name rest at 0.
Stimulus to_stimulus(const TransitionSystem& ts, const FoundRun& run);

std::uint64_t scans_of(const Stimulus& stimulus);
void drop_last_scan(Stimulus& stimulus);
/// Leaves its first `scans` scans.
void cut_to(Stimulus& stimulus, std::uint64_t scans);

/// How stretches are executed.
enum class Stretches : std::uint8_t {
  ScanByScan,
  AsOneScan,  // where JumpCircuit::exact() says that it is the same
};

/// Executes the terms. Is `target` true at the end of the run, did the
/// constraints hold throughout, and none of `never`?
bool reaches(const Cone& cone, const Run& run, ExprId target,
             const std::vector<ExprId>& never = {},
             Stretches stretches = Stretches::ScanByScan);
/// The first step of the run whose scan ends with `target`, from 1; 0 if none
/// does, or if the constraints or `never` break the run before.
std::uint32_t first_hit(const Cone& cone, const Run& run, ExprId target,
                        const std::vector<ExprId>& never,
                        Stretches stretches = Stretches::ScanByScan);

/// Executes `terms` on a stimulus; did the constraints hold in every scan?
bool run_terms(const TransitionSystem& ts, const Stimulus& stimulus,
               Interpreter& terms);

}  // namespace rung
