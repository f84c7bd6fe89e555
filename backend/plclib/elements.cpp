#include "backend/plclib/elements.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "backend/plclib/bits.h"
#include "backend/unit/elements_common.h"

namespace rung::backend {
namespace {

constexpr std::int64_t kLongest = 24LL * 24 * 3'600 * 1'000;  // ms
constexpr std::int64_t kLargest = 2'147'483'647;              // of a long

enum class Shape : std::uint8_t {
  None,
  OnDelay,
  OffDelay,
  Pulse,
  YunTimer,
  OwnTimer,
  YunCounter,
  SimCounter,
  UpCounter,
  DownCounter,
  UpDownCounter,
  Edge,
  Latch,
};
struct Row {
  std::string_view kind;
  Shape shape;
};
constexpr std::array<Row, 19> kRows = {{{"ton", Shape::OnDelay},
                                        {"timer-sim", Shape::OnDelay},
                                        {"tof", Shape::OffDelay},
                                        {"timer-off-sim", Shape::OffDelay},
                                        {"tp", Shape::Pulse},
                                        {"timer-yun", Shape::YunTimer},
                                        {"timer-plclib", Shape::OwnTimer},
                                        {"timer-plclib14", Shape::OwnTimer},
                                        {"counter-yun", Shape::YunCounter},
                                        {"counter-sim", Shape::SimCounter},
                                        {"ctu", Shape::UpCounter},
                                        {"ctd", Shape::DownCounter},
                                        {"ctud", Shape::UpDownCounter},
                                        {"edge", Shape::Edge},
                                        {"r-trig", Shape::Edge},
                                        {"f-trig", Shape::Edge},
                                        {"sr", Shape::Latch},
                                        {"rs", Shape::Latch},
                                        {"", Shape::None}}};

Shape shape_of(std::string_view kind) {
  const auto* const row =
      std::find_if(kRows.begin(), kRows.end() - 1,
                   [&](const Row& it) { return it.kind == kind; });
  return row->shape;
}

bool is_timer(Shape shape) {
  return shape == Shape::OnDelay || shape == Shape::OffDelay ||
         shape == Shape::Pulse || shape == Shape::YunTimer ||
         shape == Shape::OwnTimer;
}

class PlclibElements : public MappedElements {
 public:
  PlclibElements() : MappedElements(kLargest) {}

  Terms call(UnitBuilder& builder, const ElementCall& call,
             std::vector<Terms> arguments) override {
    const std::string_view kind =
        builder.program().instances[call.instance].kind->id;
    Use& use = use_of(call);
    const Shape shape = shape_of(kind);
    if (call.operation->reads) return read(builder, call, use, shape);
    const auto on_delay = [&](Terms input, std::int64_t milliseconds) {
      return run(builder, call, "timerOn", std::move(input), milliseconds);
    };
    if (is_timer(shape) && !use.block.has_value()) {
      return constant_term(Type::Bit, 0);  // declare_instance() has refused it
    }
    switch (shape) {
      case Shape::OnDelay:
      case Shape::Pulse:
        return timer(builder, call, shape, arguments[0]);
      case Shape::OffDelay:
        return off_delay(builder, call, use, arguments[0], on_delay);
      case Shape::YunTimer:
        return timer_yun(builder, call, use, arguments[0], on_delay);
      case Shape::OwnTimer:
        return own_timer(builder, call, std::move(arguments[0]));
      case Shape::YunCounter:
        return counter_yun(builder, call, use, arguments[0]);
      case Shape::SimCounter:
        return counter_sim(builder, call, use, arguments);
      case Shape::UpCounter:
      case Shape::DownCounter:
        return counter_one_way(builder, call, shape, arguments);
      case Shape::UpDownCounter:
        return counter_both_ways(builder, call, arguments);
      case Shape::Edge:
        return edge_as_bit(builder, call, use, arguments[0]);
      case Shape::Latch:
        return builder.result_of(
            call, latch_as_bit(builder, use, kind == "sr", arguments));
      case Shape::None:
        break;
    }
    return constant_term(Type::Bit, 0);
  }

 private:
  void declare_instance(UnitBuilder& builder, const Instance& instance,
                        Use& use) override {
    const std::string_view kind = instance.kind->id;
    const Shape shape = shape_of(kind);
    const auto add = [&](std::string_view name, Type type = Type::Bit) {
      add_state(builder, instance, use, name, type);
      // The reader of sketches makes use of what is always 0.
      if (type == Type::Word) return;
      relation(
          builder, "!k",
          {{"k", builder.unit().variables[use.states.at(name)].name, true}});
    };
    if (shape == Shape::None) {
      return builder.fail(instance.where, "a sketch has nothing for `" +
                                              instance.name + "`, a " +
                                              std::string(kind));
    }
    if (shape == Shape::OffDelay && use.presets.size() > 1) {
      return builder.fail(instance.where,
                          "`" + instance.name +
                              "` has several presets: an off-delay of a sketch "
                              "has one");
    }
    if (is_timer(shape)) {
      use.block = builder.add_block("unsigned long", instance);
      if (shape == Shape::YunTimer) add("started");
      if (shape == Shape::OffDelay) add("out");
      return relate(builder, instance, use, shape);
    }
    const bool latch = shape == Shape::Edge || shape == Shape::Latch;
    if (!latch) add("value", Type::Word);
    if (shape == Shape::UpDownCounter) {
      add("last_up");
      add("last_down");
    } else {
      add("last");
    }
    if (shape == Shape::YunCounter || shape == Shape::SimCounter) {
      relate_counter(builder, instance, use);
    } else if (!latch) {
      relate_states(builder, instance, use);
    }
  }

