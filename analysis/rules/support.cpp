#include "analysis/rules/support.h"

#include <algorithm>

namespace rung {

std::string quoted(std::string_view name) {
  return "`" + std::string(name) + "`";
}

std::string quoted(const Program& program, CellId cell) {
  return quoted(program.cells[cell].name);
}

bool is_implicit(const Program& program, CellId cell) {
  return program.cells[cell].name == "ENO";
}

std::string counted(std::size_t count, std::string_view thing) {
  return std::to_string(count) + " " + std::string(thing) +
         (count == 1 ? "" : "s");
}

std::uint32_t line_of(const RuleRun& run, SourceRange where) {
  if (!where.has_value()) return 0;
  return run.sources[where.file].position(where.begin).line;
}

std::string_view text_of(const RuleRun& run, SourceRange where) {
  return where.has_value() ? run.sources.text(where) : std::string_view();
}

std::string proof_text(const Oracle::Evidence& evidence) {
  return "proved for every reachable state (" + evidence.engine + ")";
}

std::string witness_text(const RuleRun& run, const Oracle::Evidence& evidence) {
  if (!evidence.witness || evidence.witness->steps.empty()) return {};
  const Trace::Step& last = evidence.witness->steps.back();
  std::string text = "seen in scan " + std::to_string(last.scan);
  std::size_t shown = 0;
  for (const CellId id : ids_of(run.program.cells)) {
    const Cell& cell = run.program.cells[id];
    if (cell.role != CellRole::Input || shown == 6) continue;
    text += (shown++ == 0 ? ", with " : ", ") + quoted(cell.name) + " = " +
            std::to_string(last.values[id.index()]);
  }
  return text;
}

std::vector<std::uint32_t> operands(const Program& program, std::uint32_t root,
                                    NodeOp op) {
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> open = {root};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    if (program.nodes[node].op != op) {
      found.push_back(node);
      continue;
    }
    open.push_back(program.nodes[node].b);
    open.push_back(program.nodes[node].a);
  }
  return found;
}

std::uint32_t writer_above(const RuleRun& run, CellId cell,
                           std::uint32_t rung) {
  const std::span<const std::uint32_t> writers =
      run.index.writers[cell.index()];
  const auto below = std::lower_bound(writers.begin(), writers.end(), rung);
  return below == writers.begin() ? ProgramIndex::kNone : *(below - 1);
}

Contact contact_at(const Program& program, std::uint32_t node) {
  bool inverted = false;
  while (program.nodes[node].op == NodeOp::Not) {
    inverted = !inverted;
    node = program.nodes[node].a;
  }
  if (program.nodes[node].op != NodeOp::Read) return {};
  return {program.nodes[node].cell, inverted};
}

bool is_literal(const RuleRun& run, RungId rung) {
  const Rung& it = run.program.rungs[rung];
  return run.program.nodes[it.root()].op == NodeOp::Constant;
}

bool only_follows(const RuleRun& run, RungId rung) {
  const std::uint32_t root = run.program.rungs[rung].root();
  const Node& node = run.program.nodes[root];
  if (node.op == NodeOp::Call) {
    const ElementCall& call = run.program.calls[node.call];
    return !call.operation->resets &&
           run.program.instances[call.instance].kind->family !=
               ElementFamily::Edge;
  }
  const Contact contact = contact_at(run.program, root);
  return contact.cell.has_value() &&
         contact.cell != run.program.rungs[rung].target &&
         run.program.cells[contact.cell].role != CellRole::Input;
}

bool same_structure(const RuleRun& run, std::uint32_t left,
                    std::uint32_t right) {
  const std::vector<Node>& nodes = run.program.nodes;
  const std::uint32_t left_first = run.index.first[left];
  const std::uint32_t right_first = run.index.first[right];
  if (left - left_first != right - right_first) return false;
  for (std::uint32_t i = 0; i <= left - left_first; ++i) {
    const Node& a = nodes[left_first + i];
    const Node& b = nodes[right_first + i];
    if (a.op != b.op || a.cell != b.cell || a.value != b.value ||
        a.op == NodeOp::Call) {
      return false;
    }
  }
  return true;
}

namespace {

bool calls_differ(const RuleRun& run, const ElementCall& a,
                  const ElementCall& b) {
  if (a.parameter != b.parameter || a.operation != b.operation) return true;
  for (std::size_t i = 0; i < a.arguments.size(); ++i) {
    if (!same_structure(run, a.arguments[i], b.arguments[i])) return true;
  }
  return false;
}

}  // namespace

Twins conflicting_calls(const RuleRun& run, InstanceId instance) {
  Twins twins;
  if (has_status(*run.program.instances[instance].kind)) return twins;
  for (const std::uint32_t index : run.index.calls[instance.index()]) {
    const CallId id(index);
    const ElementCall& call = run.program.calls[id];
    if (call.operation->resets || call.operation->reads) continue;
    if (!twins.first.has_value()) {
      twins.first = id;
      continue;
    }
    // One call of the text, which the reader put in several times.
    if (call.where == run.program.calls[twins.first].where) continue;
    const bool differ = calls_differ(run, run.program.calls[twins.first], call);
    if (!twins.second.has_value() || differ) {
      twins = {twins.first, id, differ};
    }
    if (differ) break;
  }
  return twins;
}

std::string_view family_name(const Instance& instance) {
  switch (instance.kind->family) {
    case ElementFamily::Timer:
      return "timer";
    case ElementFamily::Counter:
      return "counter";
    case ElementFamily::Edge:
      return "edge";
    case ElementFamily::Latch:
      return "latch";
  }
  return "";
}

bool has_status(const ElementKind& kind) {
  return std::any_of(kind.operations.begin(), kind.operations.end(),
                     [](const ElementOperation& operation) {
                       return operation.reads && operation.name.ends_with(".Q");
                     });
}

bool is_generated(const RuleRun& run, std::uint32_t index) {
  const Rung& rung = run.program.rungs[RungId(run.index.rung_of[index])];
  return run.program.cells[rung.target].made &&
         run.program.nodes[index].where == rung.where;
}

std::string_view reset_name(const ElementKind& kind) {
  for (const ElementOperation& operation : kind.operations) {
    if (operation.resets) return operation.name;
  }
  return {};
}

}  // namespace rung
