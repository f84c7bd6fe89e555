#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/property.h"
#include "analysis/transition_system.h"
#include "base/digest.h"

namespace rung {

/// What the answer to an obligation depends on, as a digest: the parts of the
/// system that its terms, the assumptions and the faults below them reach,
/// through any number of scans. Where two programs give an obligation the same
/// digest, these parts are the same but for the numbers of terms: in their
/// names, initial values, next values and ranges. So verdict, invariant and run
/// of one are those of the other.
///
/// Names do not depend on lines: a monitor of a property is named by what the
/// property says. Variables of equal names are told apart by their order.
/// Limits: linear in the terms reached, but for sorting; no recursion.
class Slices {
 public:
  /// `obligations` are all that make_obligations() gave for `ts`.
  Slices(const TransitionSystem& ts, const PropertySet& properties,
         const std::vector<Obligation>& obligations);
  Slices(const Slices&) = delete;  // a copy would look up names of the first
  Slices& operator=(const Slices&) = delete;

  Digest of(const Obligation& obligation) const;
  /// Of a variable, with all that its value depends on. Nothing: no obligation
  /// depends on it.
  std::optional<Digest> of(VarId var) const;

  const std::string& name(VarId var) const { return names_[var.index()]; }
  std::optional<VarId> find(std::string_view name) const;

 private:
  class Components;

  void name_variables(const PropertySet& properties);
  void reach(const std::vector<Obligation>& obligations);
  void digest_terms();
  Digest digest_term(ExprId id) const;
  Digest definition(ExprId variable) const;
  Digest below(ExprId id) const;  // the term and its slice
  std::vector<ExprId> successors(ExprId id) const;

  const TransitionSystem& ts_;
  std::vector<std::string> names_;  // by VarId
  std::unordered_map<std::string_view, VarId> by_name_;
  std::unordered_map<ExprId, std::vector<ExprId>> faults_;  // by comparison
  std::vector<bool> reached_;   // by ExprId, as the rest
  std::vector<Digest> terms_;   // over variables of this scan
  std::vector<Digest> slices_;  // what these are in turn
};

}  // namespace rung
