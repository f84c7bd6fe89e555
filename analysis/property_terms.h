#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/formula.h"
#include "analysis/property_check.h"
#include "analysis/transition_system.h"

namespace rung {

/// Makes terms of the formulas of properties, which have been checked.
///
/// Every formula is a function of the run up to a scan's end. Its value `back`
/// scans ago (0: this scan's end) is a term over the state before the scan and
/// the inputs of the scan: values of this scan's end are there as they are,
/// those of the end before are the state, and older ones, and old inputs, are
/// remembered in states that are added to the transition system, each once.
/// Before the first scan everything has its initial value, and nothing was
/// `once` true.
class PropertyTerms {
 public:
  PropertyTerms(const Program& program, TransitionSystem& ts)
      : program_(program), ts_(ts), names_(program) {
    calls_.resize(program.instances.size());
    for (const CallId id : ids_of(program.calls)) {
      const ElementCall& call = program.calls[id];
      if (call.operation->steps()) calls_[call.instance.index()].push_back(id);
    }
  }

  /// The bit term of a formula's text, at this scan's end.
  ExprId term(std::string_view text);

  /// What it was at the end of the scan before.
  ExprId before(std::string_view text);

  /// The left side of a formula that is an implication; else no value.
  ExprId left_side(std::string_view text);

  /// The value of `now` at the end of the scan before; `initial` in the first.
  ExprId remembered(ExprId now, std::int64_t initial, std::string name);

  TransitionSystem& ts() { return ts_; }

 private:
  /// How a subformula is asked for: scans back, and inside `begin` or not.
  struct View {
    std::uint32_t back = 0;
    bool begin = false;
  };
  struct Demand {
    std::uint64_t end = 0;    // bit k: k scans back
    std::uint64_t begin = 0;  // the same, inside `begin`
  };

  ExprId lower(const Formula& formula, std::uint32_t root, std::uint32_t back);
  void demand_operands(const Formula& formula, std::uint32_t node,
                       std::vector<Demand>& demands) const;
  ExprId value(const Formula& formula, std::uint32_t node, View view);
  ExprId call(const FormulaNode& node, std::uint32_t operand, View view);
  ExprId name(std::string_view text, View view);
  ExprId cell(CellId id, std::uint32_t back);
  ExprId element(const PropertyName& name, std::string_view text,
                 std::uint32_t back);
  ExprId fired(InstanceId id, std::string_view text, std::uint32_t back);
  ExprId observation(const Instance& instance, InstanceId id,
                     std::string_view formula, int moment);
  ExprId once(ExprId now, std::string_view text, std::uint32_t back);
  ExprId older(ExprId term, std::int64_t initial, std::string_view name,
               std::uint32_t from, std::uint32_t back);

  static std::uint64_t key(std::uint32_t node, View view) {
    return (std::uint64_t{node} << 7) | (view.begin ? 64U : 0U) | view.back;
  }
  ExprId operand_value(std::uint32_t node, View view) const {
    return values_.at(key(node, view));
  }

  const Program& program_;
  TransitionSystem& ts_;
  PropertyNames names_;
  std::vector<std::vector<CallId>> calls_;  // by InstanceId, resets left out
  std::string_view text_;                   // of the formula at hand
  std::unordered_map<std::uint64_t, ExprId> values_;
  std::map<std::pair<ExprId, std::int64_t>, std::uint32_t> remembered_;
  std::unordered_map<ExprId, std::uint32_t> once_;
};

}  // namespace rung
