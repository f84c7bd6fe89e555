#pragma once

#include <cstdint>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/plcopen/graph.h"
#include "frontend/semantics.h"

namespace rung::plcopen {

/// What is executed as one: every sink's value is known before the first of
/// them is written. Elements of Graph::elements that have an effect: coils,
/// outVariables, blocks, connectors.
using Network = std::vector<std::uint32_t>;

/// The networks of a drawing in scan order.
///
/// Document and Position: each sink is a network of its own, in the order of
/// PLCGenerator.py of Beremiz and the OpenPLC Editor: first what has an
/// executionOrderId, by that number (coils have none); then outVariables and
/// coils; then blocks; then connectors. Snapshot: what wires join is one
/// network; networks and their sinks go by row and column.
/// Errors: RP095 where rows overlap, so that their order is not defined.
std::vector<Network> scan_order(const Graph& graph, CoilOrder order,
                                ErrorLimit& errors);

}  // namespace rung::plcopen
