#include "smt/portfolio.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_set>

#include "smt/register_classes.h"

namespace rung {
namespace {

std::vector<ExprId> terms(const std::vector<Target*>& targets) {
  std::vector<ExprId> result;
  result.reserve(targets.size());
  for (const Target* target : targets) result.push_back(target->term);
  return result;
}

/// Queries that make one run of the bounded search shorter and calmer.
constexpr std::uint32_t kMinimiseQueries = 300;
constexpr std::int64_t kMinimiseConflicts = 2000;
constexpr std::uint32_t kPreludeSteps = 500;  // of random runs
constexpr std::uint32_t kFirstRounds = 3;
constexpr std::uint32_t kSimulated = 48;

}  // namespace

Portfolio::Portfolio(TransitionSystem& ts, const std::vector<ExprId>& growth,
                     std::vector<Target*> targets,
                     const PortfolioOptions& options)
    : ts_(ts),
      targets_(std::move(targets)),
      options_(options),
      cone_(ts, terms(targets_)),
      growth_(growth) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i]->purpose != Target::Purpose::Fault) continue;
    faults_.push_back(targets_[i]->term);
    fault_ = cone_.circuit().aig().disjunction(fault_, cone_.roots()[i]);
  }
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i]->status != Target::Status::Unreachable) continue;
    known_.conditions.push_back(aig_not(cone_.roots()[i]));
    known_.k = std::max(known_.k, targets_[i]->k);
    invariant_.conditions.push_back(targets_[i]->never);
  }
  invariant_.k = known_.k;
}

const JumpCircuit& Portfolio::jump() {
  if (jump_ == nullptr) jump_ = std::make_unique<JumpCircuit>(cone_, growth_);
  return *jump_;
}

/// Targets that may be unreachable, for all that is known.
bool Portfolio::any_doubtful() const {
  return std::any_of(targets_.begin(), targets_.end(),
                     [](const Target* t) { return t->doubtful(); });
}

/// Runs to faults are not searched for.
bool Portfolio::is_sought(const Target& target, Sought what) const {
  return target.status == Target::Status::Open &&
         target.purpose != Target::Purpose::Fault &&
         (what == Sought::All || target.hidden == (what == Sought::Hidden));
}

bool Portfolio::any_sought(Sought what) const {
  return std::any_of(targets_.begin(), targets_.end(),
                     [&](const Target* t) { return is_sought(*t, what); });
}

std::vector<Target*> Portfolio::sought(Sought what,
                                       std::vector<AigLit>& goals) const {
  std::vector<Target*> of;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (!is_sought(*targets_[i], what)) continue;
    goals.push_back(cone_.roots()[i]);
    of.push_back(targets_[i]);
  }
  return of;
}

void Portfolio::unreachable(std::size_t i, std::string_view engine) {
  Target& target = *targets_[i];
  target.status = Target::Status::Unreachable;
  target.engine = engine;
  known_.conditions.push_back(aig_not(cone_.roots()[i]));
  invariant_.conditions.push_back(target.never);
}

void Portfolio::structural() {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i]->status != Target::Status::Open) continue;
    if (cone_.roots()[i] == kAigFalse) unreachable(i, "structural");
  }
}

void Portfolio::induction(std::uint32_t k, bool all,
                          const InductionLimits& limits) {
  learn({}, k, all, limits);
}

/// What is known already need not be shown again.
std::vector<Candidate> Portfolio::guesses(Templates::Constants constants,
                                          Templates::Reach reach) {
  const std::unordered_set<AigLit> known(known_.lemmas.begin(),
                                         known_.lemmas.end());
  std::vector<Candidate> candidates = templates_->candidates(constants, reach);
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return known.count(candidate.signal) != 0;
  });
  return candidates;
}

