#include "smt/verify.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "smt/alike.h"
#include "smt/attempt.h"
#include "smt/certificate.h"
#include "smt/merged_run.h"
#include "smt/partition.h"
#include "smt/portfolio.h"
#include "smt/recovery_answers.h"
#include "smt/recurrence_answers.h"
#include "smt/side_by_side.h"
#include "smt/verdicts.h"

namespace rung {
namespace {

/// Is there a first scan that the assumptions allow?
bool satisfiable(const TransitionSystem& ts, const Deadline& deadline) {
  if (ts.constraints.empty()) return true;
  Cone cone(ts, {});
  Unrolling frames(cone.circuit().aig(), cone.bits(),
                   Unrolling::Start::Initial);
  Sat sat(&deadline);
  AigClauses clauses(frames.aig(), sat);
  clauses.require(frames.at(0, cone.constraint()));
  return sat.solve() != SatAnswer::Unsat;
}

class Verifier {
 public:
  Verifier(const Program& program, const PropertySet& properties,
           const VerifyOptions& options, TransitionSystem ts)
      : program_(program),
        properties_(properties),
        options_(options),
        deadline_(options.budget.seconds, options.budget.stop),
        ts_(std::move(ts)),
        questions_(make_questions(program, properties, options.wanted, ts_)),
        growth_(growth_terms(ts_)),
        parts_(partition(ts_, terms(questions_.targets))),
        alike_(ts_, questions_.targets, parts_),
        decided_(parts_.size()),
        twin_(questions_.targets.size()),
        rungs_(program.rungs.size()),
        verdicts_(program, properties, ts_, questions_, options) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::vector<std::size_t>& model = parts_[alike_.model(i)];
      for (std::size_t j = 0; j < model.size(); ++j) {
        twin_[parts_[i][j]] = model[j];
      }
    }
  }

  VerifyReport run() {
    bool any_run = true;
    attempt([&] { any_run = satisfiable(ts_, deadline_); });
    if (!any_run) return verdicts_.no_run_at_all();
    // What is not done here is done by the engines, or later.
    const std::string failure = attempt([&] { prelude(); });
    if (!failure.empty()) forget();
    decide_models();
    for (std::size_t i = 0; i < parts_.size(); ++i) conclude(i);
    recover_all();
    respond_all();
    if (options_.self_check) attempt([&] { replay_found(); });
    return verdicts_.report();
  }

 private:
  static std::vector<ExprId> terms(const std::vector<Target>& targets) {
    std::vector<ExprId> result;
    result.reserve(targets.size());
    for (const Target& target : targets) result.push_back(target.term);
    return result;
  }

  void progress(std::size_t done, std::size_t all) {
    options_.progress("proving: part " + std::to_string(done + 1) + " of " +
                      std::to_string(all));
  }

  PortfolioOptions portfolio_options() const {
    return {options_.engine, options_.budget.max_depth, &deadline_,
            options_.seed};
  }

  /// All targets at once, of parts that are alike those of the first; runs
  /// that nobody sees are taken from random ones.
  void prelude() {
    std::vector<Target*> targets;
    for (std::size_t i = 0; i < twin_.size(); ++i) {
      if (twin_[i] == i) targets.push_back(&questions_.targets[i]);
    }
    Portfolio all(ts_, growth_, std::move(targets), portfolio_options());
    all.prelude();
    if (all.cone().circuit().overflow()) return forget();
    if (all.simulation() == nullptr) return;
    confirm(all);
  }

  /// Somewhere a term has no exact encoding: its part will say so, and the
  /// others are decided without it.
  void forget() {
    for (Target& target : questions_.targets) {
      target.status = Target::Status::Open;
      target.met = false;
      target.hit = {};
    }
  }

  static void reached_by_chance(Target& target) {
    target.status = Target::Status::Reached;
    target.engine = "simulation";
  }

