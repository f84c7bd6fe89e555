#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "smt/invariant.h"
#include "smt/run.h"
#include "smt/target.h"

namespace rung {

/// Independent parts of a program that are the same but for names: the motors
/// of a plant. What engines find of the first, its model, is said of the
/// others in their own names. It is only said: each part's certificates and
/// runs are checked like any.
class AlikeParts {
 public:
  /// `parts` are indices into `targets`, as of partition().
  AlikeParts(const TransitionSystem& ts, const std::vector<Target>& targets,
             const std::vector<std::vector<std::size_t>>& parts);

  /// The first part that is like this one; itself, when none before it is.
  std::size_t model(std::size_t part) const { return model_[part]; }

  /// A run in which each part does what its model does in `run`.
  FoundRun in_all(const FoundRun& run) const;

  /// The terms of a part, in one order for all that are alike.
  const std::vector<ExprId>& terms(std::size_t part) const {
    return terms_[part];
  }

 private:
  std::vector<std::size_t> model_;          // by part
  std::vector<std::vector<ExprId>> terms_;  // by part; empty: like no other
  std::vector<std::pair<VarId, VarId>> inputs_;  // of a model, of a part
};

/// From the names of a model to those of a part that is like it.
class Renaming {
 public:
  Renaming(TransitionSystem& ts, const std::vector<ExprId>& from,
           const std::vector<ExprId>& to);

  Invariant invariant(const Invariant& of_model);
  FoundRun run(const FoundRun& of_model) const;

 private:
  ExprId term(ExprId of_model);
  ExprId over_known(const Expr& e);
  VarId variable(VarId of_model) const;
  ExprId known(ExprId of_model) const { return terms_.at(of_model); }

  TransitionSystem& ts_;
  std::unordered_map<ExprId, ExprId> terms_;
};

}  // namespace rung
