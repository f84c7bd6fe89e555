#include "backend/unit/elements_common.h"

#include <algorithm>
#include <utility>

namespace rung::backend {

void MappedElements::declare(UnitBuilder& builder) {
  const Program& program = builder.program();
  uses_.resize(program.instances.size());
  for (const ElementCall& call : program.calls) {
    Use& use = uses_[call.instance.index()];
    use.operations.insert(call.operation->name);
    ++use.calls;
    if (!call.operation->steps()) continue;
    ++use.steps;
    use.presets.insert(call.parameter);
  }
  for (const InstanceId id : ids_of(program.instances)) {
    declare_instance(builder, program.instances[id], uses_[id.index()]);
  }
}

CellId MappedElements::pin_cell(UnitBuilder& builder, Use& use,
                                std::string_view name, Type type) {
  const auto [at, added] = use.pins.emplace(name, CellId());
  if (added) at->second = builder.add_pin(use.block, name, type);
  return at->second;
}

Terms MappedElements::latch_as_bit(UnitBuilder& builder, Use& use,
                                   bool set_dominates,
                                   const std::vector<Terms>& arguments) {
  const Terms& set = arguments[0];
  const Terms kept = negated(arguments[1]);
  Terms last = state(use, "last");
  builder.assign(use.states.at("last"), set_dominates
                                            ? either(set, both(kept, last))
                                            : both(either(set, last), kept));
  return last;
}

Terms MappedElements::edge_as_bit(UnitBuilder& builder, const ElementCall& call,
                                  Use& use, const Terms& argument) {
  const Terms input = builder.kept(argument);
  const Terms last = state(use, "last");
  const std::string_view name = call.operation->name;
  // F_TRIG remembers that its input was false.
  const bool inverse = name == "F_TRIG";
  const bool rises = name == "RISE" || name == "R_TRIG";
  const Terms level = rises ? input : negated(input);
  const Terms before = name == "FALL" ? last : negated(last);
  const CellId result = builder.kept_cell(both(level, before));
  builder.assign(use.states.at("last"), inverse ? negated(input) : input);
  return read_term(result, Type::Bit);
}

/// Runs on until TR resets it, so a bit holds its input; it is done when more
/// than its time has passed.
Terms MappedElements::timer_yun(UnitBuilder& builder, const ElementCall& call,
                                Use& use, const Terms& argument,
                                const RunOnDelay& run) {
  Terms input = builder.kept(argument);
  const Terms started = state(use, "started");
  const bool resets = call.operation->resets;
  builder.assign(use.states.at("started"), resets
                                               ? both(started, negated(input))
                                               : either(started, input));
  const std::int64_t preset =
      resets ? builder.program().instances[call.instance].largest_parameter
             : call.parameter;
  const Terms done = run(started, preset + 1);
  if (resets) return input;
  return builder.result_of(call, both(input, done));
}

Terms MappedElements::off_delay(UnitBuilder& builder, const ElementCall& call,
                                Use& use, const Terms& argument,
                                const RunOnDelay& run) {
  if (call.parameter == 0) return argument;
  const Terms input = builder.kept(argument);
  const Terms out = state(use, "out");
  const Terms over = run(both(negated(input), out), call.parameter);
  builder.assign(use.states.at("out"), either(input, both(out, negated(over))));
  return builder.result_of(call, out);
}

// --- counters as words -------------------------------------------------------

std::int64_t MappedElements::preset_word(UnitBuilder& builder,
                                         const ElementCall& call,
                                         std::int64_t factor) const {
  const std::int64_t most = (largest_word_ - 1) / factor;
  if (call.parameter > most) {
    builder.fail(call.where,
                 "the count " + std::to_string(call.parameter) +
                     " is too large for a word, which holds up to " +
                     std::to_string(largest_word_) +
                     (factor == 1 ? ""
                                  : ": this counter goes up to " +
                                        std::to_string(factor) + " times it"));
  }
  return std::min(call.parameter, most);
}

Terms MappedElements::counter_yun(UnitBuilder& builder, const ElementCall& call,
                                  Use& use, const Terms& argument) const {
  Terms input = builder.kept(argument);
  const CellId value = use.states.at("value");
  if (call.operation->resets) {
    builder.assign_when(input, value, constant_term(Type::Word, 0));
    return input;
  }
  const std::int64_t preset = preset_word(builder, call, 1);
  const Terms edge = both(input, negated(state(use, "last")));
  builder.assign_when(both(edge, value_and(NodeOp::Less, use, preset)), value,
                      value_and(NodeOp::Add, use, 1, Type::Word));
  builder.assign(use.states.at("last"), input);
  return builder.result_of(call, value_and(NodeOp::GreaterEqual, use, preset));
}

Terms MappedElements::counter_sim(UnitBuilder& builder, const ElementCall& call,
                                  Use& use,
                                  const std::vector<Terms>& arguments) const {
  if (!is_false(arguments[1])) {
    builder.fail(call.where,
                 "this counter counts down without a bound: no word holds "
                 "that");
  }
  const std::int64_t last = preset_word(builder, call, 50) * 50;
  const Terms up = builder.kept(arguments[0]);
  const bool resets = !is_false(arguments[2]);
  const Terms reset = resets ? builder.kept(arguments[2]) : arguments[2];
  Terms counts = both(up, negated(state(use, "last")));
  Terms next = up;
  Terms done = value_and(NodeOp::Equal, use, call.parameter);
  if (resets) {
    counts = both(std::move(counts), negated(reset));
    next = both(std::move(next), negated(reset));
    done = both(std::move(done), negated(reset));
  }
  const CellId value = use.states.at("value");
  builder.assign_when(counts, value,
                      value_and(NodeOp::Add, use, 1, Type::Word));
  if (resets) {
    builder.assign_when(reset, value, constant_term(Type::Word, 0));
  }
  builder.assign(use.states.at("last"), std::move(next));
  Terms result = builder.kept(std::move(done));
  // It never stands far above its count.
  builder.assign_when(value_and(NodeOp::Greater, use, last), value,
                      constant_term(Type::Word, call.parameter + 1));
  return result;
}

void MappedElements::relate_counter(UnitBuilder& builder,
                                    const Instance& instance, const Use& use) {
  const auto add = [&](std::string formula,
                       std::vector<StateRelation::Name> names) {
    builder.unit().relations.push_back({std::move(formula), std::move(names)});
  };
  const auto of = [&](std::string_view state) {
    return builder.unit().variables[use.states.at(state)].name;
  };
  const std::string name = instance.name + ".";
  const bool sim = instance.kind->id == "counter-sim";
  add("v == w", {{"v", name + "value"}, {"w", of("value"), true}});
  const std::int64_t largest = use.presets.empty() ? 0 : *use.presets.rbegin();
  const std::int64_t most = sim ? std::max(50 * largest, largest + 1) : largest;
  add("w >= 0 && w <= " + std::to_string(most), {{"w", of("value"), true}});
  add("l <-> m",
      {{"l", name + (sim ? "last_up" : "last")}, {"m", of("last"), true}});
}

void relate_timer(UnitBuilder& builder, const std::string& instance,
                  bool off_delay, bool sim_is_source, std::int64_t preset,
                  const std::string& kept_out) {
  const auto sim = [&](std::string short_name, const char* state) {
    return StateRelation::Name{std::move(short_name), instance + "." + state,
                               !sim_is_source};
  };
  const auto iec = [&](std::string short_name, const char* state) {
    return StateRelation::Name{std::move(short_name), instance + "." + state,
                               sim_is_source};
  };
  const auto add = [&](std::string formula,
                       std::vector<StateRelation::Name> names) {
    builder.unit().relations.push_back({std::move(formula), std::move(names)});
  };
  const auto elapsed = sim("e", "elapsed");
  const auto clock = iec("f", "elapsed");
  const auto on = iec("n", "on");
  if (!off_delay) {
    const auto started = sim("s", "started");
    add("s <-> n", {started, on});
    add("e == f", {elapsed, clock});
    add("s || e == 0", {started, elapsed});
    return;
  }
  const auto armed = sim("a", "armed");
  const auto out = sim("o", "out");
  const auto fallen = iec("x", "fallen");
  add("a <-> n", {armed, on});
  add("!n || o", {on, out});
  add("!o || n || x", {out, on, fallen});
  add("!o || e == f", {out, elapsed, clock});
  add("!n || f == 0", {on, clock});
  add("!n || !x", {on, fallen});
  add("o && !a || e == 0", {out, armed, elapsed});
  if (kept_out.empty()) {
    add("o || !x || f >= " + std::to_string(preset), {out, fallen, clock});
  } else {
    add("o <-> k", {out, {"k", kept_out, true}});
  }
}

Terms both(Terms left, const Terms& right) {
  return joined(NodeOp::And, Type::Bit, std::move(left), right);
}

Terms either(Terms left, const Terms& right) {
  return joined(NodeOp::Or, Type::Bit, std::move(left), right);
}

bool is_false(const Terms& terms) {
  return terms.size() == 1 && terms[0].op == NodeOp::Constant &&
         terms[0].value == 0;
}

}  // namespace rung::backend