/// Joint induction over the open targets (without `all`, over those hoped to
/// be unreachable) and `lemmas`; what survives is known from then on.
void Portfolio::learn(std::vector<Candidate> lemmas, std::uint32_t k, bool all,
                      const InductionLimits& limits) {
  Candidates candidates;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = *targets_[i];
    const bool hoped = target.purpose == Target::Purpose::Violation ||
                       target.purpose == Target::Purpose::Fault;
    if (!target.doubtful()) continue;
    if (!hoped && !all) continue;
    candidates.conditions.push_back(aig_not(cone_.roots()[i]));
    of.push_back(i);
  }
  if (of.empty()) return;
  for (const Candidate& lemma : lemmas) {
    candidates.lemmas.push_back(lemma.signal);
  }
  if (!prove_by_induction(cone_, known_, k, candidates, limits,
                          *options_.deadline)) {
    return;
  }
  static constexpr std::string_view kNames[] = {
      "induction k=0", "induction k=1", "induction k=2",
      "induction k=3", "induction k=4", "induction k=5",
      "induction k=6", "induction k=7", "induction k=8"};
  bool any = false;
  for (std::size_t i = 0; i < lemmas.size(); ++i) {
    if (!candidates.lemma_holds[i]) continue;
    known_.lemmas.push_back(lemmas[i].signal);
    invariant_.lemmas.push_back(std::move(lemmas[i].clause));
    any = true;
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!candidates.condition_holds[i]) continue;
    unreachable(of[i], kNames[std::min<std::uint32_t>(k, 8)]);
    targets_[of[i]]->k = k;
    any = true;
  }
  if (any) known_.k = std::max(known_.k, k);
  invariant_.k = known_.k;
}

/// Random runs: what they meet is reachable, and they are the samples that
/// templates are filtered by.
void Portfolio::simulate(std::uint32_t steps, bool sample, Sought wanted) {
  std::vector<std::int64_t> first = first_inputs(cone_, *options_.deadline);
  if (first.empty() && !cone_.inputs().empty()) return;
  simulation_ = std::make_unique<Simulation>(cone_, &jump(), fault_,
                                             std::move(first), options_.seed);
  if (sample) {
    templates_ = std::make_unique<Templates>(ts_, cone_, terms(targets_));
  }
  for (Target* target : targets_) target->hit = {};
  std::uint32_t idle = 0;  // steps that met nothing new
  for (std::uint32_t i = 0; i < steps && !out_of_time(); ++i) {
    simulation_->step();
    if (sample) templates_->sample(*simulation_);
    idle = note_hits() || simulation_->news() ? 0 : idle + 1;
    if (!sample && idle >= idle_steps(wanted)) break;
  }
}

/// More steps of the same runs while some of `wanted` was not met.
void Portfolio::simulate_on(Sought wanted) {
  constexpr std::uint32_t kMost = 400;
  constexpr std::size_t kGates = 20'000'000;  // evaluated in all
  if (simulation_ == nullptr) return;
  const std::size_t steps = std::min<std::size_t>(
      kMost, kGates / std::max<std::size_t>(cone_.circuit().aig().size(), 1));
  const auto open = [&](const Target* t) {
    return t->hit.step == 0 && is_sought(*t, wanted);
  };
  for (std::size_t i = 0; i < steps && !out_of_time(); ++i) {
    if (std::none_of(targets_.begin(), targets_.end(), open)) return;
    simulation_->step();
    note_hits();
  }
}

/// Which targets does the last scan meet? Is one met for the first time?
bool Portfolio::note_hits() {
  bool first = false;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const std::uint64_t lanes = simulation_->value(cone_.roots()[i]);
    if (lanes == 0) continue;
    Target& target = *targets_[i];
    first = first || !target.met;
    target.met = true;
    if (target.hit.step == 0) {
      target.hit.step = simulation_->steps();
      target.hit.lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
    }
    if (simulation_->steps() <= RandomHit::kFirstSteps) {
      target.hit.lanes |= lanes & ~Simulation::kGuided;
    }
  }
  return first;
}

