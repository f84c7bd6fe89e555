#include <algorithm>
#include <unordered_map>

#include "smt/verdicts.h"

namespace rung {
namespace {

class Asker {
 public:
  Asker(TransitionSystem& ts, std::vector<Target>& targets)
      : ts_(ts), targets_(targets) {}

  std::size_t ask(ExprId term, Target::Purpose purpose, bool hidden) {
    const auto [entry, is_new] = asked_.try_emplace(term, targets_.size());
    if (is_new) {
      Target target;
      target.term = term;
      target.never = ts_.exprs.negation(term);
      target.purpose = purpose;
      target.hidden = true;
      targets_.push_back(std::move(target));
    }
    // Asked for several purposes, it serves the strictest.
    Target& target = targets_[entry->second];
    target.hidden = target.hidden && hidden;
    target.purpose = std::max(target.purpose, purpose);
    return entry->second;
  }

 private:
  TransitionSystem& ts_;
  std::vector<Target>& targets_;
  std::unordered_map<ExprId, std::size_t> asked_;
};

std::size_t ask_trigger(Asker& asker, const Obligation& obligation) {
  if (!obligation.trigger.has_value()) return Questions::kNone;
  return asker.ask(obligation.trigger, Target::Purpose::Trigger, true);
}

}  // namespace

bool shows_run(const Obligation& obligation) {
  return obligation.goal != Goal::Reach || obligation.kind == "reach";
}

Questions make_questions(const Program& program, const PropertySet& properties,
                         const std::function<bool(std::string_view)>& wanted,
                         TransitionSystem& ts) {
  Questions questions;
  questions.obligations = make_obligations(program, properties, ts);
  if (wanted) {
    std::erase_if(questions.obligations, [&](const Obligation& obligation) {
      return !wanted(obligation.name);
    });
  }
  Asker asker(ts, questions.targets);
  for (const Obligation& obligation : questions.obligations) {
    std::size_t goal = Questions::kNone;
    std::size_t trigger = Questions::kNone;
    if (obligation.goal == Goal::Reach) {
      goal = asker.ask(obligation.condition, Target::Purpose::Witness,
                       !shows_run(obligation));
    } else if (obligation.goal == Goal::Recover) {
      trigger = ask_trigger(asker, obligation);
    } else if (obligation.goal == Goal::Invariant) {
      goal = asker.ask(ts.exprs.negation(obligation.condition),
                       Target::Purpose::Violation, false);
      trigger = ask_trigger(asker, obligation);
    }
    questions.goal.push_back(goal);
    questions.trigger.push_back(trigger);
  }
  for (const Fault& fault : ts.faults) {
    questions.fault.push_back(
        asker.ask(fault.condition, Target::Purpose::Fault, true));
  }
  return questions;
}

}  // namespace rung
