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
    run.ask(
        RuleRun::Want::Proof,
        {exprs.negation(run.ts.call_value[id.index()]),
         exprs.negation(run.ts.call_executed[id.index()]),
         exprs.negation(run.ts.node_value[call.arguments[0]])},
        [id, report](RuleRun& now, std::span<const RuleRun::Evidence> answers) {
          if (answers[0].answer != RuleRun::Answer::Yes ||
              answers[1].answer != RuleRun::Answer::No) {
            return;
          }
          const InstanceId instance = now.program.calls[id].instance;
          const bool dead = answers[2].answer == RuleRun::Answer::Yes;
          report(now, {id, quoted(now.program.instances[instance].name),
                       dead ? ": its input is never true" : "",
                       proof_text(answers[0])});
        });
  }
}

}  // namespace rung
