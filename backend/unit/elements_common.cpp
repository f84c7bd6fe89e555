#include "backend/unit/elements_common.h"

#include <utility>

namespace rung::backend {

void MappedElements::declare(UnitBuilder& builder) {
  const Program& program = builder.program();
  uses_.resize(program.instances.size());
  for (const ElementCall& call : program.calls) {
    Use& use = uses_[call.instance.index()];
    use.operations.insert(call.operation->name);
    ++use.calls;
    if (call.operation->steps()) use.presets.insert(call.parameter);
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
