#include "backend/unit/elements_ladder.h"

#include <utility>

#include "backend/unit/elements_common.h"

namespace rung::backend {
namespace {

using Name = StateRelation::Name;

class LadderElements : public MappedElements {
 public:
  LadderElements(LadderBlocks blocks, std::string_view language)
      : blocks_(std::move(blocks)), language_(language) {}

  Terms call(UnitBuilder& builder, const ElementCall& call,
             std::vector<Terms> arguments) override {
    const std::string_view kind =
        builder.program().instances[call.instance].kind->id;
    Use& use = use_of(call);
    const bool refused =
        (is_timer(kind) || is_counted(kind, use)) && !use.block.has_value();
    if (call.operation->reads || !knows(kind) || refused) {
      if (call.operation->reads) {
        builder.fail(call.where, std::string(language_) + " have no `" +
                                     std::string(call.operation->name) + "`");
      }
      return constant_term(Type::Bit, 0);
    }
    if (kind == "sr" || kind == "rs") {
      return builder.result_of(
          call, latch_as_bit(builder, use, kind == "sr", arguments));
    }
    if (is_counted(kind, use)) return count(builder, call, use, arguments[0]);
    if (kind == "counter-yun") {
      return counter_yun(builder, call, use, arguments[0]);
    }
    if (kind == "counter-sim") {
      return counter_sim(builder, call, use, arguments);
    }
    if (kind == "timer-yun" && blocks_.resets && call.operation->resets) {
      return reset(builder, call, use, arguments[0]);
    }
    const auto on_delay = [&](Terms input, std::int64_t milliseconds) {
      return run(builder, call, std::move(input), milliseconds);
    };
    if (kind == "timer-yun") {
      return timer_yun(builder, call, use, arguments[0], on_delay);
    }
    if (kind == "timer-sim" || kind == "ton" || kind == "tp") {
      return timer(builder, call, kind, arguments[0]);
    }
    if (kind == "timer-off-sim" || kind == "tof") {
      return blocks_.off_delay
                 ? timer(builder, call, kind, arguments[0])
                 : off_delay(builder, call, use, arguments[0], on_delay);
    }
    return edge_as_bit(builder, call, use, arguments[0]);
  }

 private:
  static bool is_timer(std::string_view kind) {
    return kind == "timer-sim" || kind == "timer-off-sim" ||
           kind == "timer-yun" || kind == "ton" || kind == "tof" ||
           kind == "tp";
  }
  static bool is_counter(std::string_view kind) {
    return kind == "counter-yun" || kind == "counter-sim";
  }
  /// Is it a counter of the language?
  static bool is_counted(std::string_view kind, const Use& use) {
    return kind == "counter-yun" && use.steps == 1;
  }
  bool knows(std::string_view kind) const {
    if (kind == "tp") return blocks_.pulse;
    if (is_counter(kind)) return blocks_.counters;
    return is_timer(kind) || kind == "edge" || kind == "r-trig" ||
           kind == "f-trig" || kind == "sr" || kind == "rs";
  }

  void declare_instance(UnitBuilder& builder, const Instance& instance,
                        Use& use) override {
    const std::string_view kind = instance.kind->id;
    if (!knows(kind)) {
      return builder.fail(instance.where,
                          std::string(language_) + " have nothing for `" +
                              instance.name + "`, a " + std::string(kind));
    }
    if (is_counted(kind, use)) {
      use.block = builder.add_block("CTU", instance);
      return relate_count(builder, instance, use);
    }
    if (is_counter(kind)) {
      add_state(builder, instance, use, "value", Type::Word);
      add_state(builder, instance, use, "last");
      return relate_counter(builder, instance, use);
    }
    if (!is_timer(kind)) return add_state(builder, instance, use, "last");
    if (use.presets.size() > 1) {
      return builder.fail(instance.where,
                          "`" + instance.name +
                              "` has several presets: that of a timer of " +
                              std::string(language_) + " is fixed");
    }
    if (blocks_.one_call && (blocks_.resets ? use.steps : use.calls) > 1) {
      return builder.fail(instance.where,
                          "`" + instance.name +
                              "` is executed in several places: a timer of " +
                              std::string(language_) + " stands in one");
    }
    const bool off = kind == "timer-off-sim" || kind == "tof";
    std::string_view type = off && blocks_.off_delay ? "TOF" : "TON";
    if (kind == "tp") type = "TP";
    if (kind == "timer-yun") add_state(builder, instance, use, "started");
    if (off && !blocks_.off_delay) add_state(builder, instance, use, "out");
    use.block = builder.add_block(type, instance);
    relate(builder, instance, use, off);
  }

