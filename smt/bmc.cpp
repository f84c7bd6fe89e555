#include "smt/bmc.h"

#include <algorithm>

namespace rung {

namespace {

/// `bits` of the cone's states, with their values in `state`.
std::vector<StateBit> starting_in(const Cone& cone, std::vector<StateBit> bits,
                                  const SliceState* state) {
  if (state == nullptr) return bits;
  std::size_t at = 0;
  for (const std::uint32_t index : cone.states()) {
    const Word& leaves = cone.leaves(cone.ts().states[index].var);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (leaves[i] <= kAigTrue) continue;  // a known sign: see append_bits()
      const auto shift = std::min<std::size_t>(i, 63);
      bits[at++].init = (((*state)[index] >> shift) & 1) != 0;
    }
  }
  return bits;
}

}  // namespace

BoundedSearch::BoundedSearch(Cone& cone, const JumpCircuit* jump, AigLit never,
                             const Deadline& deadline, const SliceState* from)
    : cone_(&cone),
      jump_(jump != nullptr && jump->useful() ? jump : nullptr),
      never_(never),
      frames_(cone.circuit().aig(),
              starting_in(cone, jump_ != nullptr ? jump_->bits() : cone.bits(),
                          from),
              Unrolling::Start::Initial),
      sat_(&deadline),
      clauses_(frames_.aig(), sat_) {}

void BoundedSearch::extend(std::uint32_t depth) {
  for (; extended_ < depth; ++extended_) {
    clauses_.require(copied(extended_, cone_->constraint()));
    clauses_.require(aig_not(copied(extended_, never_)));
    if (jump_ != nullptr && extended_ > 0) {
      clauses_.require(copied(extended_ - 1, jump_->allowed()));
    }
  }
}

BoundedSearch::Result BoundedSearch::search(std::uint32_t depth,
                                            const std::vector<AigLit>& targets,
                                            std::int64_t conflicts) {
  return search_frames(depth - 1, depth, targets, conflicts);
}

BoundedSearch::Result BoundedSearch::search_within(
    std::uint32_t depth, const std::vector<AigLit>& targets,
    std::int64_t conflicts) {
  return search_frames(0, depth, targets, conflicts);
}

BoundedSearch::Result BoundedSearch::search_frames(
    std::uint32_t first, std::uint32_t depth,
    const std::vector<AigLit>& targets, std::int64_t conflicts) {
  extend(depth);
  goals_.clear();
  AigLit any = kAigFalse;
  for (AigLit target : targets) {
    AigLit goal = kAigFalse;
    for (std::uint32_t frame = first; frame < depth; ++frame) {
      goal = frames_.aig().disjunction(goal, copied(frame, target));
    }
    goals_.push_back(goal);
    any = frames_.aig().disjunction(any, goal);
  }
  if (any == kAigFalse) return {};
  // Rewriting may have left a goal out of the cone of `any`.
  for (AigLit goal : goals_) clauses_.literal(goal);
  sat_.assume(clauses_.literal(any));
  const SatAnswer answer = sat_.solve(conflicts);
  if (answer == SatAnswer::Unsat) return {};
  if (answer == SatAnswer::Unknown) return {Answer::Unknown, 0, {}};
  Result result{Answer::Found, 0, decode(depth)};
  while (!clauses_.value(goals_[result.target])) ++result.target;
  return result;
}

Word BoundedSearch::copied(std::uint32_t frame, const Word& word) {
  Word result;
  for (AigLit bit : word) result.push_back(copied(frame, bit));
  return result;
}

std::int64_t BoundedSearch::value(std::uint32_t frame, const Word& word) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const AigLit bit = copied(frame, word[std::min(i, word.size() - 1)]);
    bits |= std::uint64_t{clauses_.value(bit)} << i;
  }
  return static_cast<std::int64_t>(bits);
}

Run BoundedSearch::decode(std::uint32_t depth) {
  Run run;
  const TransitionSystem& ts = cone_->ts();
  for (std::uint32_t frame = 0; frame < depth; ++frame) {
    RunStep step;
    for (VarId input : cone_->inputs()) {
      const Variable& var = ts.vars[input];
      const Word& leaves = cone_->circuit().leaves(input);
      const bool word = var.type == Type::Word;
      const std::int64_t x =
          word ? value(frame, leaves)
               : std::int64_t{clauses_.value(copied(frame, leaves.front()))};
      // An input that nothing in this run reads has no value yet.
      step.inputs.push_back(std::clamp(x, var.low, var.high));
    }
    const bool stretch = jump_ != nullptr && frame + 1 < depth &&
                         clauses_.value(copied(frame, jump_->taken()));
    if (stretch) step.delta = value(frame, jump_->delta());
    run.push_back(std::move(step));
  }
  return run;
}

}  // namespace rung
