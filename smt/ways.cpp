#include "smt/ways.h"

#include <algorithm>
#include <utility>

#include "smt/trap.h"

namespace rung {
namespace {

constexpr std::int64_t kConflicts = 5000;    // a query
constexpr std::uint64_t kSingleScans = 300;  // a stretch as that many regions

std::vector<ExprId> with_constraints(const TransitionSystem& ts, ExprId goal) {
  std::vector<ExprId> roots = ts.constraints;
  roots.push_back(goal);
  return roots;
}

}  // namespace

Ways::Ways(TransitionSystem& ts, Cone& cone, ExprId goal,
           const Deadline& deadline)
    : ts_(ts),
      cone_(cone),
      terms_(ts, with_constraints(ts, goal)),
      sat_(&deadline),
      clauses_(cone.circuit().aig(), sat_),
      allowed_(allowed(ts)),
      inside_(ts.exprs.bit(false)),
      left_out_(ts.exprs.bit(false)),
      arrived_(goal) {
  clauses_.require(cone.ranges());
  for (const VarId input : cone.inputs()) {
    clauses_.require(cone.circuit().in_range(input));
  }
}

bool Ways::contains(const Values& state) const {
  return std::any_of(
      regions_.begin(), regions_.end(),
      [&](const Region& region) { return rung::contains(region, state); });
}

// --- runs --------------------------------------------------------------------

void Ways::start_in(const Values& state) {
  const StartingAt here(ts_, cone_.states(), state);
  terms_.reset();
}

Ways::Values Ways::state_now() const {
  Values values;
  for (const std::uint32_t state : cone_.states()) {
    values.set(state, terms_.state(state));
  }
  return values;
}

void Ways::scan(const std::vector<std::int64_t>& inputs) {
  for (std::size_t i = 0; i < cone_.inputs().size(); ++i) {
    terms_.set_input(cone_.inputs()[i], inputs[i]);
  }
  terms_.scan();
}

std::vector<std::int64_t> Ways::with_dt(std::vector<std::int64_t> inputs,
                                        std::int64_t dt) const {
  for (std::size_t i = 0; i < cone_.inputs().size(); ++i) {
    if (cone_.inputs()[i] == ts_.dt) inputs[i] = dt;
  }
  return inputs;
}

/// A stretch is quiet, so one scan as long as all of it ends in its last state.
/// Should it not be, what is made of the run fails its query.
std::vector<Ways::Hop> Ways::hops(const Values& state, const Run& run) {
  std::vector<Hop> result;
  start_in(state);
  for (const RunStep& step : run) {
    result.push_back(make_hop(step.inputs, false));
    if (step.delta <= 0) continue;
    result.push_back(make_hop(with_dt(step.inputs, step.delta), true));
  }
  return result;
}

/// A scan from the state that the terms are in.
Ways::Hop Ways::make_hop(const std::vector<std::int64_t>& inputs,
                         bool stretch) {
  Hop result{state_now(), inputs, stretch, {}};
  scan(inputs);
  result.after = state_now();
  return result;
}

std::vector<Ways::Hop> Ways::single_scans(const Hop& stretch) {
  std::vector<Hop> result;
  const std::vector<std::int64_t> inputs =
      with_dt(stretch.inputs, ts_.scan.max_ms);
  start_in(stretch.before);
  for (std::uint64_t i = 0; i < kSingleScans; ++i) {
    result.push_back(make_hop(inputs, false));
    if (contains(state_now())) return result;
  }
  return {};
}

Ways::Values Ways::end_of(const Values& state, const Run& run) {
  start_in(state);
  for (const RunStep& step : run) {
    scan(step.inputs);
    if (step.delta > 0) scan(with_dt(step.inputs, step.delta));
  }
  return state_now();
}

bool Ways::learn(const Values& state, const Run& run) {
  const std::vector<Hop> path = hops(state, run);
  for (std::size_t i = path.size(); i-- > 0 && !contains(state);) {
    if (contains(path[i].before)) continue;
    if (!(path[i].stretch ? add_stretch(path[i]) : add_scan(path[i]))) {
      return false;
    }
  }
  return contains(state);
}

bool Ways::step_from(const Values& state) {
  for (const Bound& bound : exactly(cone_, state)) {
    sat_.assume(literal(before_scan(ts_, bound)));
  }
  sat_.assume(literal(ts_.exprs.conjunction(allowed_, arrived_)));
  if (sat_.solve(kConflicts) != SatAnswer::Sat) return false;
  std::vector<std::int64_t> inputs;
  for (const VarId input : cone_.inputs()) {
    inputs.push_back(model_value(input));
  }
  start_in(state);
  return add_scan(make_hop(inputs, false));
}

std::int64_t Ways::model_value(VarId id) const {
  const Variable& var = ts_.vars[id];
  const Word& leaves = cone_.leaves(id);
  const std::size_t width = var.type == Type::Word ? 64 : 1;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < width; ++i) {
    const AigLit leaf = leaves[std::min(i, leaves.size() - 1)];
    bits |= std::uint64_t{clauses_.value(leaf)} << i;
  }
  // What the solver was not told of has no value yet.
  return std::clamp(static_cast<std::int64_t>(bits), var.low, var.high);
}

