#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// Where two programs with the same cells part, in runs with the same inputs
/// and the same scan times.
struct Parting {
  std::uint64_t scan = 0;   // from 1
  std::int64_t now_ms = 0;  // at its end
  CellId cell;
  std::int64_t first = 0;  // its value in the one
  std::int64_t second = 0;
  std::vector<std::pair<CellId, std::int64_t>> inputs;  // of that scan
};

/// Executes both side by side on random runs and compares their outputs (all
/// named cells, if there is no output) after every scan. Nothing found says
/// nothing. Deterministic. `hold_ms`: with each choice of inputs, in its last
/// scans, that much time passes; scans in which nothing changes cost nothing.
/// Limits: about `work` executed nodes.
std::optional<Parting> find_parting(const Program& one, const Program& other,
                                    std::int64_t hold_ms, std::uint64_t work);

/// For `help`: "after 12 ms, in scan 3, with `I0` = 1".
std::string parting_text(const Program& program, const Parting& parting);

}  // namespace rung
