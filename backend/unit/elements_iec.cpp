#include "backend/unit/elements_iec.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "backend/unit/block_pins.h"
#include "backend/unit/elements_common.h"
#include "backend/unit/matiec.h"

namespace rung::backend {
namespace {

using enum NodeOp;

constexpr std::int64_t kLongest = std::numeric_limits<std::int32_t>::max();

class IecElements : public MappedElements {
 public:
  explicit IecElements(std::string_view dialect)
      : dialect_(dialect), matiec_(dialect == "matiec") {}

  void declare(UnitBuilder& builder) override {
    MappedElements::declare(builder);
    bind_pins(builder);
  }

  Terms call(UnitBuilder& builder, const ElementCall& call,
             std::vector<Terms> arguments) override {
    const std::string_view kind =
        builder.program().instances[call.instance].kind->id;
    if (kind == "timer-yun") return timer_yun(builder, call, arguments);
    if (kind == "timer-sim") return timer_sim(builder, call, arguments);
    if (kind == "timer-off-sim") return timer_off(builder, call, arguments);
    if (kind == "counter-yun") return counter_yun(builder, call, arguments);
    if (kind == "counter-sim") {
      return counter_sim(builder, call, use_of(call), arguments);
    }
    if (kind == "edge") return edge(builder, call, arguments);
    return own_block(builder, call, std::move(arguments));
  }

 private:
  // --- declarations ----------------------------------------------------------

  void declare_instance(UnitBuilder& builder, const Instance& instance,
                        Use& use) override {
    const std::string_view kind = instance.kind->id;
    const auto add_state = [&](std::string_view name, Type type) {
      MappedElements::add_state(builder, instance, use, name, type);
    };
    const bool timer = instance.kind->family == ElementFamily::Timer;
    const bool foreign = !instance.kind->is_in(dialect_);
    if (timer && foreign && use.presets.size() > 1 &&
        is_block(*instance.kind)) {
      builder.fail(instance.where,
                   "`" + instance.name +
                       "` has several presets: what one of them has started "
                       "is over for all of them here");
    }
    // Without a delay there is no block (see timer_sim(), off_delay()).
    const bool sim = kind == "timer-sim" || kind == "timer-off-sim";
    if (matiec_ && sim && use.presets == std::set<std::int64_t>{0}) return;
    if (kind == "timer-yun") {
      use.block = builder.add_block("TON", instance);
      add_state("started", Type::Bit);
    } else if (kind == "timer-sim") {
      use.block = builder.add_block("TON", instance);
    } else if (kind == "timer-off-sim") {
      use.block = builder.add_block("TOF", instance);
      // One output for all presets, which the block alone has not.
      if (use.presets.size() > 1) add_state("out", Type::Bit);
    } else if (kind == "counter-yun" && use.presets.size() <= 1) {
      use.block = builder.add_block("CTU", instance);
    } else if (kind == "counter-yun" || kind == "counter-sim") {
      add_state("value", Type::Word);
      add_state("last", Type::Bit);
    } else if (kind == "edge" && !use.operations.contains("FALL")) {
      use.block = builder.add_block("R_TRIG", instance);
    } else if (kind == "edge") {
      add_state("last", Type::Bit);
    } else if (!foreign ||
               (is_block(*instance.kind) && instance.kind->letter != "CTUD")) {
      use.block = builder.add_block(instance.kind->letter, instance);
    } else {
      builder.fail(instance.where, "there is no standard function block for `" +
                                       instance.name + "`, a " +
                                       std::string(kind));
    }
    relate(builder, instance, use);
  }

