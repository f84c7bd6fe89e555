#include "check/claims.h"

#include <algorithm>
#include <unordered_map>

#include "check/encode_formula.h"

namespace rung::check {
namespace {

std::unordered_map<std::string, CellId> cells_by_name(const Program& program) {
  std::unordered_map<std::string, CellId> cells;
  for (const CellId id : ids_of(program.cells)) {
    cells.emplace(program.cells[id].name, id);
  }
  return cells;
}

/// Where the certificate of a comparison cuts clocks: above the presets of
/// their own program, and at the same number for presets that are nearly the
/// same.
std::vector<std::int64_t> clock_caps(const Program& program) {
  constexpr std::int64_t kSlack = 7;
  std::vector<std::int64_t> caps(program.instances.size(), 1);
  for (const ElementCall& call : program.calls) {
    std::int64_t& cap = caps[call.instance.index()];
    cap = std::max(cap, call.parameter + 1);
  }
  for (std::int64_t& cap : caps) {
    std::int64_t rounded = kSlack;
    while (rounded < cap + kSlack) rounded = 2 * rounded + 1;
    cap = rounded;
  }
  return caps;
}

/// Two programs in lock-step as one model: `a.x` and `b.x`.
class SideBySide {
 public:
  SideBySide(const Compared& a, const Compared& b,
             const std::vector<std::pair<std::string, std::string>>& map)
      : a_(a),
        b_(b),
        cells_a_(cells_by_name(a.program)),
        cells_b_(cells_by_name(b.program)) {
    for (const auto& [first, second] : map) partner_[first] = second;
    claims_.model = std::make_unique<Model>();
  }

  Claims claim(const ClaimedResult& claimed) {
    if (a_.program.scan.min_ms != b_.program.scan.min_ms ||
        a_.program.scan.max_ms != b_.program.scan.max_ms) {
      return fail("the programs have two scan intervals");
    }
    Model& model = *claims_.model;
    Side side{"a.", {}, clock_caps(a_.program)};
    const ProgramValues values_a = encode_program(a_.program, model, side);
    if (!share_inputs(values_a, side)) return std::move(claims_);
    side.prefix = "b.";
    side.clock_caps = clock_caps(b_.program);
    const ProgramValues values_b = encode_program(b_.program, model, side);
    if (!model.unknown_element.empty()) return std::move(claims_);
    claims_.first_memory = static_cast<std::uint32_t>(model.states.size());
    assume(a_, values_a);
    assume(b_, values_b);
    for (const ClaimedProperty& output : claimed.properties) {
      compare(output, values_a, values_b, claimed.delay);
    }
    return std::move(claims_);
  }

 private:
  Claims fail(std::string what) {
    claims_.error = std::move(what);
    return std::move(claims_);
  }

  const std::string& partner(const std::string& name) const {
    const auto found = partner_.find(name);
    return found == partner_.end() ? name : found->second;
  }

  bool share_inputs(const ProgramValues& values, Side& side) {
    for (const CellId id : ids_of(a_.program.cells)) {
      const Cell& one = a_.program.cells[id];
      const auto found = cells_b_.find(partner(one.name));
      if (one.role != CellRole::Input || found == cells_b_.end()) continue;
      const Cell& other = b_.program.cells[found->second];
      if (other.role != CellRole::Input) continue;
      if (one.type != other.type || one.low != other.low ||
          one.high != other.high) {
        claims_.error = "the input `" + one.name + "` has two ranges";
        return false;
      }
      side.inputs.emplace(other.name, values.cells[id.index()]);
    }
    return true;
  }

  void assume(const Compared& side, const ProgramValues& values) {
    FormulaEncoder formulas(side.program, values, *claims_.model);
    for (const std::string& text : side.properties.assumptions) {
      claims_.model->assumptions.push_back(formulas.value(text));
    }
  }

  /// No goal where one side has no such output: the result is rejected then.
  void compare(const ClaimedProperty& output, const ProgramValues& values_a,
               const ProgramValues& values_b, std::uint32_t delay) {
    const auto a = cells_a_.find(output.name);
    const auto b = cells_b_.find(partner(output.name));
    if (a == cells_a_.end() || b == cells_b_.end()) return;
    const Cell& one = a_.program.cells[a->second];
    const Cell& other = b_.program.cells[b->second];
    if (one.role == CellRole::Input || other.role == CellRole::Input) return;
    if (one.type != other.type) return;
    const Value earlier = ago(one, values_a.cells[a->second.index()], delay);
    Goal goal;
    goal.name = output.name;
    goal.form = output.kind;
    goal.text = output.text;
    goal.condition = earlier == values_b.cells[b->second.index()];
    claims_.goals.push_back(std::move(goal));
  }

  /// What the first program's output was so many scans before.
  Value ago(const Cell& cell, Value now, std::uint32_t scans) {
    Model& model = *claims_.model;
    for (std::uint32_t i = 1; i <= scans; ++i) {
      const std::string name = "a." + cell.name + ".ago" + std::to_string(i);
      const std::uint32_t state =
          model.add_state(name, cell.type == Type::Word, cell.initial);
      if (cell.type == Type::Word) model.claim(state, cell.low, cell.high);
      model.states[state].next = now;
      now = model.states[state].now;
      model.name(name, now);
    }
    return now;
  }

  const Compared& a_;
  const Compared& b_;
  std::unordered_map<std::string, CellId> cells_a_;
  std::unordered_map<std::string, CellId> cells_b_;
  std::unordered_map<std::string, std::string> partner_;
  Claims claims_;
};

}  // namespace

Claims claims_of(const Program& program, const PropertySet& properties) {
  Claims claims;
  claims.model = std::make_unique<Model>();
  const ProgramValues values = encode_program(program, *claims.model);
  claims.first_memory = static_cast<std::uint32_t>(claims.model->states.size());
  if (claims.model->unknown_element.empty()) {
    claims.goals =
        encode_properties(program, properties, values, *claims.model);
  }
  return claims;
}

Claims claims_of(const Compared& a, const Compared& b,
                 const std::vector<std::pair<std::string, std::string>>& map,
                 const ClaimedResult& claimed) {
  return SideBySide(a, b, map).claim(claimed);
}

}  // namespace rung::check
