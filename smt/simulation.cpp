#include "smt/simulation.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "smt/sat.h"
#include "smt/thresholds.h"
#include "smt/unroll.h"

namespace rung {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};
constexpr std::uint32_t kEra = 12;  // steps; then guided lanes start again
constexpr std::size_t kStarts = 64;

}  // namespace

Simulation::Simulation(Cone& cone, const JumpCircuit* jump, AigLit never,
                       std::vector<std::int64_t> first, std::uint64_t seed)
    : cone_(&cone),
      jump_(jump != nullptr && jump->useful() ? jump : nullptr),
      legal_(
          cone.circuit().aig().conjunction(cone.constraint(), aig_not(never))),
      lanes_(cone.circuit().aig()),
      turns_(cone) {
  seed_ += 2 * seed;  // odd, so never 0
  for (std::size_t i = 0; i < cone.inputs().size(); ++i) {
    const Word& leaves = cone.circuit().leaves(cone.inputs()[i]);
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      lanes_.set(leaves, lane, first[i]);
    }
    if (cone.ts().vars[cone.inputs()[i]].type == Type::Bit) {
      toggled_.push_back(input_bits_.size());
    }
    for (AigLit bit : leaves) {
      if (aig_node(bit) != 0) input_bits_.push_back(bit);
    }
  }
  for (std::size_t i = 0; i < cone.inputs().size(); ++i) {
    frozen_.push_back(random());
  }
  for (const StateBit& bit : cone.bits()) {
    lanes_.set(bit.leaf, bit.init ? kAll : 0);
  }
  for (std::uint32_t state : cone.states()) {
    const State& of = cone.ts().states[state];
    if (of.clock) continue;
    const Word& word = cone.circuit().leaves(of.var);
    const std::int64_t now = lanes_.value(word, 0);
    records_.push_back({word, now, now});
  }
  for (const StateBit& bit : cone.bits()) movable_.push_back(bit.leaf);
  movable_.insert(movable_.end(), input_bits_.begin(), input_bits_.end());
  if (jump_ == nullptr) return;
  const auto compared = thresholds(cone);
  for (std::uint32_t state : cone.states()) {
    if (!cone.ts().states[state].clock) continue;
    clocks_.push_back({cone.circuit().leaves(cone.ts().states[state].var),
                       cone.circuit().next(state), compared.at(state)});
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
/// at once, patient lanes even less: there long timers expire one after
/// another.
std::uint64_t Simulation::changing_lanes() {
  constexpr std::uint64_t kQuarter = 0xffff;
  const std::uint64_t a = random();
  const std::uint64_t b = a & random();
  const std::uint64_t c = b & random();
  const std::uint64_t calm = steps() % 16 == 0 ? ~std::uint64_t{0} : 0;
  std::uint64_t patient = 0;
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    constexpr std::uint32_t kRests[] = {16, 32, 64, 256};  // steps
    const std::uint32_t rest = kRests[lane / 4 % 4];
    if (steps() % rest == 0) patient |= kPatient & std::uint64_t{1} << lane;
  }
  const std::uint64_t others = (a & kQuarter) | (b & kQuarter << 16U) |
                               (c & kQuarter << 32U) | (calm & kQuarter << 48U);
  return (others & ~kPatient) | patient;
}

