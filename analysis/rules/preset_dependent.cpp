#include <algorithm>
#include <span>

#include "analysis/rules/support.h"
#include "analysis/rules/twin.h"
#include "frontend/recognise.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
An output that behaves differently where the timers, counters and edges are
those of another semantics preset of the language (`--semantics`). A run shows
it.

## Why it matters
Tools do not agree on what a timer with preset 0 does, in which scan it fires,
or whether a falling edge is seen at power-up. What is proved under one preset
holds on that tool, and not on the next one.

## Example
Bad:

    PROGRAM main
    VAR_INPUT a : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : F_TRIG; END_VAR
    edge(CLK := a);
    q := edge.Q OR q;
    END_PROGRAM

Good:

    PROGRAM main
    VAR_INPUT a : BOOL; b : BOOL; END_VAR
    VAR_OUTPUT q : BOOL; END_VAR
    VAR edge : R_TRIG; END_VAR
    edge(CLK := a);
    q := (edge.Q OR q) AND NOT b;
    END_PROGRAM

## Limits
Only the elements are exchanged, not the order of coils. Runs are tried:
nothing found says nothing.
)md";

/// The kind of `elements` that has all that is called of the instance.
const ElementKind* counterpart(const RuleRun& run, InstanceId instance,
                               std::string_view elements) {
  const ElementKind* kind = run.program.instances[instance].kind;
  for (const std::uint32_t index : run.index.calls[instance.index()]) {
    const ElementOperation& mine = *run.program.calls[CallId(index)].operation;
    const FoundOperation found = find_operation(elements, mine.name);
    const bool alike =
        found.operation != nullptr &&
        std::equal(mine.parameters.begin(), mine.parameters.end(),
                   found.operation->parameters.begin(),
                   found.operation->parameters.end(),
                   [](const ElementParameter& a, const ElementParameter& b) {
                     return a.kind == b.kind;
                   });
    if (!alike) return nullptr;
    kind = found.kind;
  }
  return kind;
}

/// Exchanges the elements. False: none is another, or one has no counterpart.
bool exchange(const RuleRun& run, std::string_view elements, Program& program) {
  bool any = false;
  for (const InstanceId id : ids_of(program.instances)) {
    const ElementKind* const kind = counterpart(run, id, elements);
    if (kind == nullptr) return false;
    any = any || kind != program.instances[id].kind;
    program.instances[id].kind = kind;
  }
  for (const CallId id : ids_of(program.calls)) {
    ElementCall& call = program.calls[id];
    const auto operations = program.instances[call.instance].kind->operations;
    const auto found = std::find_if(operations.begin(), operations.end(),
                                    [&](const ElementOperation& one) {
                                      return one.name == call.operation->name;
                                    });
    if (found == operations.end()) return false;
    call.operation = &*found;
  }
  return any;
}

/// Long enough for every timer.
std::int64_t longest_preset(const Program& program) {
  constexpr std::int64_t kMost = std::int64_t{24} * 3'600'000;
  std::int64_t longest = 0;
  for (const Instance& instance : program.instances) {
    if (instance.kind->family != ElementFamily::Timer) continue;
    longest = std::max(longest, instance.largest_parameter);
  }
  return std::min(longest, kMost) + program.scan.max_ms;
}

void compare(RuleRun& run, const Semantics& preset) {
  Program other = run.program;
  if (!exchange(run, preset.elements, other)) return;
  constexpr std::uint64_t kWork = 500'000;
  const std::optional<Parting> parting =
      find_parting(run.program, other, longest_preset(run.program), kWork);
  if (!parting) return;
  const std::span<const std::uint32_t> writers =
      run.index.writers[parting->cell.index()];
  if (writers.empty()) return;
  run.report(run.program.rungs[RungId(writers.back())].where,
             quoted(run.program, parting->cell) + " is " +
                 std::to_string(parting->first) + " here, and " +
                 std::to_string(parting->second) + " under `--semantics " +
                 std::string(preset.name) + "`",
             {.help = parting_text(run.program, *parting)});
}

void check(RuleRun& run) {
  const Language* const language = find_language(run.program.language);
  if (!run.has_oracle || language == nullptr ||
      run.program.instances.size() == 0) {
    return;
  }
  std::vector<std::string_view> seen = {run.program.dialect};
  // The presets of these are dialects and libraries: a text is for one of them.
  if (language->name == "script" || language->name == "postfix" ||
      language->name == "plclib") {
    return;
  }
  for (const std::string_view name : language->presets) {
    const Semantics* const preset = find_semantics(name);
    if (preset == nullptr ||
        std::find(seen.begin(), seen.end(), preset->elements) != seen.end()) {
      continue;
    }
    seen.push_back(preset->elements);
    compare(run, *preset);
  }
}

}  // namespace

constinit const Rule preset_dependent = {
    "RP513", "preset-dependent", Severity::Note, Decision::Solver, kDoc,
    check,   Pack::Safety};

}  // namespace rung
