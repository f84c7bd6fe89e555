#include "backend/plclib/bits.h"

#include <algorithm>
#include <utility>

namespace rung::backend {
namespace {

using Kind = Circuit::Kind;

constexpr std::size_t kStackLevels = 32;

bool is_block(const Circuit& circuit) {
  return circuit.kind == Kind::Series || circuit.kind == Kind::Parallel;
}

/// What stands on the stack at most. Parts stand behind what they are parts
/// of, so one walk from the end is enough.
std::size_t stack_levels(const Network& network) {
  std::vector<std::size_t> levels(network.size(), 0);
  for (std::size_t at = network.size(); at-- > 0;) {
    std::size_t blocks = 0;
    for (const std::uint32_t part : network[at].parts) {
      if (!is_block(network[part])) continue;
      const std::size_t below = blocks == 0 ? 0 : 1;
      levels[at] = std::max(levels[at], levels[part] + below);
      ++blocks;
    }
  }
  return levels.front();
}

class Lister {
 public:
  Lister(const Network& network, CellId known)
      : network_(network), known_(known) {}

  std::vector<BitCall> run() {
    todo_.push_back({0, {}});
    while (!todo_.empty()) {
      const Todo next = todo_.back();
      todo_.pop_back();
      if (next.alone) {
        calls_.push_back({next.name, {}});
        continue;
      }
      const Circuit& circuit = network_[next.at];
      if (is_block(circuit)) {
        join(circuit);
      } else {
        contact(circuit, next.name);
      }
    }
    return std::move(calls_);
  }

 private:
  struct Todo {
    std::uint32_t at = 0;
    std::string_view name;  // of a contact: "and", "or"; none: the first
    bool alone = false;
  };

  void contact(const Circuit& circuit, std::string_view name) {
    const bool first = calls_.empty() && name.empty();
    const bool there = first && !circuit.negated && known_.has_value() &&
                       circuit.cell == known_;
    if (there) return;
    if (name == "and") {
      name = circuit.negated ? "andNotBit" : "andBit";
    } else if (name == "or") {
      name = circuit.negated ? "orNotBit" : "orBit";
    } else {
      name = circuit.negated ? "inNot" : "in";
    }
    calls_.push_back({name, circuit.cell});
  }

  /// Blocks first, so that one block needs no stack; else what the accumulator
  /// holds.
  std::vector<std::uint32_t> in_order(const Circuit& circuit) const {
    std::vector<std::uint32_t> parts = circuit.parts;
    std::stable_partition(parts.begin(), parts.end(), [&](std::uint32_t part) {
      return is_block(network_[part]);
    });
    if (is_block(network_[parts.front()])) return parts;
    const auto held =
        std::find_if(parts.begin(), parts.end(), [&](std::uint32_t part) {
          return !network_[part].negated && network_[part].cell == known_;
        });
    if (known_.has_value() && held != parts.end()) {
      std::rotate(parts.begin(), held, held + 1);
    }
    return parts;
  }

  void join(const Circuit& circuit) {
    const bool series = circuit.kind == Kind::Series;
    const std::vector<std::uint32_t> parts = in_order(circuit);
    for (std::size_t i = parts.size(); i-- > 1;) {
      if (!is_block(network_[parts[i]])) {
        todo_.push_back({parts[i], series ? "and" : "or"});
        continue;
      }
      todo_.push_back({0, series ? "andBlock" : "orBlock", true});
      todo_.push_back({parts[i], {}});
      todo_.push_back({0, "push", true});
    }
    todo_.push_back({parts.front(), {}});
  }

  const Network& network_;
  CellId known_;
  std::vector<Todo> todo_;
  std::vector<BitCall> calls_;
};

}  // namespace

bool is_bit_list(const Terms& terms, bool with_stack) {
  const bool bits =
      std::all_of(terms.begin(), terms.end(), [](const Term& term) {
        return term.type == Type::Bit &&
               (term.op == NodeOp::Read || term.op == NodeOp::Constant ||
                term.op == NodeOp::Not || term.op == NodeOp::And ||
                term.op == NodeOp::Or);
      });
  if (!bits) return false;
  const Network network = network_of(terms);
  if (network.front().kind == Kind::Constant) return false;
  return stack_levels(network) <= (with_stack ? kStackLevels : 0);
}

std::vector<BitCall> bit_calls(const Terms& terms, CellId known) {
  const Network network = network_of(terms);
  return Lister(network, known).run();
}

std::size_t depth_of(const Terms& terms) {
  std::vector<std::size_t> depths;
  std::vector<NodeOp> ops;
  for (const Term& term : terms) {
    std::size_t operands = 0;
    const bool leaf = term.op == NodeOp::Read || term.op == NodeOp::Constant;
    if (!leaf)
      operands = term.op == NodeOp::Not || term.op == NodeOp::Negate ? 1 : 2;
    std::size_t depth = 1;
    for (std::size_t i = 0; i < operands; ++i) {
      // A chain to the left has no brackets.
      const bool chain =
          i + 1 == operands && operands == 2 && ops.back() == term.op;
      depth = std::max(depth, depths.back() + (chain ? 0 : 1));
      depths.pop_back();
      ops.pop_back();
    }
    depths.push_back(depth);
    ops.push_back(term.op);
  }
  return depths.empty() ? 0 : depths.back();
}

}  // namespace rung::backend