/// New inputs in some lanes; most changes are of few inputs. In guided lanes
/// some inputs rest for an era: what needs many scans without a stop is met
/// too.
void Simulation::propose() {
  const TransitionSystem& ts = cone_->ts();
  const std::uint64_t change = changing_lanes();
  const std::uint64_t many = steps() == 0 ? kAll : random() & random();
  std::size_t bit = 0;
  for (VarId input : cone_->inputs()) {
    const Variable& var = ts.vars[input];
    const Word& leaves = cone_->circuit().leaves(input);
    if (var.type == Type::Bit) {
      const std::uint64_t now = lanes_.value(leaves.front());
      if (steps() % kEra == 0) {
        frozen_[bit] = steps() == 0 ? 0 : random() & random() & kGuided;
      }
      const std::uint64_t flip =
          change & (random() & (many | (random() & random()))) & ~frozen_[bit];
      ++bit;
      lanes_.set(leaves.front(), now ^ flip);
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
      const bool patient =
          is_dt && (kPatient >> lane & 1U) != 0 && lane / 4 % 4 != 3;
      if (patient ? (lane & 2U) != 0 : (dice & 3U) == 1) value = var.high;
      if (!patient && (dice & 3U) > 1) {
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

void Simulation::set_stretch(const Lanes::Values& deltas) {
  const std::int64_t longest =
      std::max<std::int64_t>(cone_->ts().scan.max_ms, 1);
  Lanes::Values scans;
  std::transform(deltas.begin(), deltas.end(), scans.begin(),
                 [&](auto delta) { return (delta + longest - 1) / longest; });
  lanes_.set(jump_->delta(), deltas);
  lanes_.set(jump_->scans(), scans);
}

/// How long until some clock that runs is what it is compared with; 0: none
/// will be.
Lanes::Values Simulation::times_to_event() const {
  Lanes::Values times{};
  for (const Clock& clock : clocks_) {
    const Lanes::Values before = lanes_.values(clock.before);
    const Lanes::Values next = lanes_.values(clock.next);
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      if (next[lane] <= before[lane]) continue;
      const auto event = std::upper_bound(clock.thresholds.begin(),
                                          clock.thresholds.end(), next[lane]);
      if (event == clock.thresholds.end()) continue;
      const std::int64_t time = *event - next[lane];
      times[lane] = times[lane] == 0 ? time : std::min(times[lane], time);
    }
  }
  return times;
}

/// The longest sum of dt's that is not longer than `delta`, or 0.
std::int64_t Simulation::legal_sum(std::int64_t delta) const {
  const ScanInterval& scan = cone_->ts().scan;
  const std::int64_t shortest = std::max<std::int64_t>(scan.min_ms, 1);
  const std::int64_t scans = delta / shortest;
  const std::int64_t fewest = (delta + scan.max_ms - 1) / scan.max_ms;
  return scans >= fewest ? delta : std::min(delta, scans * scan.max_ms);
}

/// How long each lane waits at most. Long waits are seldom: they hide short
/// ones, and every scan of a run is replayed in the end.
Lanes::Values Simulation::waits() {
  constexpr std::int64_t kPatience[] = {
      1'000, 10'000, 100'000, std::numeric_limits<std::int64_t>::max()};
  const std::int64_t most =
      (std::int64_t{1} << (jump_->delta().size() - 1)) - 1;
  Lanes::Values deltas = times_to_event();
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    std::int64_t& delta = deltas[lane];
    const std::int64_t wait = std::max<std::int64_t>(delta - 1, 0);
    const bool patient = (kPatient >> lane & 1U) != 0;
    const std::int64_t patience = kPatience[patient ? 3 : random() >> 8U & 3U];
    delta = wait > patience ? 0 : legal_sum(std::min(wait, most));
  }
  return deltas;
}

/// Evaluates the stretches that may be taken: where no comparison flips. The
/// lanes that take one; `deltas` becomes 0 in the others.
std::uint64_t Simulation::take_stretches(Lanes::Values& deltas) {
  std::uint64_t taken = 0;
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    if (deltas[lane] > 0) taken |= std::uint64_t{1} << lane;
  }
  while (taken != 0) {
    lanes_.set(jump_->taken(), taken);
    set_stretch(deltas);
    // The jump's gates were made last; a scan's own do not depend on it.
    lanes_.evaluate(aig_node(jump_->taken()));
    const std::uint64_t refused = taken & ~lanes_.value(jump_->allowed());
    if (refused == 0) break;
    taken &= ~refused;
    for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
      if ((refused >> lane & 1U) != 0) deltas[lane] = 0;
    }
  }
  return taken;
}

/// To the state behind the scan just made, or behind its stretch.
void Simulation::advance() {
  bool stretched = false;
  if (jump_ != nullptr) {
    Lanes::Values deltas = waits();
    stretched = take_stretches(deltas) != 0;
    log_.back().deltas.assign(deltas.begin(), deltas.end());
  }
  const std::vector<StateBit>& bits = stretched ? jump_->bits() : cone_->bits();
  std::vector<std::uint64_t> next;
  next.reserve(bits.size());
  for (const StateBit& bit : bits) next.push_back(lanes_.value(bit.next));
  for (std::size_t i = 0; i < bits.size(); ++i) {
    lanes_.set(bits[i].leaf, next[i]);
  }
  if (turns_.useful()) log_.back().turns = turns_.take(lanes_);
}

/// One or two inputs that are bits, in each lane.
std::vector<std::uint64_t> Simulation::few_flips() {
  std::vector<std::uint64_t> flips(input_bits_.size(), 0);
  for (std::uint32_t lane : Turns::kLanes) {
    for (int i = 0; i < 2; ++i) {
      if (toggled_.empty()) continue;
      const std::size_t bit = toggled_[(random() >> 8U) % toggled_.size()];
      flips[bit] |= std::uint64_t{1} << lane;
    }
  }
  return flips;
}

/// Lanes in which the word is greater than `bound`, or (`down`) less: which is
/// the same of the complements.
std::uint64_t Simulation::beyond(const Word& word, std::int64_t bound,
                                 bool down) const {
  const std::uint64_t flip = down ? kAll : 0;
  const auto limit = static_cast<std::uint64_t>(bound) ^ flip;
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    // The last bit of a number is its sign: 0 is the greater one.
    const bool sign = word.size() > 1 && i + 1 == word.size();
    const std::uint64_t bit = lanes_.value(word[i]) ^ flip ^ (sign ? kAll : 0);
    const bool set = (limit >> std::min<std::size_t>(i, 63) & 1U) != sign;
    beyond = set ? beyond & bit : beyond | bit;
  }
  return beyond;
}

