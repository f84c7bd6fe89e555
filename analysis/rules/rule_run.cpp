#include "analysis/rules/rule_run.h"

#include <algorithm>
#include <utility>

#include "analysis/rules/sampling.h"

namespace rung {

RuleRun::RuleRun(const RuleContext& context, DiagnosticSink& sink)
    : sources(context.sources),
      program(context.program),
      properties(context.properties),
      ts(context.ts),
      index(context.program, context.properties),
      latches(find_latches(context.program, index)),
      has_oracle(context.oracle != nullptr),
      sink_(sink),
      explained_(context.program.rungs.size()),
      dead_(context.program.calls.size()) {}

void RuleRun::report(SourceRange where, std::string message, Details details) {
  sink_.report(
      {.code = rule_->code,
       .severity = details.downgrade ? Severity::Note : rule_->severity,
       .where = where,
       .message = std::move(message),
       .labels = std::move(details.labels),
       .rule = rule_->name,
       .help = std::move(details.help)});
}

void RuleRun::report(SourceRange where, std::string message) {
  report(where, std::move(message), {});
}

void RuleRun::ask(Want want, std::vector<ExprId> always, Judge judge) {
  const std::size_t begin = conditions_.size();
  conditions_.insert(conditions_.end(), always.begin(), always.end());
  questions_.push_back(
      {rule_, want, begin, conditions_.size(), std::move(judge)});
}

void RuleRun::check(const Rule& rule) {
  rule_ = &rule;
  rule.check(*this);
}

/// The questions for the oracle, by position in conditions_: what is still
/// open, within the budget, and of equal conditions only the first.
std::vector<std::size_t> RuleRun::select(const std::vector<Evidence>& answers,
                                         const RuleBudget& budget) const {
  std::vector<std::size_t> chosen;
  std::vector<bool> seen(ts.exprs.size());
  std::size_t proofs = budget.proof_questions;
  std::size_t witnesses = budget.witness_questions;
  for (const Question& question : questions_) {
    std::size_t& left = question.want == Want::Proof ? proofs : witnesses;
    for (std::size_t i = question.begin; i < question.end; ++i) {
      const std::uint32_t term = conditions_[i].index();
      if (answers[i].answer != Answer::Unknown || seen[term] || left == 0) {
        continue;
      }
      seen[term] = true;
      --left;
      chosen.push_back(i);
    }
  }
  return chosen;
}

RuleSummary RuleRun::decide(Oracle* oracle, const RuleBudget& budget) {
  RuleSummary summary;
  summary.asked = conditions_.size();
  std::vector<Evidence> answers(conditions_.size());
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    if (ts.exprs.is_true(conditions_[i])) {
      answers[i] = {Answer::Yes, "simplification", std::nullopt};
    }
  }
  if (oracle != nullptr && !conditions_.empty()) {
    const std::vector<bool> refuted =
        sample(ts, conditions_, budget.sampling_work);
    for (const Question& question : questions_) {
      if (question.want == Want::Witness) continue;
      for (std::size_t i = question.begin; i < question.end; ++i) {
        if (!refuted[i]) continue;
        answers[i] = {Answer::No, "sampling", std::nullopt};
        ++summary.sampled;
      }
    }
    const std::vector<std::size_t> chosen = select(answers, budget);
    std::vector<ExprId> terms;
    for (const std::size_t i : chosen) terms.push_back(conditions_[i]);
    const std::vector<Evidence> decided =
        terms.empty() ? std::vector<Evidence>() : oracle->always(terms);
    std::vector<std::size_t> first(ts.exprs.size(), 0);  // position + 1
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      first[terms[k].index()] = k + 1;
    }
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
      const std::size_t k = first[conditions_[i].index()];
      if (answers[i].answer == Answer::Unknown && k != 0) {
        answers[i] = decided[k - 1];
      }
    }
  }
  for (const Evidence& answer : answers) {
    if (answer.answer == Answer::Unknown) ++summary.undecided;
  }
  for (const Question& question : questions_) {
    rule_ = question.rule;
    question.judge(*this, std::span(answers).subspan(
                              question.begin, question.end - question.begin));
  }
  return summary;
}

}  // namespace rung
