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

  /// The contacts beside the target's own, from the outermost inwards: those
  /// in parallel to it set, those in series hold.
  struct Contacts {
    std::vector<SourceRange> set;
    std::vector<SourceRange> hold;
    SourceRange own;
  };
  /// Preconditions: latches(rung) was the last call, and was true.
  Contacts contacts(const Rung& rung) const {
    Contacts found;
    std::uint32_t at = rung.root();
    for (;;) {
      const Node& node = program_.nodes[at];
      found.own = node.where;
      if (node.op != NodeOp::And && node.op != NodeOp::Or) return found;
      if (nodes_[node.a].rising == nodes_[node.b].rising) return found;
      const bool left = nodes_[node.a].rising;
      const SourceRange beside = program_.nodes[left ? node.b : node.a].where;
      (node.op == NodeOp::And ? found.hold : found.set).push_back(beside);
      at = left ? node.a : node.b;
    }
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

/// `stop.1`: a bit of the reader's own. `timer.Q` is made, too, but has a name.
bool is_unnamed(const Cell& cell) {
  return cell.made &&
         cell.name.find_first_not_of("0123456789", cell.name.rfind('.') + 1) ==
             std::string::npos;
}

class Builtins {
 public:
  Builtins(const Program& program, const SourceSet& sources)
      : program_(program), sources_(sources) {}

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
      if (is_unnamed(cell)) continue;
      if (!finder.latches(rung)) continue;
      latched[rung.target.index()] = true;
      const std::string what = "`" + cell.name + "` latches itself" +
                               structure(finder.contacts(rung)) + ": ";
      add(cell.name, "settable", "rose(" + cell.name + ")",
          what + "some run sets it", rung.target_where);
      add(cell.name, "releasable", "fell(" + cell.name + ")",
          what + "some run releases it", rung.target_where);
    }
  }

  std::string structure(const LatchFinder::Contacts& contacts) const {
    return listed(", set by", contacts.set, contacts.own) +
           listed(", held while", contacts.hold, contacts.own);
  }

  /// As written in the source; nothing where an element's text is all there is.
  std::string listed(std::string_view lead,
                     const std::vector<SourceRange>& contacts,
                     SourceRange own) const {
    constexpr std::size_t kMaxText = 40;
    std::string text;
    for (const SourceRange& where : contacts) {
      const bool covers = where.begin <= own.begin && own.end <= where.end;
      if (!where.has_value() || !own.has_value() || covers) return {};
      const std::string_view contact = sources_.text(where);
      if (contact.size() > kMaxText || contact.find('\n') != contact.npos) {
        return {};
      }
      text += (text.empty() ? std::string(lead) + " `" : " and `") +
              std::string(contact) + "`";
    }
    return text;
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
  const SourceSet& sources_;
  std::vector<Property> properties_;
};

}  // namespace

std::vector<Property> builtin_properties(const Program& program,
                                         const SourceSet& sources) {
  return Builtins(program, sources).take();
}

}  // namespace rung
