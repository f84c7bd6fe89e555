#include <algorithm>
#include <vector>

#include "analysis/property_text.h"
#include "analysis/rules/wiring.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A line `//@ after P, Q within N ms` where Q is a latch that an input breaks, and
neither the line nor an assumption speaks of that input.

## Why it matters
Whoever presses stop in between makes the response come too late, or not at all:
the line is violated by a run that is right. Its bound says nothing until the
stop is part of it.

## Example
Bad:

    //@ after I0, Q0 within 1 s
    Q0 = (T(0, 0.5, I0) || Q0) && !I1;

Good:

    //@ after I0, Q0 || I1 || !I0 within 1 s
    Q0 = (T(0, 0.5, I0) || Q0) && !I1;

## Limits
A note. Only where Q is the name of a cell that holds itself, and only inputs
that stand as contacts in its rung.
)md";

bool is_name_part(char c) { return is_word_part(c) || c == '.'; }

/// Does the text have the name as a word?
bool mentions(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != text.npos;
       at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_name_part(text[at - 1])) &&
        (end == text.size() || !is_name_part(text[end]))) {
      return true;
    }
  }
  return false;
}

bool is_said(const RuleRun& run, const Property& property,
             std::string_view name) {
  const auto has_name = [&](const std::string& text) {
    return mentions(text, name);
  };
  return has_name(property.text) ||
         std::any_of(run.properties.assumptions.begin(),
                     run.properties.assumptions.end(), has_name);
}

/// The first input that breaks the latch and of which nothing is said.
CellId forgotten(const RuleRun& run, const Property& property,
                 const Latch& latch) {
  for (const std::uint32_t node : latch.breaks) {
    for (const std::uint32_t leaf : leaves(run.program, node)) {
      const CellId cell = contact_at(run.program, leaf).cell;
      if (!cell.has_value()) continue;
      const Cell& it = run.program.cells[cell];
      if (it.role == CellRole::Input && !is_said(run, property, it.name)) {
        return cell;
      }
    }
  }
  return {};
}

void check(RuleRun& run) {
  constexpr std::size_t kMostLines = 1000;
  std::vector<const Latch*> latch_of(run.program.cells.size());
  for (const Latch& latch : run.latches) latch_of[latch.cell.index()] = &latch;
  std::size_t lines = 0;
  for (const Property& property : run.properties.properties) {
    if (property.form != Property::Form::After || property.absent ||
        property.formulas.size() < 2) {
      continue;
    }
    if (++lines > kMostLines) return;
    const CellId cell = run.index.find(property.formulas[1]);
    if (!cell.has_value() || latch_of[cell.index()] == nullptr) continue;
    const CellId stop = forgotten(run, property, *latch_of[cell.index()]);
    if (!stop.has_value()) continue;
    run.report(property.where,
               quoted(run.program, stop) + " can break " +
                   quoted(run.program, cell) +
                   " before the time is over, and nothing is said of it",
               {.help = "add it to the response: `" + property.formulas[1] +
                        " || ...`, or assume that it is not pressed"});
  }
}

}  // namespace

constinit const Rule response_forgets_stop = {
    "RP512", "response-forgets-stop", Severity::Note, Decision::Syntax, kDoc,
    check};

}  // namespace rung
