#include "backend/plcopen/rungs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <string>
#include <utility>

#include "backend/unit/elements_common.h"

namespace rung::backend::plcopen {
namespace {

/// Wires between the ends of one part and the beginnings of the next: more are
/// not drawn.
constexpr std::size_t kMostWires = 32;

bool is_leaf(const Terms& terms) { return terms.size() == 1; }

/// A contact, or some in series.
bool is_row(const Network& network) {
  using Kind = Circuit::Kind;
  const Circuit& root = network.front();
  return root.kind != Kind::Parallel &&
         std::all_of(root.parts.begin(), root.parts.end(),
                     [&](std::uint32_t part) {
                       return network[part].kind == Kind::Contact;
                     });
}

/// How a unit uses a pin of its blocks.
struct PinUse {
  bool observed = false;  // read, or assigned outside of calls
  std::size_t given = 0;  // in so many calls
};

class RungMaker {
 public:
  explicit RungMaker(Unit& unit)
      : unit_(unit),
        calls_(unit.blocks.size(), 0),
        guarded_(unit.blocks.size(), false),
        pins_of_block_(unit.blocks.size()) {}

  std::vector<Rung> run() {
    count_uses();
    name_pins();
    for (const Statement& statement : unit_.statements) {
      source_ = statement.rung;
      if (statement.target.has_value()) {
        assign(statement.target, statement.value, statement.guard);
      } else {
        call(statement);
      }
    }
    return std::move(rungs_);
  }

 private:
  // --- pins that become variables --------------------------------------------

  void count_uses() {
    pins_.resize(unit_.variables.size());
    for (const Statement& statement : unit_.statements) {
      observe(statement.guard);
      observe(statement.value);
      if (statement.target.has_value()) {
        pins_[statement.target.index()].observed = true;
        continue;
      }
      ++calls_[statement.block.index()];
      if (!statement.guard.empty()) guarded_[statement.block.index()] = true;
      for (const Argument& argument : statement.arguments) {
        observe(argument.value);
        ++pins_[argument.pin.index()].given;
      }
    }
  }

  void name_pins() {
    for (const CellId id : ids_of(unit_.variables)) {
      Variable& variable = unit_.variables[id];
      if (!variable.block.has_value()) continue;
      const std::size_t block = variable.block.index();
      PinUse& use = pins_[id.index()];
      // A block that is not executed takes what its pins are given, and a call
      // that does not give one would see that.
      if (guarded_[block] && use.given > 0 && use.given < calls_[block]) {
        use.observed = true;
      }
      // A time is looked at where it is.
      if (!use.observed || variable.pin == "ET") continue;
      pins_of_block_[block].push_back(id);
      variable.name = unit_.names.add(variable.name);
      variable.block = {};
    }
  }

  void observe(const Terms& terms) {
    for (const Term& term : terms) {
      if (term.op == NodeOp::Read) pins_[term.cell.index()].observed = true;
    }
  }

  /// The variable that stands for a pin; none: nothing looks at it.
  CellId variable_of(BlockId block, std::string_view pin) const {
    for (const CellId cell : pins_of_block_[block.index()]) {
      if (unit_.variables[cell].pin == pin) return cell;
    }
    return {};
  }

  // --- statements ------------------------------------------------------------

  void assign(CellId target, const Terms& value, const Terms& guard) {
    if (unit_.variables[target].type == Type::Word) {
      Terms enable = guard.empty() ? Terms() : contact(guard, target);
      Rung& rung = add(Rung::Kind::Word, target);
      rung.word = value;
      rung.enable = std::move(enable);
      return;
    }
    if (guard.empty() && is_comparison(value.back().op)) {
      add(Rung::Kind::Compare, target).word = value;
      return;
    }
    const bool constant = is_leaf(value) && value[0].op == NodeOp::Constant;
    const bool plain = guard.empty() || constant;
    const Coil found =
        coil_for(target, value, plain ? guard : contact(guard, target));
    coil(target, bits(found.power, target), found.storage);
  }

  void coil(CellId target, const Terms& value,
            Storage storage = Storage::None) {
    Network power = split(network_of(value), target);
    Rung& rung = add(Rung::Kind::Coil, target);
    rung.power = std::move(power);
    rung.storage = storage;
  }

  void call(const Statement& statement) {
    const PinNames& names = pins_of(unit_.blocks[statement.block].type);
    const bool guarded = guarded_[statement.block.index()];
    const CellId first =
        statement.arguments.empty() ? CellId() : statement.arguments[0].pin;
    Terms enable;
    if (guarded) {
      enable = statement.guard.empty() ? constant_term(Type::Bit, 1)
                                       : contact(statement.guard, first);
    }
    for (const Argument& argument : statement.arguments) {
      if (!pins_[argument.pin.index()].observed) continue;
      assign(argument.pin, argument.value, statement.guard);
    }
    std::vector<Input> inputs;
    for (const std::string_view pin : names.inputs) {
      inputs.push_back(input(statement, pin));
    }
    Rung& rung = add(Rung::Kind::Call, CellId());
    rung.block = statement.block;
    rung.preset = statement.preset;
    rung.enable = std::move(enable);
    rung.inputs = std::move(inputs);
    for (const std::string_view pin : names.outputs) {
      const CellId target = variable_of(statement.block, pin);
      if (target.has_value()) rung.outputs.push_back({pin, target});
    }
    // Without a coil it would be executed behind all others.
    if (rung.outputs.empty()) {
      rung.outputs.push_back(
          {names.outputs[0],
           make(unit_.blocks[statement.block].name, Type::Bit)});
    }
  }