  // --- what is equal in both, so that it need not be found again -------------

  using Name = StateRelation::Name;
  static void relation(UnitBuilder& builder, std::string formula,
                       std::vector<Name> names) {
    builder.unit().relations.push_back({std::move(formula), std::move(names)});
  }

  /// States of the source's counter have their names here.
  static void relate_states(UnitBuilder& builder, const Instance& instance,
                            const Use& use) {
    for (const auto& [state, cell] : use.states) {
      const bool word = builder.unit().variables[cell].type == Type::Word;
      relation(builder, word ? "a == b" : "a <-> b",
               {{"a", instance.name + "." + std::string(state)},
                {"b", builder.unit().variables[cell].name, true}});
      if (!word) continue;
      relation(builder, "b >= -32768 && b <= 32767",
               {{"b", builder.unit().variables[cell].name, true}});
    }
  }

  static void relate(UnitBuilder& builder, const Instance& instance,
                     const Use& use, Shape shape) {
    const std::string name = instance.name + ".";
    const Name started = {"s", name + "started", true};
    const Name clock = {"f", name + "elapsed", true};
    const Name elapsed = {"e", name + "elapsed"};
    const auto variable = [&](std::string_view state) {
      return Name{"k", builder.unit().variables[use.states.at(state)].name,
                  true};
    };
    if (shape == Shape::OffDelay) {
      return relate_off_delay(builder, instance, use);
    }
    const bool on = instance.kind->id == "ton";
    const Name source = {"n", name + (on ? "on" : "started")};
    relation(builder, "n <-> s", {source, started});
    relation(builder, "e == f", {elapsed, clock});
    if (shape != Shape::OwnTimer) {
      relation(builder, "n || e == 0", {source, elapsed});
    }
    if (shape == Shape::YunTimer) {
      relation(builder, "n <-> k", {source, variable("started")});
    }
  }

  static void relate_off_delay(UnitBuilder& builder, const Instance& instance,
                               const Use& use) {
    const std::string name = instance.name + ".";
    const Name started = {"s", name + "started", true};
    const Name clock = {"f", name + "elapsed", true};
    const Name elapsed = {"e", name + "elapsed"};
    const Name out = {"k", builder.unit().variables[use.states.at("out")].name,
                      true};
    relation(builder, "s || f == 0", {started, clock});
    if (instance.kind->id == "timer-off-sim") {
      const Name armed = {"a", name + "armed"};
      const Name own = {"o", name + "out"};
      relation(builder, "o <-> k", {own, out});
      relation(builder, "!o || a || s", {own, armed, started});
      relation(builder, "!s || !a", {started, armed});
      relation(builder, "!o || a || e == f", {own, armed, elapsed, clock});
      relation(builder, "o && !a || e == 0", {own, armed, elapsed});
      return;
    }
    const Name on = {"n", name + "on"};
    const Name fallen = {"x", name + "fallen"};
    const std::string preset =
        std::to_string(use.presets.empty() ? 0 : *use.presets.begin());
    relation(builder, "k <-> (n || x && e < " + preset + ")",
             {out, on, fallen, elapsed});
    relation(builder, "!n || !x", {on, fallen});
    relation(builder, "!n || e == 0", {on, elapsed});
    relation(builder, "!s || !n", {started, on});
    relation(builder, "!k || n || s", {out, on, started});
    relation(builder, "!k || n || e == f", {out, on, elapsed, clock});
  }

  // --- timers ----------------------------------------------------------------

  /// `function` is called with `input`; its result. A call takes what a list
  /// of bits gives without a stack, for a stack may not stand in an `if`.
  Terms run(UnitBuilder& builder, const ElementCall& call,
            std::string_view function, Terms input, std::int64_t milliseconds) {
    Use& use = use_of(call);
    if (milliseconds > kLongest) {
      builder.fail(call.where, "a delay of " + std::to_string(milliseconds) +
                                   " ms: up to 24 days are supported");
    }
    if (!is_bit_list(input, false)) {
      input = read_term(builder.kept_cell(std::move(input)), Type::Bit);
    }
    builder.call(use.block, {{pin_cell(builder, use, function), input}},
                 milliseconds);
    return pin(builder, use, "Q");
  }

