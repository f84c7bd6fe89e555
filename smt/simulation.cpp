#include "smt/simulation.h"

#include <algorithm>
#include <limits>

#include "smt/sat.h"
#include "smt/thresholds.h"
#include "smt/unroll.h"

namespace rung {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

}  // namespace

Simulation::Simulation(Cone& cone, const JumpCircuit* jump, AigLit never,
                       std::vector<std::int64_t> first)
    : cone_(&cone),
      jump_(jump != nullptr && jump->useful() ? jump : nullptr),
      legal_(
          cone.circuit().aig().conjunction(cone.constraint(), aig_not(never))),
      lanes_(cone.circuit().aig()) {
  for (std::size_t i = 0; i < cone.inputs().size(); ++i) {
    const Word& leaves = cone.circuit().leaves(cone.inputs()[i]);
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      lanes_.set(leaves, lane, first[i]);
    }
    for (AigLit bit : leaves) {
      if (aig_node(bit) != 0) input_bits_.push_back(bit);
    }
  }
  for (const StateBit& bit : cone.bits()) {
    lanes_.set(bit.leaf, bit.init ? kAll : 0);
  }
  if (jump_ == nullptr) return;
  const auto compared = thresholds(cone);
  for (std::uint32_t state : cone.states()) {
    if (!cone.ts().states[state].clock) continue;
    clocks_.push_back({cone.circuit().next(state), compared.at(state)});
  }
}

std::uint64_t Simulation::random() {
  seed_ ^= seed_ << 13U;
  seed_ ^= seed_ >> 7U;
  seed_ ^= seed_ << 17U;
  return seed_ * 0x9e37'79b9'7f4a'7c15U;
}

std::vector<std::uint64_t> Simulation::inputs() const {
  std::vector<std::uint64_t> bits;
  for (AigLit bit : input_bits_) bits.push_back(lanes_.value(bit));
  return bits;
}

void Simulation::set_inputs(const std::vector<std::uint64_t>& bits) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    lanes_.set(input_bits_[i], bits[i]);
  }
}

/// A quarter of the lanes change inputs in every other step, a quarter in one
/// of four, a quarter in one of eight, and the last one in one of sixteen, all
/// at once: there long timers expire one after another.
std::uint64_t Simulation::changing_lanes() {
  constexpr std::uint64_t kQuarter = 0xffff;
  const std::uint64_t a = random();
  const std::uint64_t b = a & random();
  const std::uint64_t c = b & random();
  const std::uint64_t calm = steps() % 16 == 0 ? kAll : 0;
  return (a & kQuarter) | (b & kQuarter << 16U) | (c & kQuarter << 32U) |
         (calm & kQuarter << 48U);
}

/// New inputs in some lanes; most changes are of few inputs.
void Simulation::propose() {
  const TransitionSystem& ts = cone_->ts();
  const std::uint64_t change = changing_lanes();
  const std::uint64_t many = steps() == 0 ? kAll : random() & random();
  for (VarId input : cone_->inputs()) {
    const Variable& var = ts.vars[input];
    const Word& leaves = cone_->circuit().leaves(input);
    if (var.type == Type::Bit) {
      const std::uint64_t flip =
          change & (random() & (many | (random() & random())));
      lanes_.set(leaves.front(), lanes_.value(leaves.front()) ^ flip);
      continue;
    }
    const bool is_dt = var.role == VarRole::Dt;
    const std::uint64_t touched =
        is_dt ? random() : change & random() & random();
    const auto span = static_cast<std::uint64_t>(var.high - var.low) + 1;
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      if ((touched >> lane & 1U) == 0) continue;
      const std::uint64_t dice = random();
      std::int64_t value = var.low;
      if ((dice & 3U) == 1) value = var.high;
      if ((dice & 3U) > 1) {
        value = var.low + static_cast<std::int64_t>((dice >> 2U) % span);
      }
      lanes_.set(leaves, lane, value);
    }
  }
}

/// Lanes whose new inputs are not allowed keep the old ones.
void Simulation::keep_legal(const std::vector<std::uint64_t>& before) {
  lanes_.evaluate();
  if ((alive_ & ~lanes_.value(legal_)) == 0) return;
  for (std::size_t i = 0; i < input_bits_.size(); ++i) {
    const std::uint64_t legal = lanes_.value(legal_);
    const std::uint64_t now = lanes_.value(input_bits_[i]);
    lanes_.set(input_bits_[i], (now & legal) | (before[i] & ~legal));
  }
  lanes_.evaluate();
  alive_ &= lanes_.value(legal_);
}

void Simulation::set_stretch(const std::vector<std::int64_t>& deltas) {
  const std::int64_t longest =
      std::max<std::int64_t>(cone_->ts().scan.max_ms, 1);
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    lanes_.set(jump_->delta(), lane, deltas[lane]);
    lanes_.set(jump_->scans(), lane, (deltas[lane] + longest - 1) / longest);
  }
}

