#include <algorithm>
#include <vector>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A latch in which a stop stands in series with the start only, without
parentheses: `Q0 || I0 && !I1`.

## Why it matters
`&&` binds tighter: the stop keeps the start from setting, but it does not break
the latch. Whether that was meant cannot be seen.

## Example
Bad:

    Q0 = (Q0 || I0 && !I1) && !I2;

Good:

    Q0 = (Q0 || (I0 && !I1)) && !I2;

## Limits
Only rungs that hold themselves: elsewhere the mix is usual and harmless. A stop
that stands in series with the seal-in alone is told by `start-dominant-latch`.
)md";

char before(std::string_view text, std::uint32_t at) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  return at == 0 ? ' ' : text[at - 1];
}

char behind(std::string_view text, std::uint32_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  return at == text.size() ? ' ' : text[at];
}

bool in_parentheses(const RuleRun& run, SourceRange where) {
  const std::string_view text = run.sources[where.file].text();
  return (before(text, where.begin) == '(' && behind(text, where.end) == ')') ||
         (text[where.begin] == '(' && text[where.end - 1] == ')');
}

bool has_stop(const Program& program, std::uint32_t series) {
  const std::vector<std::uint32_t> parts =
      operands(program, series, NodeOp::And);
  return std::any_of(parts.begin(), parts.end(), [&](std::uint32_t part) {
    return contact_at(program, part).inverted;
  });
}

void check(RuleRun& run) {
  if (run.program.language != "script") return;
  for (const Latch& latch : run.latches) {
    const Rung& rung = run.program.rungs[latch.rung];
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = run.program.nodes[i];
      const std::uint32_t parent = run.index.parent[i];
      if (node.op != NodeOp::And || parent == ProgramIndex::kNone ||
          run.program.nodes[parent].op != NodeOp::Or ||
          !node.where.has_value() || !has_stop(run.program, i) ||
          (run.index.first[i] <= latch.read && latch.read <= i) ||
          in_parentheses(run, node.where)) {
        continue;
      }
      run.report(
          node.where, "`&&` beside `||` without parentheses in a latch",
          {.help = "write " +
                   quoted("(" + std::string(text_of(run, node.where)) + ")") +
                   ", or put the stop outside"});
      break;
    }
  }
}

}  // namespace

constinit const Rule mixed_operators = {
    "RP703", "mixed-operators", Severity::Note, Decision::Syntax, kDoc, check};

}  // namespace rung