/// Lanes in which some state is where no run had it.
std::uint64_t Simulation::record_breakers() {
  constexpr int kAtOnce = 4;  // of one state: each goes beyond the last
  std::uint64_t breakers = 0;
  for (Record& record : records_) {
    for (int i = 0; i < kAtOnce; ++i) {
      const std::uint64_t up = beyond(record.word, record.high, false) & alive_;
      const std::uint64_t down = beyond(record.word, record.low, true) & alive_;
      if ((up | down) == 0) break;
      const int lane = std::countr_zero(up != 0 ? up : down);
      breakers |= std::uint64_t{1} << lane;
      (up != 0 ? record.high : record.low) =
          lanes_.value(record.word, static_cast<std::uint32_t>(lane));
    }
  }
  return breakers;
}

/// Keeps where these lanes are, before new inputs.
void Simulation::remember(std::uint64_t lanes) {
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    Start start{{steps() - 1, lane}, {}};
    start.values.reserve(movable_.size());
    for (AigLit bit : movable_) {
      start.values.push_back((lanes_.value(bit) >> lane & 1U) != 0);
    }
    if (starts_.size() < kStarts) {
      starts_.push_back(std::move(start));
    } else {
      starts_[next_start_] = std::move(start);
    }
    next_start_ = (next_start_ + 1) % kStarts;
  }
}

/// Guided lanes go on from where records were broken: half of them from the
/// last one, a quarter from any.
std::vector<Simulation::Place> Simulation::restart() {
  if (starts_.empty()) return {};
  std::vector<Place> origin;
  std::vector<const Start*> start(Lanes::kCount, nullptr);
  for (std::uint32_t lane = 0; lane < Lanes::kCount; ++lane) {
    origin.push_back({steps() - 1, lane});
    const std::uint64_t dice = random() >> 8U;
    if ((kGuided >> lane & 1U) == 0 || (dice & 3U) == 0) continue;
    const std::size_t last = (next_start_ + kStarts - 1) % kStarts;
    const std::size_t any = (dice >> 2U) % starts_.size();
    start[lane] = &starts_[(dice & 3U) == 1 ? any : last];
    origin[lane] = start[lane]->place;
    alive_ |= std::uint64_t{1} << lane;
  }
  for (std::size_t i = 0; i < movable_.size(); ++i) {
    std::uint64_t value = lanes_.value(movable_[i]);
    for (std::uint32_t lane = 0; lane < Lanes::kCount; lane += 2) {
      if (start[lane] == nullptr) continue;
      const std::uint64_t bit = start[lane]->values[i] ? 1 : 0;
      value = (value & ~(std::uint64_t{1} << lane)) | bit << lane;
    }
    lanes_.set(movable_[i], value);
  }
  return origin;
}

void Simulation::step() {
  news_ = false;
  if (!log_.empty()) {
    advance();
    const std::uint64_t breakers = record_breakers();
    news_ = breakers != 0;
    remember(breakers);
  }
  Step next;
  if (steps() > 0 && steps() % kEra == 0) next.origin = restart();
  const std::vector<std::uint64_t> before = inputs();
  propose();
  if (turns_.useful()) {
    if (steps() % kEra == 0) turns_.begin(lanes_, input_bits_, few_flips());
    turns_.set_inputs(lanes_, input_bits_);
  }
  keep_legal(before);
  next.inputs = inputs();
  log_.push_back(std::move(next));
}

Run Simulation::run(std::uint32_t step, std::uint32_t lane) const {
  Run run;
  const TransitionSystem& ts = cone_->ts();
  std::vector<Place> places;  // from the last
  Place at{step - 1, lane};
  for (;;) {
    places.push_back(at);
    if (at.step == 0) break;
    const std::vector<Place>& origin = log_[at.step].origin;
    at = origin.empty() ? Place{at.step - 1, at.lane} : origin[at.lane];
  }
  std::reverse(places.begin(), places.end());
  for (const Place& place : places) {
    const Step& made = log_[place.step];
    RunStep one;
    std::size_t bit = 0;
    for (VarId input : cone_->inputs()) {
      std::uint64_t value = 0;
      std::uint32_t i = 0;
      for (AigLit leaf : cone_->leaves(input)) {
        // A constant is the sign of a word of one sign.
        const std::uint64_t set =
            aig_node(leaf) == 0 ? leaf : made.inputs[bit++] >> place.lane & 1U;
        value |= set << i++;
      }
      const bool negative =
          ts.vars[input].type == Type::Word && (value >> (i - 1) & 1U) != 0;
      if (negative) value |= kAll << i;
      one.inputs.push_back(static_cast<std::int64_t>(value));
    }
    if (!made.deltas.empty()) one.delta = made.deltas[place.lane];
    run.push_back(std::move(one));
    if (made.turns.empty() || &place == &places.back()) continue;
    const RunStep turn[] = {run[run.size() - 2], run.back()};
    for (std::int64_t i = 0; i < made.turns[place.lane]; ++i) {
      run.insert(run.end(), std::begin(turn), std::end(turn));
    }
  }
  run.back().delta = 0;
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