std::optional<Ways::Values> Ways::any_outside() {
  sat_.assume(-literal(inside_));
  sat_.assume(-literal(left_out_));
  if (sat_.solve(kConflicts) != SatAnswer::Sat) return std::nullopt;
  Values values;
  for (const std::uint32_t state : cone_.states()) {
    values.set(state, model_value(ts_.states[state].var));
  }
  return values;
}

void Ways::leave_out(const std::vector<Bound>& bounds) {
  left_out_ = ts_.exprs.disjunction(left_out_, before_scan(ts_, bounds));
}

// --- one region --------------------------------------------------------------

std::vector<Region::Held> Ways::held(
    const std::vector<std::int64_t>& inputs) const {
  std::vector<Region::Held> result;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const VarId input = cone_.inputs()[i];
    // What the encoding leaves open is not ours to choose.
    if (ts_.vars[input].role == VarRole::Choice) continue;
    result.push_back({input, inputs[i]});
  }
  return result;
}

/// What the scan from a state of the region must do.
ExprId Ways::claim(const Region& region) {
  ExprId end = arrived_;
  if (region.clock != Bound::kNone) {
    const ExprId stays = ts_.exprs.conjunction(after_scan(ts_, region.bounds),
                                               clock_grows(ts_, region));
    end = ts_.exprs.disjunction(end, stays);
  }
  return ts_.exprs.conjunction(allowed_, end);
}

/// Does every state of the region that is in no other lead on? Then, with
/// `take_core`, what that did not need is dropped.
bool Ways::leads_on(Region& region, bool take_core) {
  const int wrong = -literal(claim(region));
  const int outside = -literal(inside_);
  std::vector<int> bounds;
  std::vector<int> inputs;
  for (const Bound& bound : region.bounds) {
    bounds.push_back(literal(before_scan(ts_, bound)));
  }
  for (const Region::Held& one : region.held) {
    Region alone;
    alone.held = {one};
    inputs.push_back(literal(holds_inputs(ts_, alone)));
  }
  sat_.assume(wrong);
  sat_.assume(outside);
  for (const int bound : bounds) sat_.assume(bound);
  for (const int input : inputs) sat_.assume(input);
  if (sat_.solve(kConflicts) != SatAnswer::Unsat) return false;
  if (!take_core) return true;
  std::vector<Bound> core;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (sat_.failed(bounds[i])) core.push_back(region.bounds[i]);
  }
  region.bounds = std::move(core);
  return true;
}

/// Widens a region that leads on as far as it does; false when it does not.
bool Ways::widen(Region& region) {
  if (!leads_on(region, true)) return false;
  drop(region);
  for (std::size_t i = 0; i < region.bounds.size(); ++i) {
    widen_bound(region, i);
  }
  drop_inputs(region);
  return true;
}

void Ways::drop(Region& region) {
  for (std::size_t i = region.bounds.size(); i-- > 0;) {
    if (i >= region.bounds.size()) continue;  // a core took more than one
    Region less = region;
    less.bounds.erase(less.bounds.begin() + static_cast<std::ptrdiff_t>(i));
    if (leads_on(less, true)) region = std::move(less);
  }
}

/// By halves: the loosest value of a number's bound that still does.
void Ways::widen_bound(Region& region, std::size_t i) {
  const Bound bound = region.bounds[i];
  const Variable& var = ts_.vars[ts_.states[bound.state].var];
  if (var.type == Type::Bit || bound.minus != Bound::kNone) return;
  std::int64_t good = bound.value;
  std::int64_t bad = bound.at_most ? var.high : var.low;
  while (good != bad) {
    // Rounded towards `bad`, so that the last step is taken too.
    const std::int64_t half = bound.at_most ? good + (bad - good + 1) / 2
                                            : good - (good - bad + 1) / 2;
    region.bounds[i].value = half;
    if (leads_on(region, false)) {
      good = half;
    } else {
      bad = bound.at_most ? half - 1 : half + 1;
    }
  }
  region.bounds[i].value = good;
}

