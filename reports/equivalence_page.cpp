#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "reports/equivalence.h"
#include "reports/html/page.h"

namespace rung {
namespace {

/// Two programs as one that executes the rungs of the first and then those of
/// the second. Inputs that both have are one cell, under its plain name; all
/// others are `a.NAME` and `b.NAME`. For the page, which draws rungs of both
/// beside one table.
class BothPrograms {
 public:
  explicit BothPrograms(const EquivalenceReport& report) : report_(report) {
    const Program& a = *report.a.program;
    const Program& b = *report.b.program;
    program_->file = a.file;
    std::unordered_map<std::string_view, CellId> inputs;  // of the first
    for (const CellId id : ids_of(a.cells)) {
      if (a.cells[id].role == CellRole::Input) inputs[a.cells[id].name] = id;
    }
    twins_.resize(b.cells.size());
    std::vector<bool> is_shared(a.cells.size(), false);
    for (const CellId id : ids_of(b.cells)) {
      if (b.cells[id].role != CellRole::Input) continue;
      const auto found = inputs.find(name_in_first(b.cells[id].name));
      if (found == inputs.end()) continue;
      twins_[id.index()] = found->second;
      is_shared[found->second.index()] = true;
    }
    for (const CellId id : ids_of(a.cells)) {
      a_.push_back(add_cell(a.cells[id], is_shared[id.index()] ? "" : "a."));
    }
    for (const CellId id : ids_of(b.cells)) {
      const CellId twin = twins_[id.index()];
      b_.push_back(twin.has_value() ? a_[twin.index()]
                                    : add_cell(b.cells[id], "b."));
    }
    add_rungs(a, a_);
    add_rungs(b, b_);
  }

  std::shared_ptr<const Program> program() const { return program_; }

  std::optional<Trace> trace() const {
    if (!report_.trace_a || !report_.trace_b) return std::nullopt;
    Trace joined = *report_.trace_a;
    const std::vector<Trace::Step>& others = report_.trace_b->steps;
    joined.steps.resize(std::min(joined.steps.size(), others.size()));
    for (std::size_t i = 0; i < joined.steps.size(); ++i) {
      Trace::Step& step = joined.steps[i];
      const std::vector<std::int64_t> first = std::move(step.values);
      step.values.assign(program_->cells.size(), 0);
      place(others[i].values, b_, step.values);
      place(first, a_, step.values);
      step.changes = step.changes || others[i].changes;
    }
    return joined;
  }

 private:
  std::string_view name_in_first(const std::string& name) const {
    for (const auto& [a, b] : report_.map) {
      if (b == name) return a;
    }
    return name;
  }

  CellId add_cell(Cell cell, std::string_view prefix) {
    cell.name.insert(0, prefix);
    return program_->cells.add(std::move(cell));
  }

  /// Ids of `from` become those behind what is there already.
  void add_rungs(const Program& from, const std::vector<CellId>& cells) {
    Program& to = *program_;
    const auto node_base = static_cast<std::uint32_t>(to.nodes.size());
    const auto call_base = static_cast<std::uint32_t>(to.calls.size());
    const auto instance_base = static_cast<std::uint32_t>(to.instances.size());
    for (const Instance& instance : from.instances) to.instances.add(instance);
    for (ElementCall call : from.calls) {
      call.instance = InstanceId(instance_base + call.instance.index());
      for (std::uint32_t& argument : call.arguments) argument += node_base;
      to.calls.add(std::move(call));
    }
    for (Node node : from.nodes) {
      node.a += node_base;
      node.b += node_base;
      node.target += node_base;
      if (node.cell.has_value()) node.cell = cells[node.cell.index()];
      if (node.call.has_value()) {
        node.call = CallId(call_base + node.call.index());
      }
      to.nodes.push_back(node);
    }
    for (Rung rung : from.rungs) {
      rung.begin += node_base;
      rung.end += node_base;
      rung.target = cells[rung.target.index()];
      to.rungs.add(rung);
    }
  }

  static void place(const std::vector<std::int64_t>& values,
                    const std::vector<CellId>& cells,
                    std::vector<std::int64_t>& to) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      to[cells[i].index()] = values[i];
    }
  }

  const EquivalenceReport& report_;
  std::shared_ptr<Program> program_ = std::make_shared<Program>();
  std::vector<CellId> a_;  // where the cells of each program went
  std::vector<CellId> b_;
  std::vector<CellId> twins_;  // of the second's inputs in the first
};

/// Keeps of pairs `a.NAME`, `b.NAME` those that differ when the run ends: the
/// page is about these, and draws few rungs.
std::vector<std::string> differing(const Program& program, const Trace& trace,
                                   const std::vector<std::string>& pairs) {
  std::unordered_map<std::string_view, std::int64_t> values;
  for (const CellId id : ids_of(program.cells)) {
    values[program.cells[id].name] = trace.steps.back().values[id.index()];
  }
  std::vector<std::string> out;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (values[pairs[i]] == values[pairs[i + 1]]) continue;
    out.push_back(pairs[i]);
    out.push_back(pairs[i + 1]);
  }
  return out;
}

}  // namespace

std::string write_html(const EquivalenceReport& report) {
  Report page = as_report(report);
  FileReport& first = page.files.front();
  if (!first.results.empty() && report.a.program && report.b.program) {
    const BothPrograms both(report);
    first.program = report.a.program;
    first.run_of = both.program();
    const auto trace = both.trace();
    if (trace && !trace->steps.empty()) {
      auto& names = first.properties.properties.front().formulas;
      names = differing(*both.program(), *trace, names);
    }
    first.results.front().trace = trace;
  }
  return write_html(page);
}

}  // namespace rung