  void relate(UnitBuilder& builder, const Instance& instance, const Use& use,
              bool off) const {
    const std::string_view kind = instance.kind->id;
    const bool sim = kind == "timer-sim" || kind == "timer-off-sim";
    const std::string name = instance.name + ".";
    const auto add = [&](std::string formula, std::vector<Name> names) {
      builder.unit().relations.push_back(
          {std::move(formula), std::move(names)});
    };
    const auto variable = [&](std::string_view state) {
      return builder.unit().variables[use.states.at(state)].name;
    };
    const Name on = {"n", name + "on", true};
    const Name clock = {"f", name + "elapsed", true};
    const Name elapsed = {"e", name + "elapsed"};
    add("!h", {{"h", name + "held", true}});
    add("n || f == 0", {on, clock});
    if (off && sim && blocks_.off_delay) {
      relate_timer(builder, instance.name, true, true,
                   use.presets.empty() ? 0 : *use.presets.begin());
    } else if (off && sim) {
      const Name out = {"o", name + "out"};
      const Name armed = {"a", name + "armed"};
      add("o <-> k", {out, {"k", variable("out"), true}});
      add("!o || a || n", {out, armed, on});
      add("!n || !a", {on, armed});
      add("!o || a || e == f", {out, armed, elapsed, clock});
    } else if (!off) {
      const Name started = {"s", name + (kind == "ton" ? "on" : "started")};
      add("s <-> n", {started, on});
      add("e == f", {elapsed, clock});
      add("s || e == 0", {started, elapsed});
      if (kind == "timer-yun") {
        add("s <-> k", {started, {"k", variable("started"), true}});
      }
    }
  }

  void refuse_condition(UnitBuilder& builder, const ElementCall& call) const {
    if (!builder.is_conditional()) return;
    builder.fail(call.where,
                 "a timer or counter that is not executed in every scan: " +
                     std::string(language_) + " have no condition for that");
  }

  /// The clock runs while `input` is true; its output.
  Terms run(UnitBuilder& builder, const ElementCall& call, Terms input,
            std::int64_t milliseconds) {
    Use& use = use_of(call);
    const std::string why = blocks_.refuse(milliseconds);
    if (!why.empty()) builder.fail(call.where, why);
    refuse_condition(builder, call);
    if (blocks_.plain_input) input = builder.kept(std::move(input));
    builder.call(use.block, {{pin_cell(builder, use, "IN"), std::move(input)}},
                 milliseconds);
    return pin(builder, use, "Q");
  }

  Terms timer(UnitBuilder& builder, const ElementCall& call,
              std::string_view kind, const Terms& input) {
    // Without a delay the output is the input, but for one dialect.
    if (call.parameter == 0 && kind == "timer-sim") {
      return constant_term(Type::Bit, 1);
    }
    if (call.parameter == 0) {
      return kind == "tp" ? constant_term(Type::Bit, 0) : input;
    }
    return builder.result_of(call, run(builder, call, input, call.parameter));
  }

  /// A counter of the language is a number, with its name.
  static void relate_count(UnitBuilder& builder, const Instance& instance,
                           const Use& use) {
    builder.unit().relations.push_back(
        {"v == w",
         {{"v", instance.name + ".value"},
          {"w", builder.unit().blocks[use.block].name, true}}});
  }

  Terms count(UnitBuilder& builder, const ElementCall& call, Use& use,
              const Terms& argument) {
    if (call.operation->resets) return reset(builder, call, use, argument);
    refuse_condition(builder, call);
    builder.call(use.block, {{pin_cell(builder, use, "IN"), argument}},
                 preset_word(builder, call, 1));
    return builder.result_of(call, pin(builder, use, "Q"));
  }

  /// RES, and a timer of the yun dialect does not run any more.
  Terms reset(UnitBuilder& builder, const ElementCall& call, Use& use,
              const Terms& argument) {
    refuse_condition(builder, call);
    Terms input = builder.kept(argument);
    const auto started = use.states.find("started");
    if (started != use.states.end()) {
      builder.assign(started->second,
                     both(state(use, "started"), negated(input)));
    }
    builder.call(use.block, {{pin_cell(builder, use, "RES"), input}}, {});
    return input;
  }

  LadderBlocks blocks_;
  std::string_view language_;
};

}  // namespace

std::unique_ptr<Elements> ladder_elements(LadderBlocks blocks,
                                          std::string_view language) {
  return std::make_unique<LadderElements>(std::move(blocks), language);
}

}  // namespace rung::backend