  /// Replays random runs that meet what has no run to show: first the few that
  /// meet most of it, then one for each of the rest.
  void confirm(const Portfolio& all) {
    const Simulation& random = *all.simulation();
    std::vector<Claim> open = claims();
    std::uint64_t scans = 0;
    const auto try_run = [&](Run run, const std::vector<Claim>& tried) {
      scans += scan_count(run, ts_.scan);
      if (scans > confirming_scans()) return;
      const FoundRun found = {all.cone().inputs(), std::move(run)};
      verdicts_.replay_together(alike_.in_all(found), tried);
      for (const Claim& claim : tried) {
        Target& target = questions_.targets[verdicts_.target_of(claim)];
        if (verdicts_.is_confirmed(claim)) reached_by_chance(target);
      }
    };
    const std::uint32_t first =
        std::min(RandomHit::kFirstSteps, random.steps());
    for (int runs = 0; runs < kConfirmingRuns && !open.empty(); ++runs) {
      const std::uint32_t lane = most_hits(open);
      const auto rest = std::stable_partition(
          open.begin(), open.end(), [&](const Claim& claim) {
            return (hit(claim).lanes >> lane & 1U) == 0;
          });
      if (rest == open.end()) break;
      try_run(random.run(first, lane), {rest, open.end()});
      open.erase(rest, open.end());
    }
    // The longest first: it may meet what others do.
    std::stable_sort(open.begin(), open.end(),
                     [&](const Claim& a, const Claim& b) {
                       return hit(a).step > hit(b).step;
                     });
    const auto confirmed = [&](const Claim& claim) {
      return verdicts_.is_confirmed(claim);
    };
    std::erase_if(open, confirmed);
    while (!open.empty() && scans <= confirming_scans()) {
      const RandomHit longest = hit(open.front());
      try_run(random.run(longest.step, longest.lane), open);
      std::erase_if(open, [&](const Claim& claim) {
        const RandomHit& own = hit(claim);
        return confirmed(claim) ||
               (own.step == longest.step && own.lane == longest.lane);
      });
    }
  }

