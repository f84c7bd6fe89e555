#include "analysis/rules/rule_run.h"

#include <algorithm>
#include <utility>

#include "analysis/rules/enumeration.h"
#include "analysis/rules/sampling.h"

namespace rung {

namespace {

/// Past the budget nobody is asked.
Oracle* oracle_of(const RuleContext& context, const RuleBudget& budget) {
  return context.ts.exprs.size() <= budget.largest_system ? context.oracle
                                                          : nullptr;
}

}  // namespace

RuleRun::RuleRun(const RuleContext& context, DiagnosticSink& sink,
                 const RuleBudget& budget)
    : sources(context.sources),
      program(context.program),
      properties(context.properties),
      ts(context.ts),
      index(context.program, context.properties),
      latches(find_latches(context.program, index)),
      has_oracle(oracle_of(context, budget) != nullptr),
      past(context.ts),
      selection_(context.rules),
      too_large_(ts.exprs.size() > budget.largest_system),
      sink_(sink),
      oracle_(oracle_of(context, budget)),
      budget_(budget),
      explained_(context.program.rungs.size()),
      dead_(context.program.calls.size()) {
  for (const Cell& cell : program.cells) {
    if (cell.made) made_.insert(cell.name);
  }
}

/// Does it name a cell that the text does not? Nobody can act on that.
bool RuleRun::names_made_cell(std::string_view message) const {
  if (made_.empty()) return false;
  for (std::size_t at = message.find('`'); at != message.npos;) {
    const std::size_t end = message.find('`', at + 1);
    if (end == message.npos) return false;
    if (made_.contains(message.substr(at + 1, end - at - 1))) return true;
    at = message.find('`', end + 1);
  }
  return false;
}

void RuleRun::report(SourceRange where, std::string message, Details details) {
  if (names_made_cell(message)) return;
  sink_.report({.code = rule_->code,
                .severity = details.downgrade
                                ? Severity::Note
                                : selection_.severity_of(*rule_).value_or(
                                      rule_->severity),
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
  summary_.asked += always.size();
  const bool hopeless =
      !has_oracle && want == Want::Proof &&
      std::none_of(always.begin(), always.end(),
                   [this](ExprId id) { return ts.exprs.is_true(id); });
  if (hopeless) {
    summary_.undecided += always.size();
    return;
  }
  const std::size_t begin = conditions_.size();
  conditions_.insert(conditions_.end(), always.begin(), always.end());
  questions_.push_back(
      {rule_, want, begin, conditions_.size(), std::move(judge)});
}

void RuleRun::check(const Rule& rule) {
  rule_ = &rule;
  rule.check(*this);
}

/// What is true of every value of the terms close to a condition needs no
/// solver.
void RuleRun::enumerate_all(std::vector<Evidence>& answers) const {
  std::vector<ExprId> open;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    if (answers[i].answer != Answer::Unknown) continue;
    open.push_back(conditions_[i]);
    of.push_back(i);
  }
  const std::vector<bool> known = enumerate(ts, open);
  for (std::size_t k = 0; k < of.size(); ++k) {
    if (known[k]) answers[of[k]] = {Answer::Yes, "enumeration", std::nullopt};
  }
}

/// Random runs answer the questions of which only a proof would count.
void RuleRun::sample_proofs(std::vector<Evidence>& answers) {
  const std::vector<bool> refuted =
      sample(ts, conditions_, budget_.sampling_work);
  for (const Question& question : questions_) {
    if (question.want == Want::Witness) continue;
    for (std::size_t i = question.begin; i < question.end; ++i) {
      if (!refuted[i]) continue;
      answers[i] = {Answer::No, "sampling", std::nullopt};
      ++summary_.sampled;
    }
  }
}

/// What is still open, within the budget, goes to the oracle: of equal
/// conditions one question.
void RuleRun::ask_oracle(std::vector<Evidence>& answers) const {
  std::vector<Oracle::Question> asked;
  std::vector<std::uint32_t> place(ts.exprs.size(), 0);  // in `asked`, from 1
  std::size_t proofs = budget_.proof_questions;
  std::size_t witnesses = budget_.witness_questions;
  for (const Question& question : questions_) {
    const bool shown = question.want == Want::Witness;
    std::size_t& left = shown ? witnesses : proofs;
    for (std::size_t i = question.begin; i < question.end; ++i) {
      std::uint32_t& at = place[conditions_[i].index()];
      if (answers[i].answer != Answer::Unknown) continue;
      if (at == 0 && left == 0) continue;
      if (at == 0) {
        --left;
        asked.push_back({conditions_[i], shown});
        at = static_cast<std::uint32_t>(asked.size());
      }
      asked[at - 1].wants_witness = asked[at - 1].wants_witness || shown;
    }
  }
  if (asked.empty()) return;
  const std::vector<Evidence> decided = oracle_->answer(asked);
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    const std::uint32_t at = place[conditions_[i].index()];
    if (answers[i].answer == Answer::Unknown && at != 0) {
      answers[i] = decided[at - 1];
    }
  }
}

RuleSummary RuleRun::decide() {
  summary_.too_large = too_large_;
  std::vector<Evidence> answers(conditions_.size());
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    if (ts.exprs.is_true(conditions_[i])) {
      answers[i] = {Answer::Yes, "simplification", std::nullopt};
    }
  }
  if (has_oracle && !conditions_.empty()) {
    enumerate_all(answers);
    sample_proofs(answers);
    ask_oracle(answers);
  }
  for (const Evidence& answer : answers) {
    if (answer.answer == Answer::Unknown) ++summary_.undecided;
  }
  for (const Question& question : questions_) {
    rule_ = question.rule;
    question.judge(*this, std::span(answers).subspan(
                              question.begin, question.end - question.begin));
  }
  return summary_;
}

}  // namespace rung