  Terms timer(UnitBuilder& builder, const ElementCall& call, Shape shape,
              const Terms& argument) {
    const bool pulse = shape == Shape::Pulse;
    const bool none = call.parameter == 0;
    const Terms input = none ? builder.kept(argument) : argument;
    Terms done = run(builder, call, pulse ? "timerPulse" : "timerOn", input,
                     call.parameter);
    if (!none) return builder.result_of(call, std::move(done));
    // Without a time there is no pulse, and no delay: one dialect's timer is
    // done then whatever its input is.
    if (pulse) return constant_term(Type::Bit, 0);
    const bool sim =
        builder.program().instances[call.instance].kind->id == "timer-sim";
    return sim ? constant_term(Type::Bit, 1) : input;
  }

  /// The thesis's timers are over when more than their time has passed.
  Terms own_timer(UnitBuilder& builder, const ElementCall& call,
                  Terms argument) {
    const bool thesis =
        builder.program().instances[call.instance].kind->id == "timer-plclib";
    std::string_view function = call.operation->name;
    if (thesis) function = function == "timerDelay" ? "timerOn" : "timerOff";
    return builder.result_of(call,
                             run(builder, call, function, std::move(argument),
                                 call.parameter + (thesis ? 1 : 0)));
  }

  // --- counters of IEC 61131-3 -----------------------------------------------

  Terms read(UnitBuilder& builder, const ElementCall& call, const Use& use,
             Shape shape) {
    const std::string_view name = call.operation->name;
    const bool counter = shape == Shape::UpCounter ||
                         shape == Shape::DownCounter ||
                         shape == Shape::UpDownCounter;
    const Type type = call.operation->word ? Type::Word : Type::Bit;
    if (!counter) {
      builder.fail(call.where,
                   "a sketch has no `" + std::string(name) + "` of `" +
                       builder.program().instances[call.instance].name + "`");
      return constant_term(type, 0);
    }
    return builder.result_of(call, name.ends_with(".CV")
                                       ? state(use, "value", Type::Word)
                                       : value_and(NodeOp::LessEqual, use, 0));
  }

  static Terms kept_word(UnitBuilder& builder, Terms word) {
    const bool constant = word.size() == 1 && word[0].op == NodeOp::Constant;
    return constant ? word : builder.kept(std::move(word), Type::Word);
  }

  static Terms value_reaches(NodeOp op, const Use& use, const Terms& limit) {
    return joined(op, Type::Bit, state(use, "value", Type::Word), limit);
  }

  Terms counter_one_way(UnitBuilder& builder, const ElementCall& call,
                        Shape shape, const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    const bool up = shape == Shape::UpCounter;
    const CellId value = use.states.at("value");
    const Terms clock = builder.kept(arguments[0]);
    const Terms load = builder.kept(arguments[1]);  // R of CTU, LD of CTD
    const Terms preset = kept_word(builder, arguments[2]);
    const Terms moves = both(
        both(clock, negated(state(use, "last"))),
        both(negated(load), up ? value_and(NodeOp::Less, use, 32'767)
                               : value_and(NodeOp::Greater, use, -32'768)));
    builder.assign_when(
        moves, value,
        value_and(up ? NodeOp::Add : NodeOp::Subtract, use, 1, Type::Word));
    builder.assign_when(load, value,
                        up ? constant_term(Type::Word, 0) : preset);
    builder.assign(use.states.at("last"), clock);
    return builder.result_of(
        call, up ? value_reaches(NodeOp::GreaterEqual, use, preset)
                 : value_and(NodeOp::LessEqual, use, 0));
  }

  Terms counter_both_ways(UnitBuilder& builder, const ElementCall& call,
                          const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    const CellId value = use.states.at("value");
    const Terms up = builder.kept(arguments[0]);
    const Terms down = builder.kept(arguments[1]);
    const Terms reset = builder.kept(arguments[2]);
    const Terms load = builder.kept(arguments[3]);
    const Terms preset = kept_word(builder, arguments[4]);
    const Terms free = both(negated(reset), negated(load));
    const Terms rises = builder.kept(both(up, negated(state(use, "last_up"))));
    const Terms falls =
        builder.kept(both(down, negated(state(use, "last_down"))));
    // Two edges at once leave the value as it is.
    const Terms goes_up = builder.kept(both(both(rises, negated(falls)), free));
    const Terms goes_down =
        builder.kept(both(both(falls, negated(rises)), free));
    builder.assign_when(both(goes_up, value_and(NodeOp::Less, use, 32'767)),
                        value, value_and(NodeOp::Add, use, 1, Type::Word));
    builder.assign_when(
        both(goes_down, value_and(NodeOp::Greater, use, -32'768)), value,
        value_and(NodeOp::Subtract, use, 1, Type::Word));
    builder.assign_when(both(load, negated(reset)), value, preset);
    builder.assign_when(reset, value, constant_term(Type::Word, 0));
    builder.assign(use.states.at("last_up"), up);
    builder.assign(use.states.at("last_down"), down);
    return builder.result_of(call,
                             value_reaches(NodeOp::GreaterEqual, use, preset));
  }
};

}  // namespace

std::unique_ptr<Elements> plclib_elements() {
  return std::make_unique<PlclibElements>();
}

}  // namespace rung::backend
