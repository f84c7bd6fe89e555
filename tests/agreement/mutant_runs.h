#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/trace.h"
#include "random_run.h"

namespace rung {

/// A program that the tests run, and its inputs.
struct ProgramRun {
  std::string name;
  ReadProgram read;
  Stimulus stimulus;
};

/// `count` random programs, and a few written for what those do not reach:
/// edges, which scripts cannot name, counters far from 0, words that wrap.
std::vector<ProgramRun> mutant_runs(std::uint64_t count);

}  // namespace rung
