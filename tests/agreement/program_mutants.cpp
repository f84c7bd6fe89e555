#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mutant.h"

namespace rung {
namespace {

/// Changes the program that is encoded; false: it has nothing to change.
using Change = std::function<bool(Program&)>;

Mutant mutant_of(std::string name, Change change) {
  return {std::move(name),
          [change = std::move(change)](
              const Program& program) -> std::optional<Encoding> {
            Encoding result{program, {}};
            if (!change(result.program)) return std::nullopt;
            result.ts = build_transition_system(result.program);
            return result;
          }};
}

Change each_node(NodeOp op, std::function<void(Node&, Program&)> change) {
  return [op, change = std::move(change)](Program& program) {
    bool changed = false;
    for (Node& node : program.nodes) {
      if (node.op != op) continue;
      change(node, program);
      changed = true;
    }
    return changed;
  };
}

Change becomes(NodeOp from, NodeOp to) {
  return each_node(from, [to](Node& node, Program&) { node.op = to; });
}

void add_operators(std::vector<Mutant>& result) {
  using enum NodeOp;
  struct Row {
    const char* name;
    NodeOp from;
    NodeOp to;
  };
  static constexpr Row kRows[] = {
      {"and is encoded as or", And, Or},
      {"or is encoded as and", Or, And},
      {"exclusive or as or", Xor, Or},
      {"exclusive or as equal", Xor, Equal},
      {"== is encoded as !=", Equal, NotEqual},
      {"== is encoded as <=", Equal, LessEqual},
      {"== is encoded as >=", Equal, GreaterEqual},
      {"!= is encoded as ==", NotEqual, Equal},
      {"!= is encoded as <", NotEqual, Less},
      {"!= is encoded as >", NotEqual, Greater},
      {"< is encoded as <=", Less, LessEqual},
      {"< with its operands exchanged", Less, Greater},
      {"<= is encoded as <", LessEqual, Less},
      {"<= with its operands exchanged", LessEqual, GreaterEqual},
      {"> is encoded as >=", Greater, GreaterEqual},
      {"> with its operands exchanged", Greater, Less},
      {">= is encoded as >", GreaterEqual, Greater},
      {">= with its operands exchanged", GreaterEqual, LessEqual},
      {"+ is encoded as -", Add, Subtract},
      {"- is encoded as +", Subtract, Add},
      {"* is encoded as +", Multiply, Add},
      {"/ is encoded as *", Divide, Multiply},
      {"the negation of words is left out", Negate, Wrap16},
      {"the 16-bit wrap as a negation", Wrap16, Negate},
  };
  for (const Row& row : kRows) {
    result.push_back(mutant_of(row.name, becomes(row.from, row.to)));
  }
}

void add_operands(std::vector<Mutant>& result) {
  using enum NodeOp;
  result.push_back(
      mutant_of("not is left out", each_node(Not, [](Node& node, Program&) {
                  node.op = And;
                  node.b = node.a;
                })));
  for (const auto& [op, name] :
       {std::pair{And, "and"}, std::pair{Or, "or"},
        std::pair{Xor, "exclusive or"}, std::pair{Add, "+"}}) {
    result.push_back(mutant_of(
        std::string(name) + " takes its left operand twice",
        each_node(op, [](Node& node, Program&) { node.b = node.a; })));
    result.push_back(mutant_of(
        std::string(name) + " takes its right operand twice",
        each_node(op, [](Node& node, Program&) { node.a = node.b; })));
  }
  result.push_back(mutant_of("- with its operands exchanged",
                             each_node(Subtract, [](Node& node, Program&) {
                               std::swap(node.a, node.b);
                             })));
  result.push_back(mutant_of("a divisor is one larger",
                             each_node(Divide, [](Node& node, Program& all) {
                               ++all.nodes[node.b].value;
                             })));
  for (const int by : {-1, 1}) {
    result.push_back(mutant_of("constants are off by " + std::to_string(by),
                               each_node(Constant, [by](Node& node, Program&) {
                                 node.value = node.type == Type::Bit
                                                  ? 1 - node.value
                                                  : node.value + by;
                               })));
  }
}

void add_branches(std::vector<Mutant>& result) {
  using enum NodeOp;
  result.push_back(mutant_of("skipped operands are executed",
                             each_node(Branch, [](Node& node, Program&) {
                               node = {.op = Constant};
                             })));
  result.push_back(mutant_of("the condition of a skip is negated",
                             each_node(Branch, [](Node& node, Program&) {
                               node.skip_when = !node.skip_when;
                             })));
  result.push_back(mutant_of(
      "a skip ends one node early",
      each_node(Branch, [](Node& node, Program&) { --node.target; })));
}

Change each_call(std::function<bool(ElementCall&)> change) {
  return [change = std::move(change)](Program& program) {
    bool changed = false;
    for (const CallId id : ids_of(program.calls)) {
      changed = change(program.calls[id]) || changed;
    }
    return changed;
  };
}

bool has_preset(const ElementCall& call) {
  return std::any_of(call.operation->parameters.begin(),
                     call.operation->parameters.end(),
                     [](const ElementParameter& parameter) {
                       return parameter.kind == ParameterKind::Seconds ||
                              parameter.kind == ParameterKind::Count;
                     });
}

void add_calls(std::vector<Mutant>& result) {
  for (const int by : {-1, 1}) {
    const std::string off = " are off by " + std::to_string(by);
    result.push_back(
        mutant_of("presets" + off, each_call([by](ElementCall& call) {
                    if (has_preset(call)) call.parameter += by;
                    return has_preset(call);
                  })));
    result.push_back(
        mutant_of("the largest presets of elements" + off, [by](Program& all) {
          for (const InstanceId id : ids_of(all.instances)) {
            all.instances[id].largest_parameter += by;
          }
          return !all.instances.empty();
        }));
    result.push_back(mutant_of("the caps of clocks" + off, [by](Program& all) {
      for (const InstanceId id : ids_of(all.instances)) {
        all.instances[id].clock_cap += by;
      }
      return !all.instances.empty();
    }));
  }
  result.push_back(mutant_of(
      "bit operands of calls are exchanged", each_call([](ElementCall& call) {
        std::reverse(call.arguments.begin(), call.arguments.end());
        return call.arguments.size() > 1;
      })));
}

void add_cells(std::vector<Mutant>& result) {
  result.push_back(mutant_of("initial values are off by one", [](Program& all) {
    bool changed = false;
    for (const CellId id : ids_of(all.cells)) {
      Cell& cell = all.cells[id];
      if (cell.role == CellRole::Input) continue;
      cell.initial =
          cell.type == Type::Bit ? 1 - cell.initial : cell.initial + 1;
      changed = true;
    }
    return changed;
  }));
  result.push_back(mutant_of("words that rungs write have half of their range",
                             [](Program& all) {
                               bool changed = false;
                               for (const CellId id : ids_of(all.cells)) {
                                 Cell& cell = all.cells[id];
                                 if (cell.type == Type::Bit) continue;
                                 if (cell.role == CellRole::Input) continue;
                                 cell.low /= 2;
                                 cell.high /= 2;
                                 changed = true;
                               }
                               return changed;
                             }));
  result.push_back(mutant_of("rungs run from bottom to top", [](Program& all) {
    Arena<RungId, Rung> reversed;
    for (std::size_t i = all.rungs.size(); i-- > 0;) {
      reversed.add(all.rungs[RungId(static_cast<std::uint32_t>(i))]);
    }
    all.rungs = std::move(reversed);
    return all.rungs.size() > 1;
  }));
  result.push_back(mutant_of("the last rung is left out", [](Program& all) {
    Arena<RungId, Rung> shorter;
    for (std::size_t i = 0; i + 1 < all.rungs.size(); ++i) {
      shorter.add(all.rungs[RungId(static_cast<std::uint32_t>(i))]);
    }
    all.rungs = std::move(shorter);
    return true;
  }));
}

}  // namespace

std::vector<Mutant> program_mutants() {
  std::vector<Mutant> result;
  add_operators(result);
  add_operands(result);
  add_branches(result);
  add_calls(result);
  add_cells(result);
  return result;
}

}  // namespace rung
