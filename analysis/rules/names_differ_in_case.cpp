#include <string>
#include <unordered_map>

#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
Two cells whose names differ only in upper and lower case.

## Why it matters
They are two cells, as in JavaScript. Hardly anyone means that: one of them is
a typing mistake and has no coil or no contact.

## Example
Bad:

    M1 = I0;
    m1 = I1;
    Q0 = M1 || m1;

Good:

    M1 = I0;
    M2 = I1;
    Q0 = M1 || M2;

## Limits
Names of the plant alone are not looked at.
)md";

std::string lowered(std::string_view name) {
  std::string text(name);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

void check(RuleRun& run) {
  std::unordered_map<std::string, CellId> known;
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    const auto [entry, is_new] = known.emplace(lowered(cell.name), id);
    if (is_new) continue;
    const Cell& other = run.program.cells[entry->second];
    run.report(
        cell.where,
        quoted(cell.name) + " and " + quoted(other.name) + " are two cells",
        {.labels = {{other.where, "the other one"}}});
  }
}

}  // namespace

constinit const Rule names_differ_in_case = {
    "RP707", "names-differ-in-case", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
