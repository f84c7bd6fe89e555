#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An edge written by hand (`I0 && !M0`) whose memory is updated above it in the
same scan (`M0 = I0`).

## Why it matters
At the place where the edge is looked for the memory holds the new value
already: the edge is never seen.

## Example
Bad:

    M0 = I0;
    Q0 = I0 && !M0;

Good:

    Q0 = I0 && !M0;
    M0 = I0;

## Limits
Only memories that are plain copies of the contact they are compared with.
)md";

/// The cell that a rung copies; no value when it does more.
CellId copied(const Program& program, const Rung& rung) {
  const Node& root = program.nodes[rung.root()];
  return root.op == NodeOp::Read ? root.cell : CellId();
}

void look_at(RuleRun& run, std::uint32_t node, Contact memory, Contact signal) {
  const std::uint32_t rung = run.index.rung_of[node];
  const std::uint32_t writer = writer_above(run, memory.cell, rung);
  if (writer == ProgramIndex::kNone) return;
  const Rung& copy = run.program.rungs[RungId(writer)];
  if (copied(run.program, copy) != signal.cell) return;
  if (run.index.parent[node] == ProgramIndex::kNone) {
    run.explain(RungId(rung));
  }
  run.report(run.program.nodes[node].where,
             "this edge of " + quoted(run.program, signal.cell) +
                 " is never seen: " + quoted(run.program, memory.cell) +
                 " has the new value already",
             {.labels = {{copy.where, "updated here, above it"}},
              .help = "update the memory below its use"});
}

void check(RuleRun& run) {
  for (std::uint32_t i = 0; i < run.program.nodes.size(); ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op != NodeOp::And) continue;
    const Contact a = contact_at(run.program, node.a);
    const Contact b = contact_at(run.program, node.b);
    if (!a.cell.has_value() || !b.cell.has_value() ||
        a.inverted == b.inverted) {
      continue;
    }
    look_at(run, i, a, b);
    look_at(run, i, b, a);
  }
}

}  // namespace

constinit const Rule early_edge_memory = {
    "RP505", "early-edge-memory", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
