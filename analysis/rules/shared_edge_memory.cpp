#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
One memory that serves two edges (`I0 && !M0` and `I1 && !M0`, with `M0 = I0`
and `M0 = I1`).

## Why it matters
Each edge compares its signal with what the other one left: both are seen in
almost every scan, or not at all. Every edge needs a memory of its own.

## Example
Bad:

    Q0 = I0 && !M0;
    M0 = I0;
    Q1 = I1 && !M0;
    M0 = I1;

Good:

    Q0 = I0 && !M0;
    M0 = I0;
    Q1 = I1 && !M1;
    M1 = I1;

## Limits
Edges written by hand, and those that a reader makes of `FP M 1.0`: the memory
is a plain copy of the signal. That two calls share one `R_TRIG` is told by
`shared-index`.
)md";

/// The contact that the rung copies; no cell when it does more.
CellId copied(const Program& program, RungId rung) {
  const Node& root = program.nodes[program.rungs[rung].root()];
  return root.op == NodeOp::Read ? root.cell : CellId();
}

/// Is the read at `node` the memory in an edge of `signal`: one of the two is
/// inverted?
bool is_edge_of(const RuleRun& run, std::uint32_t node, CellId signal) {
  const auto up = [&](std::uint32_t at) { return run.index.parent[at]; };
  std::uint32_t gate = up(node);
  const std::uint32_t none = ProgramIndex::kNone;
  if (gate != none && run.program.nodes[gate].op == NodeOp::Not) {
    gate = up(gate);
  }
  if (gate == none || run.program.nodes[gate].op != NodeOp::And) return false;
  const Contact a = contact_at(run.program, run.program.nodes[gate].a);
  const Contact b = contact_at(run.program, run.program.nodes[gate].b);
  return (a.cell == signal || b.cell == signal) && a.inverted != b.inverted;
}

/// Writers of the cell that copy a signal of which an edge is taken between
/// the writer before and it; only the first two are wanted.
std::vector<RungId> edges_of(const RuleRun& run, CellId memory) {
  std::vector<RungId> edges;
  const std::span<const std::uint32_t> writers =
      run.index.writers[memory.index()];
  std::size_t next = 0;
  for (const std::uint32_t node : run.index.reads[memory.index()]) {
    const std::uint32_t rung = run.index.rung_of[node];
    while (next < writers.size() && writers[next] < rung) ++next;
    if (next == writers.size()) break;
    const RungId writer(writers[next]);
    const CellId signal = copied(run.program, writer);
    const bool is_new = edges.empty() || edges.back() != writer;
    if (signal.has_value() && is_new && is_edge_of(run, node, signal)) {
      edges.push_back(writer);
    }
    if (edges.size() == 2) break;
  }
  return edges;
}

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    if (run.index.writers[id.index()].size() < 2) continue;
    const std::vector<RungId> edges = edges_of(run, id);
    if (edges.size() < 2) continue;
    for (const std::uint32_t writer : run.index.writers[id.index()]) {
      run.explain(RungId(writer));
    }
    const Program& program = run.program;
    run.report(program.rungs[edges[1]].where,
               quoted(program, id) + " is the memory of two edges",
               {.labels = {{program.rungs[edges[0]].where,
                            "it keeps another signal here"}},
                .help = "give each edge a memory of its own"});
  }
}

}  // namespace

constinit const Rule shared_edge_memory = {
    "RP511", "shared-edge-memory", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
