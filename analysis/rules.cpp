#include <algorithm>
#include <utility>

#include "analysis/rules/rule_run.h"
#include "analysis/rules/suppress.h"

namespace rung {
namespace {

constexpr const Rule* kRules[] = {
#define RUNG_RULE(ident) &ident,
#include "analysis/rules/rules.def"
#undef RUNG_RULE
};

bool says_the_same(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && a.where == b.where && a.message == b.message;
}

}  // namespace

std::span<const Rule* const> all_rules() { return kRules; }

const Rule* find_rule(std::string_view code_or_name) {
  for (const Rule* rule : kRules) {
    if (rule->code == code_or_name || rule->name == code_or_name) return rule;
  }
  return nullptr;
}

RuleSummary run_rules(const RuleContext& context, DiagnosticSink& sink,
                      const RuleBudget& budget) {
  DiagnosticList found;
  RuleRun run(context, found, budget);
  for (const Rule* rule : kRules) {
    if (context.rules.is_on(*rule)) run.check(*rule);
  }
  const RuleSummary summary = run.decide();
  std::vector<Diagnostic> findings = suppress(context, found.take());
  sort_diagnostics(findings);
  // A reader may put one statement into the program several times.
  findings.erase(std::unique(findings.begin(), findings.end(), says_the_same),
                 findings.end());
  for (Diagnostic& finding : findings) sink.report(std::move(finding));
  return summary;
}

}  // namespace rung
