#include "reports/ladder/power.h"

namespace rung {

RungState state_of(const Program& program, const Rung& rung,
                   const Simulator& simulator) {
  RungState state;
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    // A marker of short-circuit evaluation has no value.
    const bool has_value = program.nodes[i].op != NodeOp::Branch;
    const bool executed = has_value && simulator.node_executed(i);
    state.nodes.push_back(
        {executed, executed ? simulator.node_value(i) : std::int64_t{0}});
  }
  state.target = simulator.value(rung.target);
  return state;
}

std::optional<std::int64_t> shown_value(const LadderShape& shape,
                                        const RungState& state) {
  if (shape.node == LadderShape::kNoNode) return state.target;
  const RungState::Value& value = state.nodes[shape.node];
  if (!value.executed) return std::nullopt;
  const bool inverted = shape.kind == LadderShape::Kind::Negated;
  return inverted ? 1 - value.value : value.value;
}

std::vector<bool> powered_nets(const LadderRung& rung, const RungState& state) {
  std::vector<bool> powered(static_cast<std::size_t>(rung.nets), false);
  const auto net = [](int index) { return static_cast<std::size_t>(index); };
  powered[LadderRung::kLeftRail] = true;
  for (const LadderShape& shape : rung.shapes) {
    if (shape.node == LadderShape::kNoNode) continue;
    const RungState::Value& value = state.nodes[shape.node];
    const bool conducts = value.executed && value.value != 0;
    const bool fed = shape.behind_input || powered[net(shape.from)];
    if (conducts && fed) powered[net(shape.to)] = true;
  }
  return powered;
}

}  // namespace rung
