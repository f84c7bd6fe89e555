#include "smt/turns.h"

#include <algorithm>

#include "smt/thresholds.h"

namespace rung {
namespace {

constexpr std::int64_t kMostTurns = 100'000;  // at once

constexpr std::uint64_t mask() {
  std::uint64_t lanes = 0;
  for (std::uint32_t lane : Turns::kLanes) lanes |= std::uint64_t{1} << lane;
  return lanes;
}

}  // namespace

Turns::Turns(const Cone& cone) {
  const TransitionSystem& ts = cone.ts();
  const auto compared = thresholds(cone);
  for (std::uint32_t state : cone.states()) {
    const Variable& var = ts.vars[ts.states[state].var];
    const Word& word = cone.leaves(ts.states[state].var);
    if (var.type == Type::Bit) {
      bits_.push_back(word.front());
      continue;
    }
    useful_ = useful_ || !ts.states[state].clock;
    numbers_.push_back({word, var.low, var.high, compared.at(state)});
  }
}

void Turns::begin(const Lanes& lanes, const std::vector<AigLit>& inputs,
                  const std::vector<std::uint64_t>& flips) {
  scans_ = 0;
  moments_.clear();
  for (auto& of : inputs_) of.resize(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs_[0][i] = lanes.value(inputs[i]);
    inputs_[1][i] = inputs_[0][i] ^ flips[i];
  }
}

void Turns::set_inputs(Lanes& lanes, const std::vector<AigLit>& inputs) const {
  const std::vector<std::uint64_t>& of = inputs_[scans_ % 2];
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    lanes.set(inputs[i], (lanes.value(inputs[i]) & ~mask()) | (of[i] & mask()));
  }
}

Turns::Moment Turns::now(const Lanes& lanes) const {
  Moment moment;
  moment.bits.reserve(bits_.size());
  for (AigLit bit : bits_) moment.bits.push_back(lanes.value(bit) & mask());
  moment.numbers.reserve(numbers_.size());
  for (const Number& number : numbers_) {
    Values values;
    for (std::size_t i = 0; i < kLanes.size(); ++i) {
      values[i] = lanes.value(number.word, kLanes[i]);
    }
    moment.numbers.push_back(values);
  }
  return moment;
}

/// How often the last turn can be taken again before some comparison flips; 0
/// when the turn before it was another one.
std::int64_t Turns::times(std::size_t lane) const {
  std::int64_t times = kMostTurns;
  bool moves = false;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const std::int64_t value = moments_[2].numbers[i][lane];
    const std::int64_t before = moments_[1].numbers[i][lane];
    const std::int64_t by = value - before;
    if (before - moments_[0].numbers[i][lane] != by) return 0;
    if (by == 0) continue;
    moves = true;
    const std::vector<std::int64_t>& c = numbers_[i].thresholds;
    const auto above = std::upper_bound(c.begin(), c.end(), value);
    const std::int64_t top = above == c.end() ? numbers_[i].high : *above - 1;
    const std::int64_t bottom =
        above == c.begin() ? numbers_[i].low : above[-1];
    times =
        std::min(times, by > 0 ? (top - value) / by : (value - bottom) / -by);
  }
  return moves ? times : 0;
}

std::vector<std::int64_t> Turns::take(Lanes& lanes) {
  if (++scans_ % 2 != 0) return {};
  moments_.push_back(now(lanes));
  if (moments_.size() < 3) return {};
  if (moments_.size() > 3) moments_.erase(moments_.begin());
  std::uint64_t calm = mask();
  for (std::size_t i = 0; i < bits_.size(); ++i) {
    calm &= ~(moments_[2].bits[i] ^ moments_[1].bits[i]) &
            ~(moments_[1].bits[i] ^ moments_[0].bits[i]);
  }
  std::vector<std::int64_t> taken;
  for (std::size_t lane = 0; lane < kLanes.size(); ++lane) {
    if ((calm >> kLanes[lane] & 1U) == 0) continue;
    const std::int64_t again = times(lane);
    if (again < 2) continue;
    taken.resize(Lanes::kCount, 0);
    taken[kLanes[lane]] = again;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const std::int64_t value = moments_[2].numbers[i][lane];
      const std::int64_t by = value - moments_[1].numbers[i][lane];
      lanes.set(numbers_[i].word, kLanes[lane], value + again * by);
    }
  }
  if (!taken.empty()) moments_.clear();
  return taken;
}

}  // namespace rung