/// Steps without news after which there is little hope to meet `wanted`: fewer
/// when each is dear.
std::uint32_t Portfolio::idle_steps(Sought wanted) {
  constexpr std::uint32_t kFew = 20;
  constexpr std::size_t kGates = 2'000'000;  // evaluated in all
  const bool hoping = std::any_of(
      targets_.begin(), targets_.end(),
      [&](const Target* t) { return t->doubtful() && is_sought(*t, wanted); });
  if (!hoping) return kFew;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(
      kGates / std::max<std::size_t>(cone_.circuit().aig().size(), 1), kFew,
      100));
}

/// Runs of the simulation, of more than `steps`, for what the bounded search
/// finds too hard.
void Portfolio::take_hits(Sought what, std::uint32_t steps) {
  if (simulation_ == nullptr) return;
  for (Target* target : targets_) {
    if (!is_sought(*target, what)) continue;
    if (target->hit.step <= steps) continue;
    Run run = simulation_->run(target->hit.step, target->hit.lane);
    const std::uint32_t hit =
        first_hit(cone_, run, target->term, faults_, stretches());
    if (hit == 0) continue;
    run.resize(hit);
    run.back().delta = 0;
    target->status = Target::Status::Reached;
    target->engine = "simulation";
    target->run = {cone_.inputs(), std::move(run)};
  }
}

/// States that are equal throughout, and targets that are unreachable then.
void Portfolio::correspond() {
  if (templates_ == nullptr) return;
  std::vector<AigLit> goals;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (!targets_[i]->doubtful()) continue;
    goals.push_back(cone_.roots()[i]);
    of.push_back(i);
  }
  const RegisterClasses classes = register_classes(
      cone_, known_, templates_->signatures(), goals, *options_.deadline);
  std::unordered_set<AigLit> known(known_.lemmas.begin(), known_.lemmas.end());
  for (const auto& [x, y] : classes.equal) {
    const ExprId equal = ts_.exprs.equal(ts_.state_expr(x), ts_.state_expr(y));
    const AigLit signal = cone_.circuit().bit(equal);
    if (!known.insert(signal).second) continue;
    known_.lemmas.push_back(signal);
    invariant_.lemmas.push_back({{equal, {}, 0, false}});
  }
  for (std::size_t i = 0; i < classes.unreachable.size(); ++i) {
    if (classes.unreachable[i]) unreachable(of[i], "correspondence");
  }
}

/// From what is cheap and often enough to all there is. The last round of each
/// reach is for what a scan hands on by the next one only: a phase begins, and
/// its timer a scan later.
void Portfolio::guess_lemmas(Effort effort) {
  using Constants = Templates::Constants;
  struct Round {
    Templates::Reach reach;
    Constants constants;
    std::uint32_t k;
  };
  static constexpr Round kEarly[] = {
      {Templates::Reach::Near, Constants::Alone, 0},
      {Templates::Reach::Near, Constants::Pairs, 0},
  };
  static constexpr Round kLate[] = {
      {Templates::Reach::Near, Constants::Alone, 1},
      {Templates::Reach::Far, Constants::Alone, 0},
      {Templates::Reach::Far, Constants::Pairs, 0},
      {Templates::Reach::Far, Constants::Alone, 1},
  };
  if (templates_ == nullptr) return;
  const auto go = [&](const Round& round) {
    if (!any_doubtful() || out_of_time()) return;
    learn(guesses(round.constants, round.reach), round.k, true, {});
    if (round.constants == Constants::Pairs) correspond();
  };
  if (effort == Effort::Little) {
    for (const Round& round : kEarly) go(round);
    return;
  }
  for (const Round& round : kLate) go(round);
  templates_.reset();
}

void Portfolio::found(Target& target, Run run) {
  target.status = Target::Status::Reached;
  target.engine = search_jumps_ && jump().useful() ? "bmc+jump" : "bmc";
  target.run = {cone_.inputs(), std::move(run)};
}