  /// What is equal in both, so that it need not be found again.
  void relate(UnitBuilder& builder, const Instance& instance,
              const Use& use) const {
    const std::string name = instance.name + ".";
    const auto add = [&](std::string formula,
                         std::vector<StateRelation::Name> names) {
      builder.unit().relations.push_back(
          {std::move(formula), std::move(names)});
    };
    const auto of = [&](std::string_view state) {
      return builder.unit().variables[use.states.at(state)].name;
    };
    const std::int64_t largest =
        use.presets.empty() ? 0 : *use.presets.rbegin();
    const std::string preset = std::to_string(largest);
    const std::string_view kind = instance.kind->id;
    if (kind == "timer-yun" || kind == "timer-sim") {
      if (matiec_) {
        relate_matiec_timer(builder, instance.name, "timer-sim", false,
                            kind == "timer-yun" ? largest + 1 : largest);
      } else {
        relate_timer(builder, instance.name, false, true, 0);
      }
      if (kind == "timer-sim") return;
      add("s <-> t", {{"s", name + "started"}, {"t", of("started"), true}});
    } else if (kind == "timer-off-sim" && matiec_ && !use.states.empty()) {
      relate_matiec_off_delays(builder, instance.name, of("out"));
    } else if (kind == "timer-off-sim" && matiec_) {
      relate_matiec_timer(builder, instance.name, kind, false, largest);
    } else if (kind == "timer-off-sim") {
      relate_timer(builder, instance.name, true, true,
                   use.presets.empty() ? 0 : *use.presets.rbegin(),
                   use.states.empty() ? "" : of("out"));
    } else if (kind == "counter-yun" && use.block.has_value()) {
      add("w < " + preset + " ? v == w : v == " + preset,
          {{"v", name + "value"}, {"w", name + "value", true}});
      add("l <-> m", {{"l", name + "last"}, {"m", name + "last", true}});
      add("l <-> m",
          {{"l", name + "last"},
           {"m", builder.unit().blocks[use.block].name + ".CU", true}});
    } else if (kind == "counter-yun" || kind == "counter-sim") {
      relate_counter(builder, instance, use);
    } else if (instance.kind->family == ElementFamily::Timer &&
               !instance.kind->is_in(dialect_)) {
      const std::string_view other = instance.kind->letter == "TON"   ? "ton"
                                     : instance.kind->letter == "TOF" ? "tof"
                                                                      : "tp";
      relate_matiec_timer(builder, instance.name, other, !matiec_, largest);
    }
  }

  /// Cells of the source that are pins of its blocks, as readers of IEC
  /// languages make them, are pins here too.
  void bind_pins(UnitBuilder& builder) {
    for (const BlockPin& one : find_block_pins(builder.program())) {
      if (!use_of(one.instance).block.has_value()) continue;  // refused
      const CellId pin =
          pin_cell(builder, use_of(one.instance), one.name, one.type);
      builder.bind(one.cell, pin);
      if (one.constant) constants_.emplace(pin, *one.constant);
    }
  }

  // --- blocks of the standard ------------------------------------------------

  Terms own_block(UnitBuilder& builder, const ElementCall& call,
                  std::vector<Terms> arguments) {
    Use& use = use_of(call);
    const ElementOperation& operation = *call.operation;
    const Type type = operation.word ? Type::Word : Type::Bit;
    if (!use.block.has_value()) return constant_term(type, 0);  // refused
    const Instance& instance = builder.program().instances[call.instance];
    if (!instance.kind->is_in(dialect_) || matiec_) {
      check_foreign(builder, call, instance, arguments);
    }
    if (operation.reads) {
      const std::string_view name =
          operation.name.substr(operation.name.find('.') + 1);
      return builder.result_of(call, pin(builder, use, name, type));
    }
    std::vector<Argument> given;
    bool timed = false;
    std::size_t next = 0;
    for (const ElementParameter& parameter : operation.parameters) {
      timed = timed || parameter.kind == ParameterKind::Seconds;
      const bool word = parameter.kind == ParameterKind::Word;
      if (!word && parameter.kind != ParameterKind::Bit) continue;
      const CellId cell =
          pin_cell(builder, use, parameter.name, word ? Type::Word : Type::Bit);
      Terms& value = arguments[next++];
      const bool kept =
          value.size() == 1 && value[0].op == Read && value[0].cell == cell;
      if (!kept) given.push_back({cell, std::move(value)});
    }
    if (timed && call.parameter == 0 && !instance.kind->is_in(dialect_)) {
      return without_delay(builder, call, use, std::move(given));
    }
    std::optional<std::int64_t> preset;
    if (timed) preset = preset_of(builder, call, call.parameter);
    builder.call(use.block, std::move(given), preset);
    return builder.result_of(
        call, pin(builder, use, output_of(operation.name), type));
  }