/// How long until some clock is what it is compared with.
std::int64_t Simulation::time_to_event(std::uint32_t lane) const {
  std::int64_t time = std::numeric_limits<std::int64_t>::max();
  for (const Clock& clock : clocks_) {
    const std::int64_t now = lanes_.value(clock.next, lane);
    const auto event =
        std::upper_bound(clock.thresholds.begin(), clock.thresholds.end(), now);
    if (event != clock.thresholds.end()) time = std::min(time, *event - now);
  }
  return time;
}

/// The longest sum of dt's that is not longer than `delta`, or 0.
std::int64_t Simulation::legal_sum(std::int64_t delta) const {
  const ScanInterval& scan = cone_->ts().scan;
  const std::int64_t shortest = std::max<std::int64_t>(scan.min_ms, 1);
  const std::int64_t scans = delta / shortest;
  const std::int64_t fewest = (delta + scan.max_ms - 1) / scan.max_ms;
  return scans >= fewest ? delta : std::min(delta, scans * scan.max_ms);
}

/// A delta for each lane in which no comparison flips; 0 where none is found.
std::vector<std::int64_t> Simulation::longest_stretches() {
  constexpr int kTries = 3;
  const std::int64_t most =
      (std::int64_t{1} << (jump_->delta().size() - 1)) - 1;
  std::vector<std::int64_t> deltas;
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    deltas.push_back(legal_sum(std::min(time_to_event(lane) - 1, most)));
  }
  lanes_.set(jump_->taken(), kAll);
  for (int i = 0; i < kTries; ++i) {
    set_stretch(deltas);
    // The jump's gates were made last; a scan's own do not depend on it.
    lanes_.evaluate(aig_node(jump_->taken()));
    const std::uint64_t allowed = lanes_.value(jump_->allowed());
    if (allowed == kAll) break;
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      if ((allowed >> lane & 1U) != 0) continue;
      deltas[lane] = i + 1 < kTries ? legal_sum(deltas[lane] / 4) : 0;
    }
  }
  return deltas;
}

/// To the state behind the scan just made, or behind its stretch.
void Simulation::advance() {
  const std::vector<StateBit>& bits =
      jump_ != nullptr ? jump_->bits() : cone_->bits();
  if (jump_ != nullptr) {
    std::vector<std::int64_t> deltas = longest_stretches();
    std::uint64_t taken = 0;
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      if (deltas[lane] > 0) taken |= std::uint64_t{1} << lane;
    }
    lanes_.set(jump_->taken(), taken);
    set_stretch(deltas);
    lanes_.evaluate(aig_node(jump_->taken()));
    log_.back().deltas = std::move(deltas);
  }
  std::vector<std::uint64_t> next;
  next.reserve(bits.size());
  for (const StateBit& bit : bits) next.push_back(lanes_.value(bit.next));
  for (std::size_t i = 0; i < bits.size(); ++i) {
    lanes_.set(bits[i].leaf, next[i]);
  }
}

void Simulation::step() {
  if (!log_.empty()) advance();
  const std::vector<std::uint64_t> before = inputs();
  propose();
  keep_legal(before);
  log_.push_back({inputs(), {}});
}

Run Simulation::run(std::uint32_t lane) const {
  Run run;
  const TransitionSystem& ts = cone_->ts();
  for (const Step& step : log_) {
    RunStep one;
    std::size_t bit = 0;
    for (VarId input : cone_->inputs()) {
      std::uint64_t value = 0;
      std::uint32_t i = 0;
      for (AigLit leaf : cone_->leaves(input)) {
        // A constant is the sign of a word of one sign.
        const std::uint64_t set =
            aig_node(leaf) == 0 ? leaf : step.inputs[bit++] >> lane & 1U;
        value |= set << i++;
      }
      const bool negative =
          ts.vars[input].type == Type::Word && (value >> (i - 1) & 1U) != 0;
      if (negative) value |= kAll << i;
      one.inputs.push_back(static_cast<std::int64_t>(value));
    }
    if (!step.deltas.empty()) one.delta = step.deltas[lane];
    run.push_back(std::move(one));
  }
  return run;
}

std::vector<std::int64_t> first_inputs(Cone& cone, const Deadline& deadline) {
  Unrolling frames(cone.circuit().aig(), cone.bits(),
                   Unrolling::Start::Initial);
  Sat sat(&deadline);
  AigClauses clauses(frames.aig(), sat);
  clauses.require(frames.at(0, cone.constraint()));
  if (sat.solve() != SatAnswer::Sat) return {};
  std::vector<std::int64_t> values;
  for (VarId input : cone.inputs()) {
    const Variable& var = cone.ts().vars[input];
    std::uint64_t value = 0;
    const Word& leaves = cone.circuit().leaves(input);
    for (std::size_t i = 0; i < 64; ++i) {
      const AigLit leaf = leaves[std::min(i, leaves.size() - 1)];
      if (var.type == Type::Bit && i > 0) break;
      value |= std::uint64_t{clauses.value(frames.at(0, leaf))} << i;
    }
    values.push_back(
        std::clamp(static_cast<std::int64_t>(value), var.low, var.high));
  }
  return values;
}

}  // namespace rung
