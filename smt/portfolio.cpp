#include "smt/portfolio.h"

#include <algorithm>

namespace rung {
namespace {

std::vector<ExprId> terms(const std::vector<Target*>& targets) {
  std::vector<ExprId> result;
  for (const Target* target : targets) result.push_back(target->term);
  return result;
}

/// Queries that make one run of the bounded search shorter and calmer.
constexpr std::uint32_t kMinimiseQueries = 300;

}  // namespace

Portfolio::Portfolio(const TransitionSystem& ts,
                     const std::vector<ExprId>& growth,
                     std::vector<Target*> targets,
                     const PortfolioOptions& options)
    : targets_(std::move(targets)),
      options_(options),
      cone_(ts, terms(targets_)),
      jump_(cone_, growth) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i]->purpose != Target::Purpose::Fault) continue;
    fault_ = cone_.circuit().aig().disjunction(fault_, cone_.roots()[i]);
  }
}

bool Portfolio::open(Target::Purpose purpose) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const Target* t) {
    return t->purpose == purpose && t->status == Target::Status::Open;
  });
}

bool Portfolio::any_open() const {
  return std::any_of(targets_.begin(), targets_.end(), [](const Target* t) {
    return t->status == Target::Status::Open;
  });
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
    if (cone_.roots()[i] == kAigFalse) unreachable(i, "structural");
  }
}

void Portfolio::induction(std::uint32_t k, bool all, std::int64_t conflicts) {
  Candidates candidates;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = *targets_[i];
    const bool hoped = target.purpose == Target::Purpose::Violation ||
                       target.purpose == Target::Purpose::Fault;
    if (target.status != Target::Status::Open || !(hoped || all)) continue;
    candidates.conditions.push_back(aig_not(cone_.roots()[i]));
    of.push_back(i);
  }
  if (of.empty()) return;
  if (!prove_by_induction(cone_, known_, k, candidates, conflicts,
                          *options_.deadline)) {
    return;
  }
  static constexpr std::string_view kNames[] = {
      "induction k=0", "induction k=1", "induction k=2",
      "induction k=3", "induction k=4", "induction k=5",
      "induction k=6", "induction k=7", "induction k=8"};
  bool any = false;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!candidates.condition_holds[i]) continue;
    unreachable(of[i], kNames[std::min<std::uint32_t>(k, 8)]);
    any = true;
  }
  if (!any) return;
  known_.k = std::max(known_.k, k);
  invariant_.k = known_.k;
}

void Portfolio::found(Target& target, Run run) {
  target.status = Target::Status::Reached;
  target.engine = search_jumps_ && jump_.useful() ? "bmc+jump" : "bmc";
  target.run = {cone_.inputs(), std::move(run)};
}

/// One step deeper; false when a limit was reached.
bool Portfolio::search_depth(std::int64_t conflicts) {
  if (search_ == nullptr) {
    search_ = std::make_unique<BoundedSearch>(
        cone_, search_jumps_ ? &jump_ : nullptr, fault_, *options_.deadline);
  }
  const std::uint32_t depth = depth_ + 1;
  for (;;) {
    std::vector<AigLit> goals;
    std::vector<Target*> of;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Target& target = *targets_[i];
      if (target.status != Target::Status::Open) continue;
      if (target.purpose == Target::Purpose::Fault) continue;
      goals.push_back(cone_.roots()[i]);
      of.push_back(&target);
    }
    BoundedSearch::Result result =
        search_->search(depth, goals, {conflicts, kMinimiseQueries});
    if (result.answer == BoundedSearch::Answer::Unknown) return false;
    if (result.answer == BoundedSearch::Answer::None) {
      for (Target* target : of) target->bound = depth;
      depth_ = depth;
      return true;
    }
    Target& target = *of[result.target];
    if (!reaches(cone_, result.run, target.term)) {
      // A stretch stood for scans that it is not: do without any.
      search_jumps_ = false;
      search_.reset();
      depth_ = 0;
      return true;
    }
    found(target, std::move(result.run));
    if (!any_open()) return true;
  }
}

void Portfolio::search(std::uint32_t depth, std::int64_t conflicts) {
  while (depth_ < std::min(depth, options_.max_depth) && !out_of_time()) {
    const bool wanted =
        std::any_of(targets_.begin(), targets_.end(), [](const Target* target) {
          return target->status == Target::Status::Open &&
                 target->purpose != Target::Purpose::Fault;
        });
    if (!wanted || !search_depth(conflicts)) return;
  }
}

void Portfolio::run() {
  structural();
  if (uses("induction")) induction(0, false, 20000);
  if (uses("induction")) induction(1, false, 20000);
  if (uses("bmc")) search(8, 20000);
  if (uses("induction")) {
    for (std::uint32_t k = 1; k <= 8 && any_open() && !out_of_time(); ++k) {
      induction(k, true, 20000);
    }
  }
  if (uses("bmc")) search(options_.max_depth, 100000);
}

}  // namespace rung
