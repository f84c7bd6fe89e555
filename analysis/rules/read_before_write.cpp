#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A rung that reads a cell which only rungs further down write.

## Why it matters
It sees the value of the scan before. That is right for a feedback and wrong
for everything that must act at once: an interlock or a stop that is read above
its rung works one scan late.

## Example
Bad:

    Q0 = M0;
    M0 = I0 && !I1;

Good:

    M0 = I0 && !I1;
    Q0 = M0;

## Limits
A loop must read something one scan late somewhere, so cells that depend on
their own reader are left out, as are a rung that reads its own target and the
memory of an edge (`M0 = I0` below `I0 && !M0`).
)md";

constexpr std::uint32_t kMostNodes = 256;

/// `M0 = I0` below a rung that reads M0 and I0: an edge written by hand, where
/// the old value is the point.
bool is_edge_memory(const RuleRun& run, const Rung& reader,
                    const Rung& writer) {
  const Node& copy = run.program.nodes[writer.root()];
  if (copy.op != NodeOp::Read) return false;
  // A rung is read again for each cell in it: short ones only.
  if (reader.end - reader.begin > kMostNodes) return false;
  for (std::uint32_t i = reader.begin; i < reader.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op == NodeOp::Read && node.cell == copy.cell) return true;
  }
  return false;
}

void check(RuleRun& run) {
  for (const CellId id : ids_of(run.program.cells)) {
    const std::span<const std::uint32_t> writers =
        run.index.writers[id.index()];
    const std::span<const std::uint32_t> reads = run.index.reads[id.index()];
    if (writers.empty() || reads.empty()) continue;
    const std::uint32_t reader_rung = run.index.rung_of[reads[0]];
    if (reader_rung >= writers[0]) continue;
    const Rung& reader = run.program.rungs[RungId(reader_rung)];
    const Rung& writer = run.program.rungs[RungId(writers[0])];
    const std::vector<std::uint32_t>& component = run.index.component;
    if (component[reader.target.index()] == component[id.index()] ||
        is_edge_memory(run, reader, writer)) {
      continue;
    }
    run.report(run.program.nodes[reads[0]].where,
               quoted(run.program, id) +
                   " is read before it is written: the value is one scan old",
               {.labels = {{writer.target_where, "written here"}}});
  }
}

}  // namespace

constinit const Rule read_before_write = {"RP206",        "read-before-write",
                                          Severity::Note, Decision::Syntax,
                                          kDoc,           check};

}  // namespace rung
