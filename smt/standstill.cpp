#include "smt/standstill.h"

#include <algorithm>

#include "analysis/property_terms.h"
#include "smt/faults.h"

namespace rung {

Standstill::Standstill(const Program& program,
                       const std::vector<std::string>& assumptions,
                       const ResponseQuestion& question)
    : ts_(build_transition_system(program)) {
  PropertyTerms terms(program, ts_);
  const ExprId cause = terms.term(question.cause);
  response_ = terms.term(question.response);
  for (const std::string& text : assumptions) {
    ts_.constraints.push_back(terms.term(text));
  }
  std::vector<ExprId> roots = ts_.constraints;
  roots.push_back(cause);
  roots.push_back(response_);
  for (const ExprId root : {cause, response_}) {
    for (const std::size_t fault : faults_under(ts_, root)) {
      faults_.push_back(ts_.faults[fault].condition);
    }
  }
  roots.insert(roots.end(), faults_.begin(), faults_.end());
  const std::vector<bool> in_cone = cone_of_influence(ts_, roots);
  for (std::uint32_t i = 0; i < ts_.states.size(); ++i) {
    if (in_cone[ts_.states[i].var.index()]) states_.push_back(i);
  }
  for (const VarId id : ids_of(ts_.vars)) {
    const Variable& var = ts_.vars[id];
    if (!in_cone[id.index()]) continue;
    if (var.role == VarRole::Input) inputs_.emplace_back(var.cell, id);
    exact_ = exact_ && var.role != VarRole::Choice;
  }
  terms_ = std::make_unique<Interpreter>(ts_, roots);
}

/// One scan; false when it is none of the program.
bool Standstill::scan(const StimulusStep& step,
                      const std::vector<CellId>& inputs) {
  for (const auto& [cell, var] : inputs_) {
    const auto at = std::find(inputs.begin(), inputs.end(), cell);
    if (at == inputs.end()) continue;
    terms_->set_input(
        var, step.inputs[static_cast<std::size_t>(at - inputs.begin())]);
  }
  terms_->set_input(ts_.dt, step.dt_ms);
  terms_->scan();
  const auto holds = [this](ExprId term) { return terms_->value(term) != 0; };
  return std::all_of(ts_.constraints.begin(), ts_.constraints.end(), holds) &&
         std::none_of(faults_.begin(), faults_.end(), holds);
}

std::vector<std::int64_t> Standstill::state() const {
  std::vector<std::int64_t> values;
  values.reserve(states_.size());
  for (const std::uint32_t state : states_) {
    values.push_back(terms_->state(state));
  }
  return values;
}

std::optional<Stimulus> Standstill::find(const Stimulus& stimulus,
                                         std::int64_t dt_ms,
                                         std::uint64_t limit) {
  if (!exact_) return std::nullopt;
  terms_->reset();
  for (const StimulusStep& step : stimulus.steps) {
    if (step.repeat > limit) return std::nullopt;
    limit -= step.repeat;
    for (std::uint64_t i = 0; i < step.repeat; ++i) {
      if (!scan(step, stimulus.inputs)) return std::nullopt;
    }
  }
  StimulusStep more = stimulus.steps.back();
  more.dt_ms = dt_ms;
  more.repeat = 0;
  // Brent: what it is compared with moves on to where it is, ever more seldom.
  std::vector<std::int64_t> seen = state();
  for (std::uint64_t scans = 0, until = 1; scans < limit;) {
    if (!scan(more, stimulus.inputs)) return std::nullopt;
    if (terms_->value(response_) != 0) return std::nullopt;
    ++more.repeat;
    const std::vector<std::int64_t> now = state();
    if (now == seen) {
      Stimulus result = stimulus;
      result.steps.push_back(more);
      return result;
    }
    if (++scans < until) continue;
    until *= 2;
    seen = now;
  }
  return std::nullopt;
}

}  // namespace rung