void Ways::drop_inputs(Region& region) {
  for (std::size_t i = region.held.size(); i-- > 0;) {
    Region less = region;
    less.held.erase(less.held.begin() + static_cast<std::ptrdiff_t>(i));
    if (leads_on(less, false)) region = std::move(less);
  }
}

void Ways::add(Region region) {
  inside_ = ts_.exprs.disjunction(inside_, before_scan(ts_, region.bounds));
  arrived_ = ts_.exprs.disjunction(arrived_, after_scan(ts_, region.bounds));
  regions_.push_back(std::move(region));
}

/// How much of the numbers' ranges the bounds leave out.
double Ways::narrowness(const Region& region) const {
  double sum = 0;
  for (const Bound& bound : region.bounds) {
    const Variable& var = ts_.vars[ts_.states[bound.state].var];
    sum += static_cast<double>(bound.at_most ? var.high - bound.value
                                             : bound.value - var.low);
  }
  return sum;
}

/// With the shortest scan, the longest, or that of the run: a short one
/// crosses no bound, a long one does from afar.
bool Ways::add_scan(const Hop& hop) {
  if (is_quiet(hop) && grows_on(hop)) return true;
  std::optional<Region> best;
  std::vector<std::vector<std::int64_t>> choices = {
      hop.inputs, with_dt(hop.inputs, ts_.scan.min_ms),
      with_dt(hop.inputs, ts_.scan.max_ms)};
  for (const std::vector<std::int64_t>& inputs : choices) {
    Region region;
    region.bounds = exactly(cone_, hop.before);
    region.held = held(inputs);
    if (!widen(region)) continue;
    const bool any_time = std::none_of(
        region.held.begin(), region.held.end(),
        [&](const Region::Held& one) { return one.input == ts_.dt; });
    const bool better =
        !best || std::pair(region.bounds.size(), narrowness(region)) <
                     std::pair(best->bounds.size(), narrowness(*best));
    if (better) best = std::move(region);
    if (any_time || narrowness(*best) == 0) break;
  }
  if (!best) return false;
  add(std::move(*best));
  return true;
}

// --- stretches ---------------------------------------------------------------

std::vector<std::uint32_t> Ways::running_clocks(const Hop& hop) const {
  std::vector<std::uint32_t> clocks;
  for (const std::uint32_t state : cone_.states()) {
    if (!ts_.states[state].clock) continue;
    if (hop.after[state] > hop.before[state]) clocks.push_back(state);
  }
  return clocks;
}

/// Only clocks change in it.
bool Ways::is_quiet(const Hop& hop) const {
  return std::all_of(
      cone_.states().begin(), cone_.states().end(), [&](std::uint32_t state) {
        return ts_.states[state].clock || hop.before[state] == hop.after[state];
      });
}

/// As a region of many scans, in which a clock grows.
bool Ways::grows_on(const Hop& hop) {
  const std::vector<std::uint32_t> clocks = running_clocks(hop);
  for (const bool relations : {false, true}) {
    for (const std::uint32_t clock : clocks) {
      for (const std::int64_t dt : {ts_.scan.max_ms, ts_.scan.min_ms}) {
        if (try_stretch(hop, clock, relations, dt)) return true;
        if (ts_.scan.max_ms == ts_.scan.min_ms) break;
      }
    }
    if (clocks.size() < 2) break;
  }
  return false;
}

bool Ways::add_stretch(const Hop& hop) {
  if (grows_on(hop)) return true;
  const std::vector<Hop> scans = single_scans(hop);
  for (std::size_t i = scans.size(); i-- > 0;) {
    if (!contains(scans[i].before) && !add_scan(scans[i])) return false;
  }
  return contains(hop.before);
}

/// Clocks may be anything from where they are now on; with `relations`, those
/// that run together keep their distances.
bool Ways::try_stretch(const Hop& hop, std::uint32_t clock, bool relations,
                       std::int64_t dt) {
  const std::vector<std::uint32_t> clocks = running_clocks(hop);
  Region region;
  region.clock = clock;
  region.held = held(with_dt(hop.inputs, dt));
  for (const Bound& bound : exactly(cone_, hop.before)) {
    const bool runs =
        std::find(clocks.begin(), clocks.end(), bound.state) != clocks.end();
    if (!runs || !bound.at_most) region.bounds.push_back(bound);
  }
  for (const std::uint32_t other : clocks) {
    if (!relations || other == clock) continue;
    const std::int64_t apart = hop.before[other] - hop.before[clock];
    region.bounds.push_back({other, clock, false, apart});
    region.bounds.push_back({other, clock, true, apart});
  }
  if (!widen(region)) return false;
  add(std::move(region));
  return true;
}

}  // namespace rung
