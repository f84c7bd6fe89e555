#pragma once

#include <cstdint>
#include <vector>

#include "analysis/rules/program_index.h"

namespace rung {

/// By cell: the strongly connected component it is in, of the graph in which a
/// cell depends on what its rungs read and on the elements they call, and an
/// element on what those rungs read. Two cells in one component depend on each
/// other, through any number of scans. Linear.
/// Source: R. Tarjan, "Depth-first search and linear graph algorithms", 1972.
std::vector<std::uint32_t> cell_components(const Program& program);

/// By cell: does it depend on itself? `component` is cell_components().
std::vector<bool> cells_in_loops(const Program& program,
                                 const std::vector<std::uint32_t>& component);

}  // namespace rung