  /// Where a block is not the same in both libraries.
  void check_foreign(UnitBuilder& builder, const ElementCall& call,
                     const Instance& instance,
                     const std::vector<Terms>& arguments) {
    const std::string_view name = call.operation->name;
    const auto fail = [&](const std::string& why) {
      builder.fail(call.where, "`" + instance.name + "`: " + why);
    };
    const bool timer = instance.kind->family == ElementFamily::Timer;
    if (timer && call.operation->reads) {
      return fail("its elapsed time is a TIME, and no number here");
    }
    if (instance.kind->is_in(dialect_)) return;
    if (timer && call.parameter == 0 && !matiec_) {
      return fail("with a preset of 0 it still needs one scan more");
    }
    if (instance.kind->family != ElementFamily::Counter) return;
    if (call.operation->reads) {
      return fail("one of the two counters stops at its limit, so their " +
                  std::string(name) + " differ");
    }
    if (name == "CTD") {
      return relate_matiec_counter(builder, instance.name, true, !matiec_, 0);
    }
    const Term& value = arguments.back().back();
    const auto pin = constants_.find(value.cell);
    const bool known = value.op == Read && pin != constants_.end();
    const std::int64_t limit = known ? pin->second : value.value;
    const auto other = limits_.emplace(call.instance, limit).first;
    if (!(known || value.op == Constant) || other->second != limit) {
      return fail(
          "its PV is not constant, and one of the two counters stops "
          "at it");
    }
    relate_matiec_counter(builder, instance.name, false, !matiec_, limit);
  }

  /// The standard's timers do not wait for a preset of 0, and matiec's do.
  Terms without_delay(UnitBuilder& builder, const ElementCall& call, Use& use,
                      std::vector<Argument> given) {
    for (Argument& argument : given) {
      builder.assign(argument.pin, std::move(argument.value));
    }
    const CellId out = pin_cell(builder, use, "Q");
    const bool pulse = call.operation->name == "TP";
    builder.assign(
        out, pulse ? constant_term(Type::Bit, 0) : pin(builder, use, "IN"));
    return builder.result_of(call, read_term(out, Type::Bit));
  }

  static std::int64_t preset_of(UnitBuilder& builder, const ElementCall& call,
                                std::int64_t milliseconds) {
    if (milliseconds > kLongest) {
      builder.fail(call.where, "the preset " + std::to_string(milliseconds) +
                                   " ms does not fit a TIME: 24 days");
    }
    return milliseconds;
  }

  // --- elements of scripts ---------------------------------------------------

  Terms timer_yun(UnitBuilder& builder, const ElementCall& call,
                  const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    return MappedElements::timer_yun(
        builder, call, use, arguments[0],
        [&](Terms input, std::int64_t milliseconds) {
          const bool resets = call.operation->resets;
          const std::int64_t given =
              resets ? milliseconds : given_preset(call, use) + 1;
          builder.call(use.block,
                       {{pin_cell(builder, use, "IN"), std::move(input)}},
                       preset_of(builder, call, given));
          return resets ? Terms() : has_run(builder, use, milliseconds);
        });
  }