/// One step deeper; false when a limit was reached.
bool Portfolio::search_depth(Sought what, std::int64_t conflicts) {
  if (search_ == nullptr) {
    search_ = std::make_unique<BoundedSearch>(
        cone_, search_jumps_ ? &jump() : nullptr, fault_, *options_.deadline);
  }
  const std::uint32_t depth = depth_ + 1;
  for (;;) {
    std::vector<AigLit> goals;
    const std::vector<Target*> of = sought(what, goals);
    BoundedSearch::Result result = search_->search(depth, goals, conflicts);
    if (result.answer == BoundedSearch::Answer::Unknown) return false;
    if (result.answer == BoundedSearch::Answer::None) {
      for (Target* target : of) target->bound = depth;
      depth_ = depth;
      return true;
    }
    Target& target = *of[result.target];
    if (!target.hidden) search_->minimise(result, kMinimiseQueries);
    if (!reaches(cone_, result.run, target.term, faults_, stretches())) {
      // A stretch stood for scans that it is not: do without any.
      search_jumps_ = false;
      search_.reset();
      depth_ = 0;
      return true;
    }
    found(target, std::move(result.run));
    if (!any_sought(what)) return true;
  }
}

void Portfolio::search(Sought what, std::uint32_t depth,
                       std::int64_t conflicts) {
  while (depth_ < std::min(depth, options_.max_depth) && !out_of_time()) {
    if (!any_sought(what) || !search_depth(what, conflicts)) return;
  }
}

/// Any run to what nobody sees, however long: far cheaper than the shortest.
void Portfolio::search_hidden(std::uint32_t depth, std::int64_t conflicts) {
  if (!search_jumps_ || !any_sought(Sought::Hidden)) return;
  BoundedSearch any_run(cone_, &jump(), fault_, *options_.deadline);
  while (!out_of_time()) {
    std::vector<AigLit> goals;
    const std::vector<Target*> of = sought(Sought::Hidden, goals);
    const BoundedSearch::Result result =
        any_run.search_within(depth, goals, conflicts);
    if (result.answer != BoundedSearch::Answer::Found) return;
    // One run may meet several.
    bool met = false;
    for (Target* target : of) {
      const std::uint32_t steps =
          first_hit(cone_, result.run, target->term, faults_, stretches());
      if (steps == 0) continue;
      Run run(result.run.begin(), result.run.begin() + steps);
      run.back().delta = 0;
      found(*target, std::move(run));
      met = true;
    }
    if (!met || !any_sought(Sought::Hidden)) return;
  }
}

/// How deep to search for what the simulation has runs to already: a shorter
/// run is nicer, but each step more takes another pass over all before it.
std::uint32_t Portfolio::worthwhile_depth() const {
  constexpr double kGates = 2e5;  // visited in all
  const bool all_met =
      uses("simulation") &&
      std::all_of(targets_.begin(), targets_.end(), [&](const Target* t) {
        return !is_sought(*t, Sought::Shown) || t->hit.step != 0;
      });
  if (!all_met) return options_.max_depth;
  const auto size = static_cast<double>(cone_.circuit().aig().size());
  return std::clamp<std::uint32_t>(
      static_cast<std::uint32_t>(std::sqrt(2 * kGates / size)), 8,
      options_.max_depth);
}

/// From the first scan on when some target was left out so far: its bound is
/// of every length below.
void Portfolio::search_all_again() {
  if (any_sought(Sought::Hidden)) depth_ = 0;
}

