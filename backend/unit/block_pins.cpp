#include "backend/unit/block_pins.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace rung::backend {
namespace {

using enum NodeOp;

bool is_input(const Instance& instance, std::string_view name) {
  const auto parameters = instance.kind->operations.front().parameters;
  return std::any_of(
      parameters.begin(), parameters.end(),
      [&](const ElementParameter& it) { return it.name == name; });
}

/// In storage; empty when there is no such pin.
std::string_view pin_name(const Instance& instance, const std::string& name) {
  for (const ElementParameter& it :
       instance.kind->operations.front().parameters) {
    if (it.name == name && it.kind != ParameterKind::Index) return it.name;
  }
  const std::string_view first = output_of(instance.kind->letter);
  if (name == first) return first;
  for (const ElementOperation& it : instance.kind->operations) {
    const std::size_t dot = it.name.find('.');
    if (dot != std::string_view::npos && it.name.substr(dot + 1) == name) {
      return it.name.substr(dot + 1);
    }
  }
  return {};
}

/// By cell: its rungs, where each takes over what a call gives: `t.Q := call`
/// or the same behind a condition. 0 for all others.
std::vector<std::uint32_t> count_results(const Program& program) {
  std::vector<std::uint32_t> counts(program.cells.size(), 0);
  std::vector<bool> other(program.cells.size(), false);
  for (const Rung& rung : program.rungs) {
    const Node& root = program.nodes[rung.root()];
    const Node* const left = root.op == Or ? &program.nodes[root.a] : nullptr;
    const bool call = root.op == Call || (left != nullptr && left->op == And &&
                                          program.nodes[left->a].op == Read &&
                                          program.nodes[left->b].op == Call);
    if (call) {
      ++counts[rung.target.index()];
    } else {
      other[rung.target.index()] = true;
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (other[i]) counts[i] = 0;
  }
  return counts;
}

/// By cell: the one number that its rungs give it, from before the first call
/// of its instance on.
class ConstantInputs {
 public:
  explicit ConstantInputs(const Program& program)
      : inputs_(program.cells.size()),
        calls_(program.instances.size(), kNever) {
    for (const RungId id : ids_of(program.rungs)) {
      const Rung& rung = program.rungs[id];
      for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
        const Node& node = program.nodes[at];
        if (node.op != Call) continue;
        std::uint32_t& first =
            calls_[program.calls[node.call].instance.index()];
        first = std::min(first, id.index());
      }
      note(inputs_[rung.target.index()], program.nodes[rung.root()],
           id.index());
    }
  }

  std::optional<std::int64_t> value(CellId cell, InstanceId instance) const {
    const Input& input = inputs_[cell.index()];
    const bool known = input.first < calls_[instance.index()];
    return known && input.constant ? std::optional(input.value) : std::nullopt;
  }

 private:
  static constexpr std::uint32_t kNever = ~0U;
  struct Input {
    std::int64_t value = 0;
    std::uint32_t first = kNever;
    bool constant = true;
  };

  static void note(Input& input, const Node& root, std::uint32_t rung) {
    if (input.first == kNever) {
      input.first = rung;
      input.value = root.value;
    }
    if (root.op != Constant || root.value != input.value) {
      input.constant = false;
    }
  }

  std::vector<Input> inputs_;
  std::vector<std::uint32_t> calls_;  // the first rung that has one
};

}  // namespace

bool is_block(const ElementKind& kind) {
  return kind.is_in("iec") || kind.is_in("matiec");
}

std::string_view output_of(std::string_view block) {
  if (block == "CTUD") return "QU";
  return block == "SR" || block == "RS" ? "Q1" : "Q";
}

std::vector<BlockPin> find_block_pins(const Program& program) {
  std::vector<BlockPin> pins;
  std::unordered_map<std::string_view, InstanceId> by_name;
  for (const InstanceId id : ids_of(program.instances)) {
    if (!is_block(*program.instances[id].kind)) continue;
    by_name.emplace(program.instances[id].name, id);
  }
  if (by_name.empty()) return pins;
  const std::vector<std::uint32_t> results = count_results(program);
  std::vector<std::uint32_t> steps(program.instances.size(), 0);
  for (const ElementCall& call : program.calls) {
    if (call.operation->steps()) ++steps[call.instance.index()];
  }
  const ConstantInputs constants(program);
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    const std::size_t dot = cell.name.rfind('.');
    if (!cell.made || dot == std::string::npos) continue;
    const auto found = by_name.find(std::string_view(cell.name).substr(0, dot));
    if (found == by_name.end()) continue;
    const Instance& instance = program.instances[found->second];
    const std::string_view name = pin_name(instance, cell.name.substr(dot + 1));
    if (name.empty()) continue;
    const bool input = is_input(instance, name);
    if (!input && results[id.index()] != steps[found->second.index()]) continue;
    pins.push_back({.cell = id,
                    .instance = found->second,
                    .name = name,
                    .type = cell.type,
                    .constant = constants.value(id, found->second)});
  }
  return pins;
}

}  // namespace rung::backend