  /// Has the timer run for this long? What matiec's blocks have come to is not
  /// undone by a larger preset: with several, they get the largest, and their
  /// clock is looked at.
  static bool looks_at_clock(const Use& use) { return use.presets.size() > 1; }
  Terms has_run(UnitBuilder& builder, Use& use, std::int64_t milliseconds) {
    if (!matiec_ || !looks_at_clock(use)) return pin(builder, use, "Q");
    return joined(GreaterEqual, Type::Bit, pin(builder, use, "ET", Type::Word),
                  constant_term(Type::Word, milliseconds));
  }
  Terms still_on(UnitBuilder& builder, Use& use, std::int64_t milliseconds) {
    if (!matiec_) return pin(builder, use, "Q");
    return negated(has_run(builder, use, milliseconds));
  }
  /// The preset that a call of a timer is given.
  std::int64_t given_preset(const ElementCall& call, Use& use) const {
    const bool largest = matiec_ && looks_at_clock(use);
    return largest ? *use.presets.rbegin() : call.parameter;
  }

  Terms timer_sim(UnitBuilder& builder, const ElementCall& call,
                  const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    if (!use.block.has_value()) return constant_term(Type::Bit, 1);
    builder.call(use.block, {{pin_cell(builder, use, "IN"), arguments[0]}},
                 preset_of(builder, call, given_preset(call, use)));
    // Without a preset it is done whatever its input is.
    if (call.parameter == 0) return constant_term(Type::Bit, 1);
    return builder.result_of(call, has_run(builder, use, call.parameter));
  }

  Terms timer_off(UnitBuilder& builder, const ElementCall& call,
                  const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    if (!use.block.has_value()) return arguments[0];
    const bool one = use.states.empty();
    const Terms input = one ? arguments[0] : builder.kept(arguments[0]);
    builder.call(use.block, {{pin_cell(builder, use, "IN"), input}},
                 preset_of(builder, call, given_preset(call, use)));
    if (one) return builder.result_of(call, pin(builder, use, "Q"));
    builder.assign(use.states.at("out"),
                   joined(Or, Type::Bit, input,
                          both(state(use, "out"),
                               still_on(builder, use, call.parameter))));
    return builder.result_of(call, state(use, "out"));
  }

  Terms counter_yun(UnitBuilder& builder, const ElementCall& call,
                    const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    if (!use.block.has_value()) {
      return MappedElements::counter_yun(builder, call, use, arguments[0]);
    }
    const CellId reset = pin_cell(builder, use, "R");
    if (call.operation->resets) {
      // Without CU: the edge memory stays as it is.
      Terms input = builder.kept(arguments[0]);
      builder.call(use.block, {{reset, input}}, {});
      return input;
    }
    builder.call(use.block,
                 {{pin_cell(builder, use, "CU"), arguments[0]},
                  {reset, constant_term(Type::Bit, 0)},
                  {pin_cell(builder, use, "PV", Type::Word),
                   constant_term(Type::Word, preset_word(builder, call, 1))}},
                 {});
    return builder.result_of(call, pin(builder, use, "Q"));
  }

  Terms edge(UnitBuilder& builder, const ElementCall& call,
             const std::vector<Terms>& arguments) {
    Use& use = use_of(call);
    if (use.block.has_value()) {
      builder.call(use.block, {{pin_cell(builder, use, "CLK"), arguments[0]}},
                   {});
      return builder.result_of(call, pin(builder, use, "Q"));
    }
    Terms input = builder.kept(arguments[0]);
    const Terms last = state(use, "last");
    const bool rising = call.operation->name == "RISE";
    const CellId result_cell = builder.kept_cell(
        rising ? both(input, negated(last)) : both(last, negated(input)));
    builder.assign(use.states.at("last"), input);
    return read_term(result_cell, Type::Bit);
  }

  std::string_view dialect_;
  bool matiec_;
  std::map<CellId, std::int64_t> constants_;   // pins that never change
  std::map<InstanceId, std::int64_t> limits_;  // of counters in other libraries
};

}  // namespace

std::unique_ptr<Elements> iec_elements(std::string_view dialect) {
  return std::make_unique<IecElements>(dialect);
}

}  // namespace rung::backend