  Input input(const Statement& statement, std::string_view pin) {
    Input input{.pin = pin, .power = {}, .word = {}};
    if (pin == "PT") return input;  // the preset: written as it is
    Terms value;
    CellId cell = variable_of(statement.block, pin);
    if (cell.has_value()) {
      value = read_term(cell, unit_.variables[cell].type);
    } else {
      for (const Argument& argument : statement.arguments) {
        if (unit_.variables[argument.pin].pin != pin) continue;
        value = argument.value;
        cell = argument.pin;
      }
    }
    if (value.empty()) return input;  // it keeps what it was given
    const bool word = unit_.variables[cell].type == Type::Word;
    if (word && is_leaf(value)) {
      input.word = std::move(value);
    } else if (word) {
      const CellId made = make(unit_.variables[cell].name, Type::Word);
      add(Rung::Kind::Word, made).word = std::move(value);
      input.word = read_term(made, Type::Word);
    } else {
      input.power = row(value, cell);
    }
    return input;
  }

  // --- values ----------------------------------------------------------------

  Rung& add(Rung::Kind kind, CellId target) {
    Rung& rung = rungs_.emplace_back();
    rung.kind = kind;
    rung.source = source_;
    rung.target = target;
    return rung;
  }

  CellId make(const std::string& like, Type type) {
    return unit_.variables.add({.name = unit_.names.make(like), .type = type});
  }
  CellId make_like(CellId like) {
    return make(like.has_value() ? unit_.variables[like].name : "enable",
                Type::Bit);
  }

  Terms bits(const Terms& terms, CellId like) {
    return without_comparisons(terms, [&](Terms comparison) {
      const CellId made = make_like(like);
      add(Rung::Kind::Compare, made).word = std::move(comparison);
      return made;
    });
  }

  /// One contact for a condition.
  Terms contact(const Terms& condition, CellId like) {
    Terms plain = bits(condition, like);
    if (is_contact(plain) || is_leaf(plain)) return plain;
    const CellId made = make_like(like);
    coil(made, plain);
    return read_term(made, Type::Bit);
  }

  Network row(const Terms& value, CellId like) {
    const Terms plain = bits(value, like);
    Network network = network_of(plain);
    if (is_row(network)) return network;
    const CellId made = make_like(like);
    coil(made, plain);
    return network_of(read_term(made, Type::Bit));
  }

  /// Where a part with many ends stands before one with many beginnings, the
  /// first has a bit of its own: every end has a wire to every beginning.
  Network split(Network network, CellId like) {
    std::vector<std::size_t> begins(network.size(), 1);
    std::vector<std::size_t> ends(network.size(), 1);
    // Parts stand behind what they are parts of.
    for (std::size_t i = network.size(); i-- > 0;) {
      Circuit& circuit = network[i];
      const std::vector<std::uint32_t>& parts = circuit.parts;
      if (circuit.kind == Circuit::Kind::Parallel) {
        begins[i] = ends[i] = 0;
        for (const std::uint32_t part : parts) {
          begins[i] += begins[part];
          ends[i] += ends[part];
        }
      } else if (circuit.kind == Circuit::Kind::Series) {
        for (std::size_t at = 0; at + 1 < parts.size(); ++at) {
          const std::uint32_t left = parts[at];
          if (ends[left] == 1 || begins[parts[at + 1]] == 1) continue;
          if (ends[left] * begins[parts[at + 1]] <= kMostWires) continue;
          take_out(network, left, like);
          begins[left] = ends[left] = 1;
        }
        begins[i] = begins[parts.front()];
        ends[i] = ends[parts.back()];
      }
    }
    return network;
  }

  /// A part of a network as the network of a coil; its contact takes its place.
  void take_out(Network& network, std::uint32_t part, CellId like) {
    const CellId made = make_like(like);
    add(Rung::Kind::Coil, made).power = network_at(network, part);
    network[part] = {.kind = Circuit::Kind::Contact, .cell = made};
  }

  Unit& unit_;
  std::vector<Rung> rungs_;
  RungId source_;
  std::vector<PinUse> pins_;        // by variable
  std::vector<std::size_t> calls_;  // by block
  std::vector<bool> guarded_;
  std::vector<std::vector<CellId>> pins_of_block_;  // that are variables
};

const std::array<PinNames, 10> kPins = {{
    {"TON", {"IN", "PT"}, {"Q", "ET"}},
    {"TOF", {"IN", "PT"}, {"Q", "ET"}},
    {"TP", {"IN", "PT"}, {"Q", "ET"}},
    {"CTU", {"CU", "R", "PV"}, {"Q", "CV"}},
    {"CTD", {"CD", "LD", "PV"}, {"Q", "CV"}},
    {"CTUD", {"CU", "CD", "R", "LD", "PV"}, {"QU", "QD", "CV"}},
    {"R_TRIG", {"CLK"}, {"Q"}},
    {"F_TRIG", {"CLK"}, {"Q"}},
    {"SR", {"S1", "R"}, {"Q1"}},
    {"RS", {"S", "R1"}, {"Q1"}},
}};

}  // namespace

const PinNames& pins_of(std::string_view block) {
  const auto found =
      std::find_if(kPins.begin(), kPins.end(),
                   [&](const PinNames& it) { return it.type == block; });
  assert(found != kPins.end());
  return *found;
}

std::vector<Rung> make_rungs(Unit& unit) { return RungMaker(unit).run(); }

}  // namespace rung::backend::plcopen
