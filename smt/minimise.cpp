// The shortest and calmest run that BoundedSearch finds at a depth: fewest
// scans first, then inputs that change as seldom as can be.

#include <algorithm>

#include "smt/bmc.h"

namespace rung {
namespace {

constexpr std::int64_t kConflicts = 1000;  // a query of the minimisation

}  // namespace

void BoundedSearch::minimise(Result& result, std::uint32_t queries) {
  const auto depth = static_cast<std::uint32_t>(result.run.size());
  best_ = std::move(result.run);
  kept_ = {goals_[result.target]};
  fewest_scans(depth, queries);
  calmest_inputs(depth, queries);
  result.run = std::move(best_);
}

bool BoundedSearch::holds_with(AigLit more, std::int64_t conflicts) {
  for (AigLit literal : kept_) sat_.assume(clauses_.literal(literal));
  sat_.assume(clauses_.literal(more));
  return sat_.solve(conflicts) == SatAnswer::Sat;
}

void BoundedSearch::fewest_scans(std::uint32_t depth, std::uint32_t& queries) {
  const ScanInterval& scan = cone_->ts().scan;
  std::uint64_t most = scan_count(best_, scan);
  std::uint64_t least = depth;
  if (most == least || jump_ == nullptr) return;
  Aig& aig = frames_.aig();
  Word total = word_constant(depth);
  for (std::uint32_t frame = 0; frame + 1 < depth; ++frame) {
    const Word scans = copied(frame, jump_->scans());
    const AigLit taken = copied(frame, jump_->taken());
    total =
        word_add(aig, total, word_choose(aig, taken, scans, word_constant(0)));
  }
  const auto at_most = [&](std::uint64_t count) {
    const Word bound = word_constant(static_cast<std::int64_t>(count));
    return aig_not(word_less(aig, bound, total));
  };
  while (least < most && queries > 0) {
    --queries;
    const std::uint64_t middle = least + (most - least) / 2;
    if (holds_with(at_most(middle), kConflicts)) {
      best_ = decode(depth);
      most = std::min(middle, scan_count(best_, scan));
    } else {
      least = middle + 1;
    }
  }
  kept_.push_back(at_most(scan_count(best_, scan)));
}

/// Input as in the frame before; in the first one 0, or as near as it may be.
AigLit BoundedSearch::unchanged(std::uint32_t frame, VarId input) {
  const Variable& var = cone_->ts().vars[input];
  const Word now = copied(frame, cone_->circuit().leaves(input));
  if (frame > 0) {
    const Word before = copied(frame - 1, cone_->circuit().leaves(input));
    return word_equal(frames_.aig(), now, before);
  }
  const std::int64_t rest = std::clamp<std::int64_t>(0, var.low, var.high);
  if (var.type == Type::Bit) return aig_not(now.front());
  return word_equal(frames_.aig(), now, word_constant(rest));
}

/// Makes `wish` a condition of the run when some run can meet it.
void BoundedSearch::keep(AigLit wish, std::uint32_t& queries) {
  if (wish == kAigTrue || wish == kAigFalse || queries == 0) return;
  --queries;
  if (holds_with(wish, kConflicts)) kept_.push_back(wish);
}

void BoundedSearch::calmest_inputs(std::uint32_t depth,
                                   std::uint32_t& queries) {
  const std::size_t before = kept_.size();
  AigLit all = kAigTrue;
  std::vector<AigLit> wishes;
  for (std::uint32_t frame = 0; frame < depth; ++frame) {
    for (VarId input : cone_->inputs()) {
      wishes.push_back(unchanged(frame, input));
      all = frames_.aig().conjunction(all, wishes.back());
    }
  }
  keep(all, queries);
  if (kept_.size() == before) {
    for (AigLit wish : wishes) keep(wish, queries);
  }
  if (kept_.size() == before) return;
  if (holds_with(kAigTrue, -1)) best_ = decode(depth);
}

}  // namespace rung