void Portfolio::property_directed(const PdrLimits& limits) {
  if (signals_.empty()) signals_ = pdr_signals(ts_, cone_);
  for (std::size_t i = 0; i < targets_.size() && !out_of_time(); ++i) {
    Target& target = *targets_[i];
    if (!target.doubtful()) continue;
    PdrResult result = property_directed_reachability(
        cone_, signals_, known_, cone_.roots()[i], limits, *options_.deadline);
    const bool fault = target.purpose == Target::Purpose::Fault;
    if (result.answer == PdrResult::Answer::Unreachable) {
      for (LemmaClause& lemma : result.lemmas) {
        known_.lemmas.push_back(signal_of(cone_, lemma));
        invariant_.lemmas.push_back(std::move(lemma));
      }
      unreachable(i, "pdr");
    } else if (result.answer == PdrResult::Answer::Reachable && !fault &&
               reaches(cone_, result.run, target.term, faults_, stretches())) {
      target.status = Target::Status::Reached;
      target.engine = "pdr";
      target.run = {cone_.inputs(), std::move(result.run)};
    }
  }
}

/// Leaves out lemmas that no proof needs.
void Portfolio::minimise() {
  if (invariant_.lemmas.empty()) return;
  const std::vector<bool> needed =
      needed_lemmas(cone_, known_, kMinimiseConflicts, *options_.deadline);
  std::vector<LemmaClause> kept;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i]) kept.push_back(std::move(invariant_.lemmas[i]));
  }
  invariant_.lemmas = std::move(kept);
}

void Portfolio::prelude() {
  structural();
  if (uses("simulation") && any_sought(Sought::All))
    simulate(kPreludeSteps, false, Sought::Hidden);
}

void Portfolio::sketch() {
  constexpr std::uint32_t kShallow = 3;  // where a search beats random runs
  structural();
  induction(0, false, {20000, kFirstRounds});
  induction(1, false, {});
  if (any_sought(Sought::All)) simulate(kPreludeSteps, false, Sought::All);
  for (Target* target : targets_) {
    if (!target->met || !is_sought(*target, Sought::Hidden)) continue;
    target->status = Target::Status::Reached;
    target->engine = "simulation";
  }
  search(Sought::Shown, kShallow, 2000);
  take_hits(Sought::All, options_.max_depth);
  search(Sought::Shown, options_.max_depth, 2000);
  take_hits(Sought::All, 0);
  minimise();
}

void Portfolio::run() {
  structural();
  if (uses("induction")) induction(0, false, {20000, kFirstRounds});
  if (uses("induction")) induction(1, false, {});
  if (any_sought(Sought::All))
    simulate(kSimulated, any_doubtful(), Sought::Hidden);
  if (uses("simulation")) simulate_on(Sought::All);
  if (uses("simulation")) take_hits(Sought::Hidden, 0);
  if (uses("induction") && any_doubtful()) correspond();
  if (uses("bmc")) search(Sought::Shown, 4, 100);
  if (uses("induction") && any_doubtful()) guess_lemmas(Effort::Little);
  if (uses("bmc")) search(Sought::Shown, 8, 2000);
  if (uses("bmc")) search(Sought::Shown, worthwhile_depth(), 500);
  if (uses("simulation")) take_hits(Sought::Shown, 0);
  if (uses("bmc")) search_hidden(8, 2000);
  if (uses("bmc")) search_hidden(24, 2000);
  if (uses("pdr") && any_doubtful()) property_directed({500, 1000});
  if (uses("induction") && any_doubtful()) guess_lemmas(Effort::Much);
  if (uses("pdr") && any_doubtful()) property_directed({5000, 5000});
  for (std::uint32_t k = 1; uses("induction") && k <= 8; ++k) {
    if (any_doubtful() && !out_of_time()) induction(k, true, {5000, 1000});
  }
  search_all_again();
  if (uses("bmc")) search(Sought::All, kSimulated, 5000);
  if (uses("simulation")) take_hits(Sought::All, 0);
  if (uses("bmc")) search(Sought::All, options_.max_depth, 50000);
  if (uses("pdr") && any_doubtful()) property_directed({100000, 50000});
  minimise();
}

}  // namespace rung
