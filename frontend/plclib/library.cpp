#include <utility>

#include "frontend/plclib/machine.h"

namespace rung::plclib {

std::span<const Machine::LibraryCall> Machine::library() {
  // The thesis's `in`-like calls take pins only; call_operand() knows.
  static constexpr std::array<LibraryCall, 32> kCalls = {{
      {"load", true, false, 1, &Machine::call_in},
      {"loadInv", true, false, 1, &Machine::call_in_not},
      {"andLogic", true, false, 1, &Machine::call_and},
      {"andInv", true, false, 1, &Machine::call_and_not},
      {"orLogic", true, false, 1, &Machine::call_or},
      {"orInv", true, false, 1, &Machine::call_or_not},
      {"timerDelay", true, false, 2, &Machine::call_timer_delay},
      {"m8013", true, false, 2, &Machine::call_m8013},
      {"counter", true, false, 4, &Machine::call_counter},
      {"counterState", true, false, 4, &Machine::call_counter_state},
      {"in", false, true, 1, &Machine::call_in},
      {"inNot", false, true, 1, &Machine::call_in_not},
      {"inAnalog", false, true, 1, &Machine::call_in_analog},
      {"andBit", false, true, 1, &Machine::call_and},
      {"andNotBit", false, true, 1, &Machine::call_and_not},
      {"orBit", false, true, 1, &Machine::call_or},
      {"orNotBit", false, true, 1, &Machine::call_or_not},
      {"xorBit", false, true, 1, &Machine::call_xor},
      {"outNot", false, true, 1, &Machine::call_out_not},
      {"outPWM", false, true, 1, &Machine::call_out_pwm},
      {"latch", false, true, 2, &Machine::call_latch},
      {"timerOff", false, true, 2, &Machine::call_timer_off},
      {"timerPulse", false, true, 2, &Machine::call_timer_pulse},
      {"timerCycle", false, true, 4, &Machine::call_timer_cycle},
      {"compareGT", false, true, 1, &Machine::call_compare_gt},
      {"compareLT", false, true, 1, &Machine::call_compare_lt},
      {"out", true, true, 1, &Machine::call_out},
      {"set", true, true, 1, &Machine::call_set},
      {"reset", true, true, 1, &Machine::call_reset},
      {"timerOn", true, true, 2, &Machine::call_timer_on},
      {"delay", true, true, 1, &Machine::call_delay},
      {"digitalWrite", true, true, 2, &Machine::call_digital_write},
  }};
  return kCalls;
}

const Machine::LibraryCall* Machine::find_call(std::string_view name) {
  for (const LibraryCall& row : library()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

/// A call of the library or of an object's method; its value where that is
/// wanted.
std::optional<Value> Machine::call(bool wanted) {
  if (cursor_.at(".", 1)) return method_call(wanted);
  Call call{cursor_.text(), {}, cursor_.here()};
  const LibraryCall* const row = find_call(call.name);
  if (row == nullptr) {
    fail("RP055", call.where,
         "the call of " + cursor_.shown() + " is not supported");
    return std::nullopt;
  }
  if (reading_.thesis ? !row->thesis : !row->published) {
    fail("RP058", call.where,
         quoted_excerpt(call.name) +
             " is a call of the other library of this name: the semantics "
             "are those of `" +
             (reading_.thesis ? "plclib" : "plclib14") + "`");
    return std::nullopt;
  }
  cursor_.take();
  cursor_.take();
  auto given = arguments();
  if (!given) return std::nullopt;
  call.arguments = std::move(*given);
  if (call.arguments.size() != row->arguments) {
    fail("RP056", call.where,
         quoted_excerpt(call.name) + " has " + std::to_string(row->arguments) +
             (row->arguments == 1 ? " argument" : " arguments"));
    return std::nullopt;
  }
  const bool arduino = row->run == &Machine::call_digital_write ||
                       row->run == &Machine::call_delay;
  if (in_setup_ && !arduino) {
    fail("RP055", call.where,
         quoted_excerpt(call.name) + " in setup() is not supported");
    return std::nullopt;
  }
  (this->*row->run)(call);
  Value value;
  value.type = CType::Void;
  if (arduino || !wanted) return value;
  keep_accumulator();
  value = acc_;
  value.type = CType::Unsigned;
  return value;
}

// --- operands ----------------------------------------------------------------

bool Machine::is_pin(const Argument& argument) const {
  if (argument.name.empty()) {
    return !is_unsigned(argument.value.type);
  }
  if (counters_.contains(argument.name)) {
    return !is_unsigned(counters_.at(argument.name).type);
  }
  const auto found = variables_.find(argument.name);
  return found == variables_.end() || !is_unsigned(found->second.type);
}

/// The pin whose number an argument of type `int` is.
Machine::Pin* Machine::pin_of(const Argument& argument) {
  if (argument.name.empty()) {
    const auto number = argument.value.constant();
    if (!number) {
      fail("RP058", argument.where,
           "an argument of type `int` is the number of a pin, and this one is "
           "not constant");
      return nullptr;
    }
    return pin_at(*number, {}, argument.where);
  }
  const auto found = variables_.find(argument.name);
  if (found == variables_.end()) {
    const auto counter = counters_.find(argument.name);
    if (counter != counters_.end()) {
      return pin_at(*counter->second.constant(), {}, argument.where);
    }
    if (const auto number = pin_number(argument.name)) {
      return pin_at(*number, argument.name, argument.where);
    }
    fail("RP057", argument.where,
         "there is no pin or variable " + quoted_excerpt(argument.name));
    return nullptr;
  }
  Variable& variable = found->second;
  const Range range = estimate(argument.name, variable);
  if (range.low != range.high || is_unsigned(variable.type)) {
    fail("RP058", argument.where,
         quoted_excerpt(argument.name) + " is of type `" +
             std::string(to_string(variable.type)) +
             "`, which the library takes for the number of a pin; " +
             (is_unsigned(variable.type)
                  ? "a variable is not read by this call"
                  : "it is not constant. Variables are `unsigned int` or "
                    "`unsigned long`"));
    return nullptr;
  }
  variable.pin = true;
  return pin_at(range.low, argument.name, argument.where);
}

/// What `in`, `andBit` and so on take: a pin is sampled, a variable is read.
std::optional<Value> Machine::call_operand(const Argument& argument,
                                           bool analog) {
  if (is_pin(argument) || reading_.thesis) {
    Pin* const pin = pin_of(argument);
    if (pin == nullptr) return std::nullopt;
    return sample(*pin, analog, argument.where);
  }
  return argument_value(argument);
}

std::optional<Value> Machine::argument_value(const Argument& argument) {
  if (argument.name.empty()) return argument.value;
  return named_value(argument.name, argument.where);
}

/// The value of an output, as `set` and `latch` read it.
std::optional<Value> Machine::target_value(const Argument& argument) {
  if (!is_pin(argument) && !reading_.thesis) {
    return call_operand(argument, false);
  }
  Pin* const pin = pin_of(argument);
  if (pin == nullptr) return std::nullopt;
  if (modes_unknown_ &&
      estimates_.written_pins.insert(std::string(pin->name)).second) {
    estimates_.grown = true;
  }
  return sample(*pin, false, argument.where);
}

void Machine::write_target(const Argument& argument, Value bit,
                           SourceRange where) {
  if (!is_pin(argument) && !reading_.thesis) {
    if (argument.name.empty() || !variables_.contains(argument.name)) {
      return fail("RP058", argument.where,
                  "this is no variable that can be written");
    }
    bit.type = CType::Unsigned;
    return assign(argument.name, std::move(bit), where);
  }
  if (Pin* const pin = pin_of(argument)) {
    write_pin(*pin, std::move(bit), false, where);
  }
}

// --- bits --------------------------------------------------------------------

void Machine::call_in(const Call& call) {
  load(call_operand(call.arguments[0], false), call.where);
}

void Machine::call_in_not(const Call& call) {
  auto value = call_operand(call.arguments[0], false);
  if (value) acc_ = Arithmetic::negation(arithmetic_.is_one(std::move(*value)));
}

void Machine::call_in_analog(const Call& call) {
  load(call_operand(call.arguments[0], true), call.where);
}

/// The accumulator is an `int`.
void Machine::load(std::optional<Value> value, SourceRange where) {
  if (value &&
      (value->overflows ||
       !range_of(CType::Int, reading_.int_bits()).contains(value->range))) {
    fail("RP055", where,
         "`scanValue` may leave the range of `int` here: that is not "
         "supported");
    value.reset();
  }
  acc_ = value ? std::move(*value) : arithmetic_.number(0, CType::Int, where);
  shorten();
}

void Machine::logic(const Call& call, std::string_view op) {
  auto right = call_operand(call.arguments[0], false);
  if (!right) return;
  auto value =
      arithmetic_.binary(op, std::move(acc_), std::move(*right), call.where);
  if (!value) fail("RP055", call.where, arithmetic_.why());
  load(std::move(value), call.where);
}

/// An accumulator of 1 stays, any other becomes the negation of the operand:
/// tested with `== 0`.
void Machine::call_or_not(const Call& call) {
  auto right = call_operand(call.arguments[0], false);
  if (!right) return;
  acc_ = Arithmetic::disjunction(
      arithmetic_.is_one(std::move(acc_)),
      Arithmetic::negation(arithmetic_.truth(std::move(*right))));
}

void Machine::call_out(const Call& call) {
  if (!acc_.is_bit()) {
    keep_accumulator();
    return write_target(call.arguments[0], arithmetic_.is_one(acc_),
                        call.where);
  }
  // What was written is the accumulator.
  const Value value = arithmetic_.is_one(
      std::exchange(acc_, arithmetic_.number(0, CType::Int, call.where)));
  write_target(call.arguments[0], value, call.where);
  if (auto written = target_value(call.arguments[0])) {
    acc_ = std::move(*written);
  }
}

void Machine::call_out_not(const Call& call) {
  keep_accumulator();
  write_target(call.arguments[0],
               Arithmetic::negation(arithmetic_.is_one(acc_)), call.where);
}

void Machine::call_out_pwm(const Call& call) {
  keep_accumulator();
  if (acc_.range.low < 0 || acc_.range.high > 1023) {
    return fail("RP055", call.where,
                "`outPWM` of a `scanValue` that may be above 1023 is not "
                "supported");
  }
  auto width = arithmetic_.binary(
      "/", acc_, arithmetic_.number(4, CType::Int, call.where), call.where);
  Pin* const pin = pin_of(call.arguments[0]);
  if (pin != nullptr && width) {
    write_pin(*pin, std::move(*width), true, call.where);
  }
}

/// The output's value goes into the accumulator, and stays there.
void Machine::call_set(const Call& call) {
  const auto old = target_value(call.arguments[0]);
  if (!old) return;
  auto value = arithmetic_.binary("|", std::move(acc_), *old, call.where);
  acc_ =
      value ? std::move(*value) : arithmetic_.number(0, CType::Int, call.where);
  if (!value) return fail("RP055", call.where, arithmetic_.why());
  if (acc_.is_bit()) return call_out(call);
  keep_accumulator();
  const Value set = arithmetic_.is_one(acc_);
  if (old->is_bit()) {
    return write_target(call.arguments[0],
                        Arithmetic::disjunction(set, arithmetic_.truth(*old)),
                        call.where);
  }
  assign(call.arguments[0].name,
         arithmetic_.choose(set,
                            arithmetic_.number(1, CType::Unsigned, call.where),
                            *old, call.where),
         call.where);
}

void Machine::call_reset(const Call& call) {
  keep_accumulator();
  auto old = target_value(call.arguments[0]);
  if (!old) return;
  const Value stays = Arithmetic::negation(arithmetic_.is_one(acc_));
  if (old->is_bit()) {
    return write_target(
        call.arguments[0],
        Arithmetic::conjunction(arithmetic_.truth(std::move(*old)), stays),
        call.where);
  }
  const auto kept = arithmetic_.binary("*", std::move(*old), stays, call.where);
  if (kept) assign(call.arguments[0].name, *kept, call.where);
}

void Machine::call_latch(const Call& call) {
  const auto old = target_value(call.arguments[0]);
  if (!old) return;
  auto latched = arithmetic_.binary("|", std::move(acc_), *old, call.where);
  const auto reset = call_operand(call.arguments[1], false);
  std::optional<Value> value;
  if (latched && reset) {
    value = arithmetic_.binary("&~", std::move(*latched), *reset, call.where);
  }
  acc_ =
      value ? std::move(*value) : arithmetic_.number(0, CType::Int, call.where);
  if (value) return call_out(call);
  if (reset) fail("RP055", call.where, arithmetic_.why());
}

void Machine::compare(const Call& call, std::string_view op) {
  auto right = call_operand(call.arguments[0], true);
  if (!right) return;
  auto value =
      arithmetic_.binary(op, std::move(acc_), std::move(*right), call.where);
  if (!value) fail("RP055", call.where, arithmetic_.why());
  acc_ =
      value ? std::move(*value) : arithmetic_.number(0, CType::Int, call.where);
}

void Machine::call_digital_write(const Call& call) {
  auto value = argument_value(call.arguments[1]);
  if (!value) return;
  value = arithmetic_.settled(std::move(*value));
  if (!value) return fail("RP055", call.where, arithmetic_.why());
  Pin* const target = pin_of(call.arguments[0]);
  if (target == nullptr) return;
  if (!in_setup_) {
    return write_pin(*target, arithmetic_.truth(*value), false, call.where);
  }
  const auto constant = value->constant();
  if (!constant) {
    return fail("RP055", call.where,
                "a value that is not constant in setup() is not supported");
  }
  target->initial = *constant != 0 ? 1 : 0;
}

}  // namespace rung::plclib
