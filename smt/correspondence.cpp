#include "smt/correspondence.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace rung {
namespace {

bool commutes(ExprOp op) {
  switch (op) {
    case ExprOp::And:
    case ExprOp::Xor:
    case ExprOp::Equal:
    case ExprOp::Add:
    case ExprOp::Multiply:
      return true;
    case ExprOp::Constant:
    case ExprOp::Variable:
    case ExprOp::Not:
    case ExprOp::Less:
    case ExprOp::Divide:
    case ExprOp::Wrap16:
    case ExprOp::Ite:
      return false;
  }
  return false;
}

/// A term up to the order of its operands.
struct Shape {
  ExprOp op = ExprOp::Constant;
  Type type = Type::Bit;
  std::int64_t value = 0;
  std::uint32_t a = 0;  // operand + 1, or the variable + 1
  std::uint32_t b = 0;
  std::uint32_t c = 0;
  friend bool operator==(const Shape&, const Shape&) = default;
};

std::uint64_t hash_of(const Shape& shape) {
  constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = static_cast<std::uint64_t>(shape.op) * 2U +
                       static_cast<std::uint64_t>(shape.type);
  for (const std::uint64_t part :
       {static_cast<std::uint64_t>(shape.value), std::uint64_t{shape.a},
        std::uint64_t{shape.b}, std::uint64_t{shape.c}}) {
    hash = (hash ^ part) * kMix;
    hash ^= hash >> 29U;
  }
  return hash;
}

std::uint32_t raw(ExprId id) { return id.has_value() ? id.index() + 1U : 0U; }

/// The terms of a system by shape: open addressing, index + 1, 0 is empty.
class ShapeTable {
 public:
  explicit ShapeTable(const TransitionSystem& ts) {
    std::size_t size = 16;
    while (size < ts.exprs.size() * 2) size *= 2;
    table_.assign(size, 0);
    shapes_.reserve(ts.exprs.size());
    for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
      shapes_.push_back(own_shape(ts.exprs[ExprId(i)]));
      std::uint32_t& slot = table_[slot_of(shapes_.back())];
      if (slot == 0) slot = i + 1;
    }
  }

  ExprId find(const Shape& shape) const {
    const std::uint32_t found = table_[slot_of(shape)];
    return found == 0 ? ExprId() : ExprId(found - 1);
  }

 private:
  static Shape own_shape(const Expr& e) {
    Shape shape{e.op, e.type, e.value, raw(e.a), raw(e.b), raw(e.c)};
    if (e.op == ExprOp::Variable) shape.a = e.var.index() + 1;
    if (commutes(e.op) && shape.b < shape.a) std::swap(shape.a, shape.b);
    return shape;
  }

  std::size_t slot_of(const Shape& shape) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = hash_of(shape) & mask;
    while (table_[slot] != 0 && !(shapes_[table_[slot] - 1] == shape)) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  std::vector<Shape> shapes_;
  std::vector<std::uint32_t> table_;
};

/// Variables of the second system by the equal one of the first.
using VariableMap = std::vector<VarId>;

/// A choice is a free bit of the encoding that stands for something fixed in
/// the program (where a counter is below its floor). Equal states choose
/// alike, so the n-th of an element is the n-th of its partner.
std::string element_of_choice(const Variable& choice) {
  return choice.name.substr(0, choice.name.rfind(".any"));
}

void match_choices(const TwoSystems& systems, VariableMap& map) {
  std::unordered_map<std::string, std::vector<VarId>> choices;
  for (const VarId id : ids_of(systems.a.vars)) {
    const Variable& variable = systems.a.vars[id];
    if (variable.role != VarRole::Choice) continue;
    choices[element_of_choice(variable)].push_back(id);
  }
  std::unordered_map<std::string, std::size_t> used;
  for (const VarId id : ids_of(systems.b.vars)) {
    const Variable& variable = systems.b.vars[id];
    if (variable.role != VarRole::Choice) continue;
    const std::string name = element_of_choice(variable);
    const auto found = choices.find(name);
    const std::size_t n = used[name]++;
    if (found == choices.end() || n >= found->second.size()) continue;
    map[id.index()] = found->second[n];
  }
}

VariableMap map_inputs(const TwoSystems& systems) {
  VariableMap map(systems.b.vars.size());
  std::unordered_map<CellId, VarId> inputs;
  for (const VarId id : ids_of(systems.a.vars)) {
    const Variable& variable = systems.a.vars[id];
    if (variable.role == VarRole::Input) inputs.emplace(variable.cell, id);
  }
  std::unordered_map<CellId, CellId> partners;
  for (const SignalPair& pair : systems.shared.inputs) {
    if (pair.a.has_value() && pair.b.has_value()) {
      partners.emplace(pair.b, pair.a);
    }
  }
  for (const VarId id : ids_of(systems.b.vars)) {
    const Variable& variable = systems.b.vars[id];
    if (variable.role != VarRole::Input) continue;
    const auto partner = partners.find(variable.cell);
    if (partner != partners.end()) {
      map[id.index()] = inputs.at(partner->second);
    }
  }
  map[systems.b.dt.index()] = systems.a.dt;
  match_choices(systems, map);
  return map;
}

void map_states(const TwoSystems& systems, const std::vector<StatePair>& states,
                VariableMap& map) {
  for (const StatePair& pair : states) {
    map[systems.b.states[pair.b].var.index()] = systems.a.states[pair.a].var;
  }
}

