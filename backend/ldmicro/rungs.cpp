#include "backend/ldmicro/rungs.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "backend/unit/contacts.h"

namespace rung::backend::ldmicro {
namespace {

/// Elements in a row or in branches: older versions of the tool have room for
/// sixteen, the coil among them.
constexpr std::size_t kMostParts = 15;

std::string_view instruction_of(NodeOp op) {
  switch (op) {
    case NodeOp::Equal:
      return "EQU";
    case NodeOp::NotEqual:
      return "NEQ";
    case NodeOp::Less:
      return "LES";
    case NodeOp::LessEqual:
      return "LEQ";
    case NodeOp::Greater:
      return "GRT";
    case NodeOp::GreaterEqual:
      return "GEQ";
    case NodeOp::Add:
      return "ADD";
    case NodeOp::Multiply:
      return "MUL";
    case NodeOp::Divide:
      return "DIV";
    default:
      return "SUB";  // a negation, too
  }
}

NodeOp opposite(NodeOp op) {
  switch (op) {
    case NodeOp::Equal:
      return NodeOp::NotEqual;
    case NodeOp::NotEqual:
      return NodeOp::Equal;
    case NodeOp::Less:
      return NodeOp::GreaterEqual;
    case NodeOp::LessEqual:
      return NodeOp::Greater;
    case NodeOp::Greater:
      return NodeOp::LessEqual;
    default:
      return NodeOp::Less;
  }
}

class RungMaker {
 public:
  RungMaker(Unit& unit, std::int64_t cycle)
      : unit_(unit), cycle_(cycle), outputs_(unit.blocks.size()) {
    for (const CellId id : ids_of(unit.variables)) {
      const Variable& variable = unit.variables[id];
      if (!variable.block.has_value() || variable.pin != "Q") continue;
      outputs_[variable.block.index()] = id;
    }
  }

  Rungs run() {
    first_values();
    const std::size_t first = out_.rungs.size();
    for (const Statement& statement : unit_.statements) {
      source_ = statement.rung;
      if (statement.target.has_value()) {
        assign(statement.target, statement.value, statement.guard);
      } else {
        call(statement);
      }
    }
    sample_inputs(first);
    return std::move(out_);
  }

 private:
  const std::string& name_of(CellId cell) const {
    return unit_.variables[cell].name;
  }
  CellId make_bit(CellId like) {
    const std::string& name = name_of(like);
    return unit_.variables.add(
        {.name = unit_.names.make(name[0] == 'R' ? name : "R" + name)});
  }
  CellId add_bit(const std::string& name) {
    return unit_.variables.add({.name = unit_.names.add(name)});
  }
  CellId make_number() {
    return unit_.variables.add(
        {.name = unit_.names.make("Nvalue"), .type = Type::Word});
  }

  void add(Network power, std::string output) {
    out_.rungs.push_back({source_, std::move(power), {std::move(output)}});
  }
  void coil(CellId target, Network power, Storage storage = Storage::None) {
    const std::string_view flags = storage == Storage::Set     ? " 0 1 0"
                                   : storage == Storage::Reset ? " 0 0 1"
                                                               : " 0 0 0";
    power = short_rows(std::move(power), target);
    add(std::move(power), "COIL " + name_of(target) + std::string(flags));
  }
  static Network always() {
    return {{.kind = Circuit::Kind::Constant, .value = true}};
  }

  // --- before the first rung -------------------------------------------------

  void first_values() {
    CellId started;
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable variable = unit_.variables[id];
      if (variable.initial == 0) continue;
      if (!started.has_value()) started = add_bit("Rstarted");
      const Network first = {{.negated = true, .cell = started}};
      if (variable.type == Type::Bit) {
        coil(id, first, Storage::Set);
      } else {
        add(first,
            "MOVE " + variable.name + " " + std::to_string(variable.initial));
      }
      relate(variable, name_of(started));
    }
    if (started.has_value()) coil(started, always());
  }

  /// What the source begins with, the result has from its first scan on.
  void relate(const Variable& variable, const std::string& started) {
    const bool bit = variable.type == Type::Bit;
    const StateRelation::Name source = {"s", variable.source};
    const StateRelation::Name here = {"h", variable.name, true};
    const StateRelation::Name relay = {"k", started, true};
    unit_.relations.push_back(
        {bit ? "!k || (s <-> h)" : "!k || s == h", {relay, source, here}});
    unit_.relations.push_back(
        {bit ? "k || s" : "k || s == " + std::to_string(variable.initial),
         {relay, source}});
  }

  /// Inputs with several contacts, at the place `at`.
  void sample_inputs(std::size_t at) {
    std::unordered_map<CellId, std::size_t> reads;
    const auto for_inputs = [&](const auto& use) {
      for (Rung& rung : out_.rungs) {
        for (Circuit& circuit : rung.power) {
          const bool contact = circuit.kind == Circuit::Kind::Contact;
          if (!contact || out_.comparisons.contains(circuit.cell)) continue;
          const Variable& variable = unit_.variables[circuit.cell];
          if (variable.role == CellRole::Input) use(circuit);
        }
      }
    };
    for_inputs([&](const Circuit& contact) { ++reads[contact.cell]; });
    std::unordered_map<CellId, CellId> copies;
    std::vector<Rung> samples;
    for (const CellId id : ids_of(unit_.variables)) {
      const auto found = reads.find(id);
      if (found == reads.end() || found->second == 1) continue;
      const CellId copy = add_bit("R" + name_of(id));
      copies.emplace(id, copy);
      samples.push_back(
          {{}, {{.cell = id}}, {"COIL " + name_of(copy) + " 0 0 0"}});
    }
    for_inputs([&](Circuit& contact) {
      const auto copy = copies.find(contact.cell);
      if (copy != copies.end()) contact.cell = copy->second;
    });
    out_.rungs.insert(out_.rungs.begin() + static_cast<std::ptrdiff_t>(at),
                      samples.begin(), samples.end());
  }

