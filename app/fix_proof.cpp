#include "app/fix_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "smt/equivalence.h"

namespace rung {
namespace {

using Cells = std::unordered_map<std::string_view, const Cell*>;

Cells cells_of(const Program& program) {
  Cells cells;
  for (const Cell& cell : program.cells) cells.emplace(cell.name, &cell);
  return cells;
}

bool same_kind(const Cell& a, const Cell& b) {
  return a.role == b.role && a.type == b.type && a.low == b.low &&
         a.high == b.high;
}

/// Inputs and outputs are the machine's: none may come, no output may go.
std::string wrong_interface(const Cells& before, const Cells& after) {
  for (const auto& [name, cell] : after) {
    const auto known = before.find(name);
    if (known == before.end() && cell->role != CellRole::Memory) {
      return fmt::format("it adds `{}`", name);
    }
    if (known != before.end() && !same_kind(*known->second, *cell)) {
      return fmt::format("`{}` would be something else", name);
    }
  }
  for (const auto& [name, cell] : before) {
    if (cell->role == CellRole::Output && !after.contains(name)) {
      return fmt::format("no rung would write the output `{}`", name);
    }
  }
  return "";
}

/// The plant is not part of a proof, so all that it names has to stay.
std::string wrong_plant(const Program& before, const Cells& after) {
  std::unordered_set<std::string_view> named;
  for (const AstNode& node : before.plant.nodes) {
    if (node.op == AstOp::Name) named.insert(node.text);
  }
  for (const PlantStatement& it : before.plant.statements) {
    named.insert(it.target);
  }
  for (const Cell& cell : before.cells) {
    if (named.contains(cell.name) && !after.contains(cell.name)) {
      return fmt::format("the plant names `{}`", cell.name);
    }
  }
  return "";
}

std::string wrong_properties(const FileReport& before,
                             const FileReport& after) {
  std::vector<std::string> texts[2];
  const FileReport* const reports[2] = {&before, &after};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Property& it : reports[i]->properties.properties) {
      if (!it.built_in) texts[i].push_back(it.text);
    }
    texts[i].insert(texts[i].end(), reports[i]->properties.assumptions.begin(),
                    reports[i]->properties.assumptions.end());
  }
  return texts[0] == texts[1] ? "" : "the property lines would change";
}

/// What elements hold is compared only as far as an output or a memory shows
/// it; a property line may look at the rest.
std::string observed_element(const FileReport& report) {
  for (const Property& property : report.properties.properties) {
    if (property.built_in) continue;
    for (std::string formula : property.formulas) {
      std::erase_if(formula, [](char c) { return c == ' ' || c == '\t'; });
      for (const Instance& instance : report.program->instances) {
        if (formula.find(instance.name + ".") != std::string::npos) {
          return fmt::format("a property line looks at `{}`", instance.name);
        }
      }
    }
  }
  return "";
}

/// The program with each memory cell that `other` has, too, as an output.
Program all_visible(const Program& program, const Cells& other) {
  Program visible = program;
  for (const RungId id : ids_of(program.rungs)) {
    Cell& cell = visible.cells[program.rungs[id].target];
    const bool shared = other.contains(cell.name) && !cell.made;
    if (cell.role == CellRole::Memory && shared) cell.role = CellRole::Output;
  }
  return visible;
}

std::string why_not(const EquivalenceResult& result) {
  if (!result.error.empty()) return result.error;
  if (!result.failures.empty()) {
    return "self-check failed: " + result.failures.front().what;
  }
  switch (result.verdict) {
    case EquivalenceVerdict::Different:
      return fmt::format(
          "`{}` would differ{}", result.differs,
          result.trace_a && !result.trace_a->steps.empty()
              ? fmt::format(" in scan {}", result.trace_a->steps.back().scan)
              : "");
    case EquivalenceVerdict::Bounded:
      return "only some scans could be compared";
    case EquivalenceVerdict::Unknown:
      return result.reason.empty() ? "no answer" : result.reason;
    case EquivalenceVerdict::Equivalent:
      break;
  }
  return result.not_compared.empty() ? ""
                                     : fmt::format("`{}` cannot be compared",
                                                   result.not_compared.front());
}

bool same_reading(const Loaded& a, const Loaded& b) {
  const Program& x = *a.program;
  const Program& y = *b.program;
  return a.report.language == b.report.language &&
         a.report.semantics == b.report.semantics && x.dialect == y.dialect &&
         x.evaluation == y.evaluation && x.scan.min_ms == y.scan.min_ms &&
         x.scan.max_ms == y.scan.max_ms;
}

}  // namespace

FixProof::Answer FixProof::prove(const std::string& after, double seconds,
                                 const std::atomic<bool>* stop) const {
  SourceSet sources;
  const FileId file = sources.add(path_, after);
  const Loaded changed =
      load({file, path_, std::nullopt}, options_, extra_, sources);
  if (!changed.program) {
    const auto& errors = changed.report.findings;
    return {false, errors.empty() ? "it could not be read"
                                  : "then " + errors.front().message};
  }
  if (!same_reading(before_, changed)) {
    return {false, "the text would be read differently"};
  }
  const Cells cells = cells_of(*before_.program);
  const Cells changed_cells = cells_of(*changed.program);
  for (const std::string& wrong :
       {wrong_interface(cells, changed_cells),
        wrong_plant(*before_.program, changed_cells),
        wrong_properties(before_.report, changed.report),
        observed_element(before_.report)}) {
    if (!wrong.empty()) return {false, wrong};
  }
  EquivalenceOptions equivalence;
  equivalence.budget.seconds = seconds;
  equivalence.budget.stop = stop;
  equivalence.assumptions = before_.report.properties.assumptions;
  equivalence.assumptions_b = changed.report.properties.assumptions;
  const EquivalenceResult result =
      check_equivalence(all_visible(*before_.program, changed_cells),
                        all_visible(*changed.program, cells), equivalence);
  const std::string wrong = why_not(result);
  if (!wrong.empty()) return {false, wrong};
  return {true, "proved equivalent: " + result.engine};
}

}  // namespace rung