  /// Goals and triggers that a random run met and that nobody sees a run of.
  /// A trigger that several obligations share is claimed once.
  std::vector<Claim> claims() const {
    std::vector<Claim> result;
    std::vector<bool> claimed(questions_.targets.size(), false);
    const auto claim = [&](std::size_t target, const Claim& one) {
      if (target == Questions::kNone) return;
      const Target& asked = questions_.targets[twin_[target]];
      if (!asked.hidden || asked.hit.step == 0) return;
      if (one.trigger && claimed[target]) return;
      claimed[target] = true;
      result.push_back(one);
    };
    for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
      claim(questions_.goal[i], {i, false});
    }
    for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
      claim(questions_.trigger[i], {i, true});
    }
    return result;
  }

  const RandomHit& hit(const Claim& claim) const {
    return questions_.targets[twin_[verdicts_.target_of(claim)]].hit;
  }

  std::uint32_t most_hits(const std::vector<Claim>& claims) const {
    std::array<std::size_t, Lanes::kCount> count{};
    for (const Claim& claim : claims) {
      for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
        count[lane] += hit(claim).lanes >> lane & 1U;
      }
    }
    return static_cast<std::uint32_t>(
        std::max_element(count.begin(), count.end()) - count.begin());
  }

  /// All parts that are like none before them.
  void decide_models() {
    std::vector<std::size_t> models;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (alike_.model(i) == i) models.push_back(i);
    }
    decide_by_engines(models);
  }

  void decide_by_engines(const std::vector<std::size_t>& parts) {
    std::vector<std::size_t> open;
    std::vector<std::vector<Target*>> groups;
    for (const std::size_t part : parts) {
      std::vector<Target*> targets;
      bool any_open = false;
      for (const std::size_t i : parts_[part]) {
        Target& target = questions_.targets[i];
        targets.push_back(&target);
        any_open = any_open || target.status == Target::Status::Open;
      }
      if (any_open) {
        open.push_back(part);
        groups.push_back(std::move(targets));
      } else {
        decided_[part].invariant = shown_by_structure(targets);
      }
    }
    std::vector<GroupAnswer> answers =
        decide_side_by_side(ts_, growth_, groups, portfolio_options(),
                            options_.jobs, [&](std::size_t group) {
                              if (options_.progress)
                                progress(open[group], parts_.size());
                            });
    for (std::size_t i = 0; i < open.size(); ++i) {
      decided_[open[i]] = std::move(answers[i]);
    }
  }

  static Invariant shown_by_structure(const std::vector<Target*>& targets) {
    Invariant invariant;
    for (const Target* target : targets) {
      if (target->status != Target::Status::Unreachable) continue;
      invariant.k = std::max(invariant.k, target->k);
      invariant.conditions.push_back(target->never);
    }
    return invariant;
  }

  void conclude(std::size_t part) {
    GroupAnswer as_model;
    const bool is_model = alike_.model(part) == part;
    const bool alike = !is_model && decide_like_model(part, as_model);
    if (!is_model && !alike) decide_by_engines({part});
    const GroupAnswer& made = alike ? as_model : decided_[part];
    const double share =
        made.milliseconds / static_cast<double>(parts_[part].size());
    verdicts_.decided(parts_[part], made.invariant, made.overflow, share);
  }

  /// False when a run of random inputs that its model met a target by, and that
  /// was not kept, was not one for it.
  bool decide_like_model(std::size_t part, GroupAnswer& made) {
    const std::size_t model = alike_.model(part);
    for (std::size_t i : parts_[part]) {
      const Target& from = questions_.targets[twin_[i]];
      const bool by_chance =
          from.status == Target::Status::Reached && from.run.steps.empty();
      if (by_chance && questions_.targets[i].status != Target::Status::Reached)
        return false;
    }
    Renaming names(ts_, alike_.terms(model), alike_.terms(part));
    for (std::size_t i : parts_[part]) {
      const Target& from = questions_.targets[twin_[i]];
      Target& target = questions_.targets[i];
      if (target.status != Target::Status::Open) continue;
      target.status = from.status;
      target.engine = from.engine;
      target.k = from.k;
      target.bound = from.bound;
      target.failure = from.failure;
      target.run = names.run(from.run);
    }
    made.invariant = names.invariant(decided_[model].invariant);
    made.overflow = decided_[model].overflow;
    return true;
  }

  void recover_all() {
    std::vector<ExprId> goals;
    for (const Obligation& obligation : questions_.obligations) {
      if (obligation.goal == Goal::Recover) {
        goals.push_back(obligation.condition);
      }
    }
    if (goals.empty()) return;
    if (options_.progress) options_.progress("proving: ways back");
    RecoveryAnswers answers(program_, properties_, ts_, options_);
    answers.search(goals, growth_, portfolio_options());
    for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
      const Obligation& obligation = questions_.obligations[i];
      if (obligation.goal != Goal::Recover) continue;
      verdicts_.answered(i, answers.answer(obligation));
    }
  }

  /// First what is quick, so that one that is hard takes no time from others.
  void respond_all() {
    RecurrenceAnswers answers(program_, properties_, ts_, options_);
    std::set<std::size_t> open;  // obligations
    for (const Patience patience : {Patience::Short, Patience::Long}) {
      for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
        const Obligation& obligation = questions_.obligations[i];
        if (obligation.goal != Goal::Respond) continue;
        const bool again = patience == Patience::Long;
        if (again && open.count(i) == 0) continue;
        if (options_.progress) options_.progress("proving: what comes again");
        CheckedAnswer answer =
            answers.answer(obligation, patience, portfolio_options());
        const bool is_open =
            answer.result.verdict == Verdict::Unknown && answer.failure.empty();
        if (is_open && !again) {
          open.insert(i);
        } else {
          verdicts_.answered(i, std::move(answer));
        }
      }
    }
  }

  struct Bundle {  // of runs that are replayed as one
    MergedRun run;
    std::vector<Claim> claims;
  };

  /// Runs that engines found and that nobody sees, many at once: else the
  /// whole plant is executed for each of its parts.
  void replay_found() {
    std::map<std::vector<std::int64_t>, Bundle> bundles;  // by beats_of()
    const auto add = [&](std::size_t target, const Claim& claim) {
      if (target == Questions::kNone) return;
      const Target& found = questions_.targets[target];
      if (!found.hidden || found.run.steps.empty()) return;
      if (verdicts_.is_confirmed(claim)) return;
      Bundle& bundle = bundles[beats_of(ts_, found.run)];
      if (!bundle.run.add(ts_, found.run)) {
        replay(bundle);
        bundle = {};
        bundle.run.add(ts_, found.run);
      }
      bundle.claims.push_back(claim);
    };
    for (std::size_t i = 0; i < questions_.obligations.size(); ++i) {
      add(questions_.goal[i], {i, false});
      add(questions_.trigger[i], {i, true});
    }
    for (const auto& [beats, bundle] : bundles) replay(bundle);
  }

  void replay(const Bundle& bundle) {
    verdicts_.replay_together(bundle.run.run(), bundle.claims);
  }

  std::uint64_t confirming_scans() const {
    constexpr std::uint64_t kMost = 2'000'000;
    constexpr std::uint64_t kRungs = 200'000'000;  // executed in all
    return std::min(kMost, kRungs / std::max<std::uint64_t>(rungs_, 1));
  }

  static constexpr int kConfirmingRuns = 16;  // that serve many

  const Program& program_;
  const PropertySet& properties_;
  const VerifyOptions& options_;
  Deadline deadline_;
  TransitionSystem ts_;
  Questions questions_;
  std::vector<ExprId> growth_;
  std::vector<std::vector<std::size_t>> parts_;  // of targets
  AlikeParts alike_;
  std::vector<GroupAnswer> decided_;  // by part; of models
  std::vector<std::size_t> twin_;     // by target: that of the model
  std::size_t rungs_;
  Verdicts verdicts_;
};

