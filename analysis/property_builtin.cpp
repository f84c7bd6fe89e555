#include "analysis/property_builtin.h"

#include <cstdint>
#include <string>
#include <utility>

namespace rung {
namespace {

/// How the value of a node depends on the rung's own target.
struct Dependence {
  bool rising = false;   // where the target is read plainly
  bool falling = false;  // where it is read negated
};

/// Finds the rungs of which the target seals itself in: it is read plainly in
/// its own expression, outside of element calls. `Q = !Q` toggles and does not.
class LatchFinder {
 public:
  explicit LatchFinder(const Program& program)
      : program_(program), nodes_(program.nodes.size()) {}

  bool latches(const Rung& rung) {
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      nodes_[i] = dependence(rung.target, program_.nodes[i]);
    }
    return nodes_[rung.root()].rising && !nodes_[rung.root()].falling;
  }

 private:
  Dependence dependence(CellId target, const Node& node) const {
    switch (node.op) {
      case NodeOp::Read:
        return {.rising = node.cell == target};
      case NodeOp::Not:
        return {.rising = nodes_[node.a].falling,
                .falling = nodes_[node.a].rising};
      case NodeOp::And:
      case NodeOp::Or:
        return {.rising = nodes_[node.a].rising || nodes_[node.b].rising,
                .falling = nodes_[node.a].falling || nodes_[node.b].falling};
      default:
        return {};
    }
  }

  const Program& program_;
  std::vector<Dependence> nodes_;
};

class Builtins {
 public:
  explicit Builtins(const Program& program) : program_(program) {}

  std::vector<Property> take() {
    std::vector<bool> latched(program_.cells.size(), false);
    add_latches(latched);
    for (const CellId id : ids_of(program_.cells)) {
      const Cell& cell = program_.cells[id];
      const bool asked = cell.role == CellRole::Output &&
                         cell.type == Type::Bit && !latched[id.index()];
      if (!asked) continue;
      add(cell.name, "can-become-true", "rose(" + cell.name + ")",
          "output `" + cell.name + "` can become true", cell.where);
      add(cell.name, "can-become-false", "fell(" + cell.name + ")",
          "output `" + cell.name + "` can become false", cell.where);
    }
    for (const Instance& instance : program_.instances) {
      if (instance.kind->done.empty()) continue;
      const bool timer = instance.kind->family == ElementFamily::Timer;
      add(instance.name, "can-fire", instance.name + ".fired",
          (timer ? "timer `" : "counter `") + instance.name + "` can fire",
          instance.where);
    }
    return std::move(properties_);
  }

 private:
  void add_latches(std::vector<bool>& latched) {
    LatchFinder finder(program_);
    for (const Rung& rung : program_.rungs) {
      const Cell& cell = program_.cells[rung.target];
      if (cell.type != Type::Bit || latched[rung.target.index()]) continue;
      if (!finder.latches(rung)) continue;
      latched[rung.target.index()] = true;
      const std::string what = "`" + cell.name + "` latches itself: ";
      add(cell.name, "settable", "rose(" + cell.name + ")",
          what + "some run sets it", rung.target_where);
      add(cell.name, "releasable", "fell(" + cell.name + ")",
          what + "some run releases it", rung.target_where);
    }
  }

  void add(const std::string& subject, std::string_view part,
           std::string formula, std::string text, SourceRange where) {
    Property property;
    property.form = Property::Form::Reach;
    property.name = "builtin." + subject + "." + std::string(part);
    property.text = std::move(text);
    property.where = where;
    property.formulas.push_back(std::move(formula));
    property.built_in = true;
    properties_.push_back(std::move(property));
  }

  const Program& program_;
  std::vector<Property> properties_;
};

}  // namespace

std::vector<Property> builtin_properties(const Program& program) {
  return Builtins(program).take();
}

}  // namespace rung