  // --- statements ------------------------------------------------------------

  void assign(CellId target, const Terms& value, const Terms& guard) {
    if (unit_.variables[target].type == Type::Word) {
      const std::string instruction = number(value, target);
      return add(guard.empty() ? always() : power_of(guard, target),
                 instruction);
    }
    const bool constant = value.size() == 1 && value[0].op == NodeOp::Constant;
    const bool plain = guard.empty() || constant;
    const Coil found =
        coil_for(target, value, plain ? guard : contact(guard, target));
    coil(target, network_of(bits(found.power)), found.storage);
  }

  /// The power of what is no coil.
  Network power_of(const Terms& terms, CellId like) {
    return short_rows(network_of(bits(terms)), like);
  }

  Terms contact(const Terms& condition, CellId like) {
    Terms plain = bits(condition);
    if (is_contact(plain) || plain.size() == 1) return plain;
    const CellId made = make_bit(like);
    coil(made, network_of(plain));
    return read_term(made, Type::Bit);
  }

  void call(const Statement& statement) {
    const Block& block = unit_.blocks[statement.block];
    const Argument& argument = statement.arguments[0];
    Network power = power_of(argument.value, argument.pin);
    if (unit_.variables[argument.pin].pin == "RES") {
      return add(std::move(power), "RES " + block.name);
    }
    std::string text = std::string(block.type) + " " + block.name + " ";
    if (block.type == "CTU") {
      text += std::to_string(*statement.preset);
    } else {
      // The scan that completes the delay, in us; no adjustment.
      const std::int64_t scans = (*statement.preset + cycle_ - 1) / cycle_;
      text += std::to_string(scans * cycle_ * 1000) + " 0";
    }
    add(std::move(power), std::move(text));
    const CellId output = outputs_[statement.block.index()];
    if (!output.has_value()) return;
    out_.rungs.back().outputs.push_back("COIL " + name_of(output) + " 0 0 0");
  }

  // --- values ----------------------------------------------------------------

  Terms bits(const Terms& terms) {
    return without_comparisons(terms, [&](const Terms& comparison) {
      const std::size_t right = comparison.size() - 2;
      const std::size_t left = right - comparison[right].size;
      const auto begin = comparison.begin();
      const auto middle = begin + static_cast<std::ptrdiff_t>(left) + 1;
      const std::string operands = " " + operand({begin, middle}) + " " +
                                   operand({middle, comparison.end() - 1});
      const NodeOp op = comparison.back().op;
      // No variable of the text: it stands for the comparison.
      const CellId cell = unit_.variables.add({.type = Type::Bit});
      out_.comparisons[cell] = {
          std::string(instruction_of(op)) + operands,
          std::string(instruction_of(opposite(op))) + operands};
      return cell;
    });
  }

  std::string leaf(const Term& term) const {
    return term.op == NodeOp::Read ? name_of(term.cell)
                                   : std::to_string(term.value);
  }

  /// The name or the number that has the value from here on.
  std::string operand(const Terms& terms) {
    if (terms.size() == 1) return leaf(terms[0]);
    const CellId made = make_number();
    add(always(), number(terms, made));
    return name_of(made);
  }

  /// What writes the value into `target`; its operands are computed before.
  std::string number(const Terms& terms, CellId target) {
    if (terms.size() == 1) {
      return "MOVE " + name_of(target) + " " + leaf(terms[0]);
    }
    std::vector<std::string> values;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Term& term = terms[i];
      if (term.size == 1) {
        values.push_back(leaf(term));
        continue;
      }
      std::string right = std::move(values.back());
      values.pop_back();
      std::string left = "0";  // of a negation
      if (term.op != NodeOp::Negate) {
        left = std::move(values.back());
        values.pop_back();
      }
      const bool last = i + 1 == terms.size();
      const std::string into = name_of(last ? target : make_number());
      std::string text(instruction_of(term.op));
      for (const std::string_view part :
           {std::string_view(into), std::string_view(left),
            std::string_view(right)}) {
        text += ' ';
        text += part;
      }
      if (last) return text;
      add(always(), std::move(text));
      values.push_back(into);
    }
    return {};
  }

  /// Rows and branches that are too long get relays.
  Network short_rows(Network network, CellId like) {
    for (std::size_t i = network.size(); i-- > 0;) {
      while (network[i].parts.size() > kMostParts) {
        const std::vector<std::uint32_t> parts = network[i].parts;
        std::vector<std::uint32_t> shorter;
        for (std::size_t at = 0; at < parts.size(); at += kMostParts) {
          const std::size_t end = std::min(at + kMostParts, parts.size());
          const auto begin = parts.begin() + static_cast<std::ptrdiff_t>(at);
          const auto group = static_cast<std::uint32_t>(network.size());
          network.push_back(
              {.kind = network[i].kind,
               .parts = {begin,
                         parts.begin() + static_cast<std::ptrdiff_t>(end)}});
          const CellId made = make_bit(like);
          add(network_at(network, group), "COIL " + name_of(made) + " 0 0 0");
          network[group] = {.kind = Circuit::Kind::Contact, .cell = made};
          shorter.push_back(group);
        }
        network[i].parts = std::move(shorter);
      }
    }
    return network_at(network, 0);  // without what was taken out
  }

  Unit& unit_;
  const std::int64_t cycle_;
  std::vector<CellId> outputs_;  // by block
  Rungs out_;
  RungId source_;
};

}  // namespace

Rungs make_rungs(Unit& unit, std::int64_t cycle) {
  return RungMaker(unit, cycle).run();
}

}  // namespace rung::backend::ldmicro