bool asks_what_settles(const PropertySet& properties,
                       const VerifyOptions& options) {
  const auto asks = [&](const Property& property) {
    return property.form == Property::Form::Settles &&
           (!options.wanted || options.wanted(property.name));
  };
  return std::any_of(properties.properties.begin(), properties.properties.end(),
                     asks);
}

/// Results stay in the order of their properties.
void add(VerifyReport& report, VerifyReport more) {
  const auto move_behind = [](auto from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()),
              std::make_move_iterator(from.end()));
  };
  move_behind(std::move(more.results), report.results);
  move_behind(std::move(more.failures), report.failures);
  std::stable_sort(report.results.begin(), report.results.end(),
                   [](const ObligationResult& a, const ObligationResult& b) {
                     return a.obligation.property < b.obligation.property;
                   });
}

}  // namespace

VerifyReport verify(const Program& program, const PropertySet& properties,
                    const VerifyOptions& options) {
  VerifyReport report =
      Verifier(program, properties, options, build_transition_system(program))
          .run();
  if (asks_what_settles(properties, options)) {
    add(report,
        Verifier(program, properties, options, build_freezing_system(program))
            .run());
  }
  return report;
}

const std::vector<EngineInfo>& engines() {
  static const std::vector<EngineInfo> list = {
      {"bmc", "bounded search for runs, with jumps over quiet scans"},
      {"induction", "joint k-induction, with lemmas guessed from random runs"},
      {"pdr", "property-directed reachability on bits and comparisons"},
      {"simulation", "random runs, 64 at a time, with the same jumps"},
  };
  return list;
}

std::vector<std::pair<std::string, std::string>> solver_versions() {
  return {{"z3", z3_version()}, {"cadical", sat_version()}};
}

}  // namespace rung