std::vector<ExprId> find_images(const TwoSystems& systems,
                                const ShapeTable& table,
                                const VariableMap& map) {
  const ExprArena& terms = systems.b.exprs;
  std::vector<ExprId> image(terms.size());
  for (std::uint32_t i = 0; i < terms.size(); ++i) {
    const Expr& e = terms[ExprId(i)];
    Shape shape{e.op, e.type, e.value, 0, 0, 0};
    bool known = true;
    const auto operand = [&](ExprId id) -> std::uint32_t {
      if (!id.has_value()) return 0;
      known = known && image[id.index()].has_value();
      return raw(image[id.index()]);
    };
    if (e.op == ExprOp::Variable) {
      known = map[e.var.index()].has_value();
      if (known) shape.a = map[e.var.index()].index() + 1;
    } else {
      shape.a = operand(e.a);
      shape.b = operand(e.b);
      shape.c = operand(e.c);
    }
    if (commutes(e.op) && shape.b < shape.a) std::swap(shape.a, shape.b);
    if (known) image[i] = table.find(shape);
  }
  return image;
}

bool outputs_are_equal(const TwoSystems& systems, const Correspondence& found) {
  return std::all_of(
      systems.shared.outputs.begin(), systems.shared.outputs.end(),
      [&](const SignalPair& pair) {
        return found.image[systems.b.cell_end[pair.b.index()].index()] ==
               systems.a.cell_end[pair.a.index()];
      });
}

bool faults_are_equal(const TwoSystems& systems, const Correspondence& found) {
  std::unordered_set<ExprId> faults_a;
  std::unordered_set<ExprId> faults_b;
  for (const Fault& fault : systems.a.faults) faults_a.insert(fault.condition);
  for (const Fault& fault : systems.b.faults) {
    faults_b.insert(found.image[fault.condition.index()]);
  }
  return faults_a == faults_b;
}

bool same_operands(const Expr& a, const Expr& b,
                   const std::vector<ExprId>& image) {
  const auto equal = [&](ExprId of_b, ExprId of_a) {
    if (!of_b.has_value()) return !of_a.has_value();
    return of_a.has_value() && image[of_b.index()] == of_a;
  };
  if (equal(b.c, a.c) && equal(b.a, a.a) && equal(b.b, a.b)) return true;
  return commutes(a.op) && equal(b.a, a.b) && equal(b.b, a.a);
}

}  // namespace

Correspondence correspond(const TwoSystems& systems,
                          std::vector<StatePair> candidates) {
  constexpr int kRounds = 16;
  const ShapeTable table(systems.a);
  const VariableMap inputs = map_inputs(systems);
  Correspondence found;
  found.states = std::move(candidates);
  for (int round = 0; round < kRounds; ++round) {
    VariableMap map = inputs;
    map_states(systems, found.states, map);
    found.image = find_images(systems, table, map);
    const auto differs = [&](const StatePair& pair) {
      return found.image[systems.b.states[pair.b].next.index()] !=
             systems.a.states[pair.a].next;
    };
    const auto kept =
        std::remove_if(found.states.begin(), found.states.end(), differs);
    if (kept == found.states.end()) {
      found.outputs_equal = outputs_are_equal(systems, found);
      found.faults_equal = faults_are_equal(systems, found);
      return found;
    }
    found.states.erase(kept, found.states.end());
  }
  // What is left may rest on pairs that were taken out: claim nothing.
  found.states.clear();
  found.image.assign(systems.b.exprs.size(), ExprId());
  return found;
}

std::vector<ChoicePair> shared_choices(const TwoSystems& systems,
                                       const std::vector<StatePair>& states) {
  const auto element = [](const TransitionSystem& ts, const State& state) {
    const std::string& name = ts.vars[state.var].name;
    return name.substr(0, name.rfind('.'));
  };
  std::unordered_map<std::string, std::size_t> apart;  // states of the second
  for (const State& state : systems.b.states) {
    ++apart[element(systems.b, state)];
  }
  for (const StatePair& pair : states) {
    const std::string name = element(systems.b, systems.b.states[pair.b]);
    if (element(systems.a, systems.a.states[pair.a]) == name) --apart[name];
  }
  VariableMap map(systems.b.vars.size());
  match_choices(systems, map);
  std::vector<ChoicePair> choices;
  for (const VarId id : ids_of(systems.b.vars)) {
    const VarId same = map[id.index()];
    if (!same.has_value()) continue;
    if (apart[element_of_choice(systems.b.vars[id])] > 0) continue;
    choices.push_back({same, id});
  }
  return choices;
}

std::string check_correspondence(const TwoSystems& systems,
                                 const Correspondence& claim) {
  const TransitionSystem& a = systems.a;
  const TransitionSystem& b = systems.b;
  VariableMap map = map_inputs(systems);
  map_states(systems, claim.states, map);
  for (std::uint32_t i = 0; i < b.exprs.size(); ++i) {
    if (!claim.image[i].has_value()) continue;
    const Expr& of_b = b.exprs[ExprId(i)];
    const Expr& of_a = a.exprs[claim.image[i]];
    const bool same =
        of_a.op == of_b.op && of_a.type == of_b.type &&
        of_a.value == of_b.value &&
        (of_a.op == ExprOp::Variable ? map[of_b.var.index()] == of_a.var
                                     : same_operands(of_a, of_b, claim.image));
    if (!same) return "terms that are said to be equal differ";
  }
  for (const StatePair& pair : claim.states) {
    const State& x = a.states[pair.a];
    const State& y = b.states[pair.b];
    if (x.init != y.init || claim.image[y.next.index()] != x.next) {
      return "`" + a.vars[x.var].name + "` does not stay equal";
    }
  }
  if (claim.outputs_equal && !outputs_are_equal(systems, claim)) {
    return "an output is not shown equal";
  }
  if (claim.faults_equal && !faults_are_equal(systems, claim)) {
    return "a fault has no partner";
  }
  return {};
}

}  // namespace rung
