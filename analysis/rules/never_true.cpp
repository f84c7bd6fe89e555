#include "analysis/rules/never_true.h"

#include <utility>

#include "analysis/rules/support.h"

namespace rung {

void ask_never_true(
    RuleRun& run, ElementFamily family,
    const std::function<void(RuleRun&, const NeverTrue&)>& report) {
  ExprArena& exprs = run.ts.exprs;
  for (const CallId id : ids_of(run.program.calls)) {
    const ElementCall& call = run.program.calls[id];
    if (call.operation->resets || call.arguments.empty() ||
        run.program.instances[call.instance].kind->family != family) {
      continue;
    }
    const ExprId input = run.ts.node_value[call.arguments[0]];
    const bool may_pulse =
        run.has_oracle && family == ElementFamily::Timer && call.parameter > 0;
    const ExprId stays =
        may_pulse ? exprs.conjunction(input, run.past.previous(input))
                  : exprs.bit(true);
    run.ask(
        RuleRun::Want::Proof,
        {exprs.negation(run.ts.call_value[id.index()]),
         exprs.negation(run.ts.call_executed[id.index()]),
         exprs.negation(input), exprs.negation(stays)},
        [id, report](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
          if (answers[0].answer != RuleRun::Answer::Yes ||
              answers[1].answer != RuleRun::Answer::No) {
            return;
          }
          const InstanceId instance = now.program.calls[id].instance;
          std::string reason;
          if (answers[2].answer == RuleRun::Answer::Yes) {
            reason = ": its input is never true";
          } else if (answers[3].answer == RuleRun::Answer::Yes) {
            reason = ": its input is true for one scan at a time";
          }
          report(now, {id, quoted(now.program.instances[instance].name), reason,
                       proof_text(answers[0])});
        });
  }
}

}  // namespace rung
