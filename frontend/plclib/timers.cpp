#include <utility>

#include "frontend/plclib/machine.h"

namespace rung::plclib {
namespace {

constexpr std::int64_t kLongestPeriod = 24LL * 24 * 3'600 * 1'000;
constexpr std::int64_t kCounterDelay = 50;  // delay(50) in counter()

}  // namespace

std::optional<std::int64_t> Machine::period(const Argument& argument) {
  const auto given = argument_value(argument);
  if (!given) return std::nullopt;
  const auto value = given->constant();
  if (!value || *value < 0 || *value > kLongestPeriod) {
    fail("RP058", argument.where,
         "the period of a timer must be constant, and 24 days or less");
    return std::nullopt;
  }
  return value;
}

Machine::Timer* Machine::timer_of(const Argument& argument,
                                  std::string_view kind) {
  const auto variable = variables_.find(argument.name);
  if (variable == variables_.end() || !variable->second.timer) {
    fail("RP058", argument.where, "a timer's variable is expected here");
    return nullptr;
  }
  const auto [place, is_new] = timers_.try_emplace(argument.name);
  Timer& timer = place->second;
  if (is_new) {
    timer.kind = kind;
    timer.blocked = blocked_;
    timer.where = argument.where;
    // The second variable of a cycle has no element of its own.
    if (!kind.empty()) {
      timer.index = writer_.element(kind, argument.name, argument.where);
    }
  }
  if (timer.kind != kind) {
    fail("RP058", argument.where,
         quoted_excerpt(argument.name) +
             " is the variable of a timer of another kind, too: that is not "
             "supported");
    return nullptr;
  }
  if (timer.blocked != blocked_) {
    fail("RP055", argument.where,
         quoted_excerpt(argument.name) +
             " is used before and after a call that takes time in one scan: "
             "that is not supported");
    return nullptr;
  }
  return &timer;
}

void Machine::timer(const Call& call, std::string_view operation) {
  Timer* const timer = timer_of(
      call.arguments[0], reading_.thesis ? "timer-plclib" : "timer-plclib14");
  const auto time = period(call.arguments[1]);
  if (timer == nullptr || !time) return;
  // Off-delay and pulse pass on what is neither 0 nor 1.
  const bool passes = operation == "timerOff" || operation == "timerPulse" ||
                      (reading_.thesis && operation == "timerOn");
  if (passes && !accumulator_is_bit(call)) return;
  const Value input = arithmetic_.truth(acc_);
  acc_ = kept_call(operation, call.arguments[0].name, input.nodes, timer->index,
                   time, call.where);
}

void Machine::cycle(const Call& call, std::string_view name, std::size_t second,
                    std::array<std::int64_t, 2> periods) {
  const Argument& first = call.arguments[0];
  const Argument& other = call.arguments[second];
  Timer* const timer =
      timer_of(first, reading_.thesis ? "cycle-plclib" : "cycle-plclib14");
  if (timer == nullptr || timer_of(other, {}) == nullptr) return;
  Timer& partner = timers_.at(other.name);
  if ((!timer->partner.empty() && timer->partner != other.name) ||
      (!partner.partner.empty() && partner.partner != first.name)) {
    return fail("RP058", other.where,
                quoted_excerpt(other.name) +
                    " belongs to another pair of timers: that is not "
                    "supported");
  }
  timer->partner = other.name;
  partner.partner = first.name;
  const Value input = arithmetic_.kept(arithmetic_.truth(acc_), "scanValue");
  for (std::size_t half = 0; half < 2; ++half) {
    const std::string_view operation = writer_.keep_text(
        std::string(name) + (half == 0 ? ".first" : ".second"));
    acc_ = kept_call(operation, first.name, input.nodes, timer->index,
                     periods[half], call.where);
  }
}

void Machine::call_timer_cycle(const Call& call) {
  const auto low = period(call.arguments[1]);
  const auto high = period(call.arguments[3]);
  if (low && high) cycle(call, "timerCycle", 2, {*low, *high});
}

void Machine::call_m8013(const Call& call) {
  cycle(call, "m8013", 1, {1'000, 1'000});
}

/// Time passes within the scan: the program waits.
void Machine::block(std::int64_t ms, SourceRange where) {
  if (in_setup_) return;
  if (!writer_.guard().empty()) {
    return fail("RP055", where,
                "a call that takes time, under a condition or in a task, is "
                "not supported");
  }
  for (const Task& task : sketch_.tasks) {
    if (task.period_ms > ms) continue;
    return fail("RP055", where,
                "this call takes " + std::to_string(ms) +
                    " ms, and a task may run more than once in it: that is "
                    "not supported");
  }
  blocked_ += ms;
}

/// The variables of counter(): count, current and previous state.
bool Machine::are_counter_cells(const Call& call) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Argument& cell = call.arguments[i];
    const auto found = variables_.find(cell.name);
    bool good = found != variables_.end() && found->second.type == CType::Int;
    for (std::size_t other = 0; other < i; ++other) {
      good = good && call.arguments[other].name != cell.name;
    }
    if (good) continue;
    fail("RP058", cell.where,
         "a variable of type `int` of its own is expected here");
    return false;
  }
  return accumulator_is_bit(call);
}

void Machine::count(const Call& call, bool shows_state) {
  if (!are_counter_cells(call)) return;
  const auto given = argument_value(call.arguments[3]);
  if (!given) return;
  const auto limit = given->constant();
  if (!limit || *limit < 0) {
    return fail("RP058", call.arguments[3].where,
                "the limit of a counter must be constant, and not negative");
  }
  const SourceRange where = call.where;
  const auto value_of = [&](std::size_t i) {
    return *argument_value(call.arguments[i]);
  };
  const Value max = arithmetic_.number(*limit, CType::Int, where);
  const Value below = arithmetic_.kept(
      *arithmetic_.binary("<", value_of(0), max, where), "below");
  const Value input = fresh(arithmetic_.truth(acc_), "counted");
  const Value current =
      arithmetic_.kept(Arithmetic::conjunction(input, below), "counting");
  const Value was = *arithmetic_.binary(
      "==", value_of(2), arithmetic_.number(1, CType::Int, where), where);
  const Value counts = arithmetic_.kept(
      Arithmetic::conjunction(current, Arithmetic::negation(was)), "counts");
  const Value old = value_of(0);
  Value sum = *arithmetic_.binary("+", old, counts, where);
  // It is 1 more only where it was below the limit.
  sum.range = {old.range.low, std::max(old.range.high, *limit)};
  sum.overflows = false;
  assign(call.arguments[1].name, current, where);
  assign(call.arguments[0].name, std::move(sum), where);
  assign(call.arguments[2].name, current, where);
  acc_ = current;
  if (!shows_state) return block(kCounterDelay, where);
  // An input that could not count stays.
  const Value full = *arithmetic_.binary("==", value_of(0), max, where);
  acc_ = arithmetic_.kept(
      Arithmetic::disjunction(
          Arithmetic::conjunction(input, Arithmetic::negation(below)), full),
      "scanValue");
}

void Machine::call_delay(const Call& call) {
  const auto time = period(call.arguments[0]);
  if (time) block(*time, call.where);
}

}  // namespace rung::plclib
