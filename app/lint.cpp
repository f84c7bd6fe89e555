#include "app/lint.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/fixes/fixes.h"
#include "analysis/rule.h"
#include "smt/oracle.h"

namespace rung {

void lint(const SourceSet& sources, const Program& program, FileReport& report,
          const VerifyOptions& options, const RuleSelection& rules) {
  TransitionSystem ts = build_transition_system(program);
  PropertySet assumptions;
  assumptions.assumptions = report.properties.assumptions;
  make_obligations(program, assumptions, ts);  // adds the constraints
  OracleOptions oracle_options;
  oracle_options.self_check = options.self_check;
  oracle_options.seconds =
      std::min(oracle_options.seconds, options.budget.seconds);
  SolverOracle oracle(program, ts, oracle_options);
  DiagnosticList found;
  const RuleSummary summary = run_rules(
      {sources, program, report.properties, ts, &oracle, rules}, found);
  take_findings(found.take(), report);
  offer_fixes(sources, program, report.findings);
  if (summary.undecided > 0) {
    report.notes.push_back(fmt::format(
        "{} of the {} questions of the solver-decided rules are left open, and "
        "nothing is claimed there: {}",
        summary.undecided, summary.asked,
        summary.too_large ? "the program is too large to ask them"
                          : "what lint spends on a program did not suffice"));
  }
}

}  // namespace rung
