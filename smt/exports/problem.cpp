#include "smt/exports/problem.h"

#include <algorithm>

#include "smt/faults.h"

namespace rung {
namespace {

std::string why_not(const std::vector<Obligation>& obligations) {
  if (obligations.empty()) return "no property is asked for";
  for (const Obligation& one : obligations) {
    if (one.goal == Goal::Recover || one.goal == Goal::Respond) {
      return "`" + one.name +
             "`: no reachability, which is all that these formats can ask";
    }
    if (one.goal != obligations.front().goal) {
      return "`" + obligations.front().name + "` and `" + one.name +
             "`: one is to hold, the other to be met; ask for them one by one "
             "with --property";
    }
  }
  return {};
}

/// They are about another system, in which time may stop.
std::string what_settles(const PropertySet& properties,
                         const std::function<bool(std::string_view)>& wanted) {
  for (const Property& one : properties.properties) {
    if (one.form != Property::Form::Settles) continue;
    if (wanted && !wanted(one.name)) continue;
    return "`" + one.name + "`: what settles while time stands still is not " +
           "asked of other tools";
  }
  return {};
}

}  // namespace

ModelProblem make_problem(const Program& program, const PropertySet& properties,
                          const std::function<bool(std::string_view)>& wanted) {
  ModelProblem problem;
  problem.error = what_settles(properties, wanted);
  if (!problem.error.empty()) return problem;
  problem.ts = build_transition_system(program);
  TransitionSystem& ts = problem.ts;
  std::vector<Obligation> obligations =
      make_obligations(program, properties, ts);
  std::erase_if(obligations, [&](const Obligation& one) {
    return wanted ? !wanted(one.name) : one.built_in;
  });
  problem.error = why_not(obligations);
  if (!problem.error.empty()) return problem;
  ExprArena& exprs = ts.exprs;
  const bool reach = obligations.front().goal == Goal::Reach;
  problem.bad = exprs.bit(false);
  problem.legal = exprs.conjunction(ts.constraints);
  for (const Obligation& one : obligations) {
    problem.names.push_back(one.name);
    problem.bad = exprs.disjunction(
        problem.bad, reach ? one.condition : exprs.negation(one.condition));
  }
  for (const std::size_t i : faults_under(ts, problem.bad)) {
    const ExprId fault = ts.faults[i].condition;
    if (reach) {
      problem.legal = exprs.conjunction(problem.legal, exprs.negation(fault));
    } else {
      problem.bad = exprs.disjunction(problem.bad, fault);
    }
  }
  return problem;
}

}  // namespace rung
