#include "frontend/ldmicro/rung_writer.h"

#include <string>

#include "frontend/ladder/words.h"
#include "frontend/token_list.h"

namespace rung::ldmicro {

using ladder::name_of;
using ladder::power_of;

void RungWriter::write(const ProgramText::Rung& rung) {
  flow_.begin(master_, rung.where);
  for (const Step& step : rung.steps) {
    switch (step.kind) {
      case Step::Kind::Open:
        flow_.open(step);
        break;
      case Step::Kind::Next:
        flow_.next(step);
        break;
      case Step::Kind::Close:
        flow_.close(step);
        break;
      case Step::Kind::Instruction: {
        const Instruction& it = text_.instructions[step.instruction];
        if (it.kind->op == Op::Placeholder && rung.steps.size() > 1) {
          errors_.error("RP051", it.where,
                        "a placeholder stands alone in its rung");
        }
        instruction(it, step);
        break;
      }
    }
  }
  flow_.finish(rung.where);
}

void RungWriter::instruction(const Instruction& it, const Step& step) {
  switch (it.kind->op) {
    case Op::Contacts:
      return contact(it);
    case Op::Coil:
      return coil(it, step);
    case Op::Short:
    case Op::Placeholder:
      return;
    case Op::Open:
      return flow_.contact(ladder::truth(false, it.where), it.where);
    case Op::MasterRelay:
      return master_relay(it);
    case Op::TimerOn:
    case Op::TimerOff:
    case Op::TimerRetentive:
      return timer(it);
    case Op::CountUp:
    case Op::CountDown:
    case Op::CountCircular:
    case Op::CountReverse:
      return counter(it);
    case Op::Reset:
      return reset(it);
    case Op::OneShotRising:
      return edge("RISE", it.where);
    case Op::OneShotFalling:
      return edge("FALL", it.where);
    case Op::OneShotLow:
      return one_shot_low(it.where);
    case Op::Oscillator:
      return oscillator(it.where);
    case Op::Compare:
      return compare(it);
    case Op::Move:
      return move(it);
    case Op::Arithmetic:
      return arithmetic(it);
  }
}

void RungWriter::contact(const Instruction& it) {
  const Word& name = it.operands[0];
  const auto negated = number_of(it.operands[1].text);
  const auto set = it.operands.size() > 2 ? number_of(it.operands[2].text) : 0;
  if (!negated || !set || *negated < 0 || *negated > 1) {
    errors_.error("RP053", it.where,
                  "0 or 1 is expected behind the name of a contact");
    return;
  }
  // For an input it is what the simulation of the tool begins with.
  if (*set != 0 && !name.text.starts_with("X")) {
    errors_.error("RP087", it.operands[2].where,
                  "an initial value of a contact that is no input is not "
                  "supported");
  }
  const std::string_view cell = names_.contact(name);
  if (cell.empty()) return;
  Expression condition = name_of(cell, name.where);
  if (*negated != 0) push_unary(condition, AstOp::Not, it.where);
  flow_.contact(condition, it.where);
}

void RungWriter::coil(const Instruction& it, const Step& step) {
  std::size_t flag = 0;
  for (std::size_t i = 1; i < it.operands.size(); ++i) {
    const auto value = number_of(it.operands[i].text);
    if (!value || *value < 0 || *value > 1 || (*value == 1 && flag != 0)) {
      errors_.error("RP053", it.operands[i].where,
                    "behind the name of a coil 0 is expected, or 1 for one of "
                    "negated, set, reset, toggled");
      return;
    }
    if (*value == 1) flag = i;
  }
  const std::string_view target = names_.coil(it.operands[0]);
  if (!target.empty()) coil_value(target, flag, it, step);
}

void RungWriter::coil_value(std::string_view target, std::size_t flag,
                            const Instruction& it, const Step& step) {
  enum : std::size_t { Plain, Negated, Set, Reset, Toggled };
  const SourceRange name = it.operands[0].where;
  // The power stands on the left, which is always evaluated: it may be that of
  // a timer.
  Expression value = flow_.use(step);
  if (flag == Toggled) {
    value = out_.call("RISE", value, out_.element("edge", {}, it.where), {},
                      it.where);
  }
  if (flag == Negated || flag == Reset) {
    push_unary(value, AstOp::Not, it.where);
  }
  if (flag > Negated) push_leaf(value, AstOp::Name, target, name);
  if (flag == Set) push_binary(value, AstOp::Or, it.where);
  if (flag == Reset) push_binary(value, AstOp::And, it.where);
  if (flag == Toggled) push_binary(value, AstOp::Xor, it.where);
  out_.assign(target, false, name, value, it.where);
}

void RungWriter::compare(const Instruction& it) {
  Expression condition = names_.operand(it.operands[0]);
  const Expression right = names_.operand(it.operands[1]);
  if (condition.empty() || right.empty()) return;
  push_all(condition, right);
  push_binary(condition, it.kind->operation, it.where);
  flow_.contact(condition, it.where);
}

void RungWriter::store(const Names::Integer& target, const Expression& value,
                       SourceRange target_where, SourceRange where) {
  out_.set_guard(flow_.hold(where));
  out_.assign(target.name, true, target_where, value, where);
  out_.set_guard({});
}

void RungWriter::move(const Instruction& it) {
  const Word& name = it.operands[0];
  if (names_.is_clock(name.text)) return reset_clock(name.text, it.where);
  const Names::Integer target = names_.integer(name);
  Expression value = names_.operand(it.operands[1]);
  if (target.name.empty() || value.empty()) return;
  if (target.shape.high < kInt16Cell.high) {
    ladder::wrap(value, target.bits(), it.where);
  }
  store(target, value, name.where, it.where);
}

void RungWriter::arithmetic(const Instruction& it) {
  const Names::Integer target = names_.integer(it.operands[0]);
  Expression value = names_.operand(it.operands[1]);
  const Expression right = names_.operand(it.operands[2]);
  if (target.name.empty() || value.empty() || right.empty()) return;
  const bool remainder = it.kind->operation == AstOp::Negate;
  const bool divides = remainder || it.kind->operation == AstOp::Divide;
  const auto divisor = number_of(it.operands[2].text);
  if (divides && (!divisor || *divisor == 0)) {
    errors_.error("RP053", it.operands[2].where,
                  "the divisor must be a number other than 0");
    return;
  }
  if (remainder) {  // a - a / b * b
    const Expression left = value;
    push_all(value, left);
    push_all(value, right);
    push_binary(value, AstOp::Divide, it.where);
    push_all(value, right);
    push_binary(value, AstOp::Multiply, it.where);
    push_binary(value, AstOp::Subtract, it.where);
  } else {
    push_all(value, right);
    push_binary(value, it.kind->operation, it.where);
  }
  ladder::wrap(value, target.bits(), it.where);
  store(target, value, it.operands[0].where, it.where);
}

void RungWriter::reset_clock(std::string_view name, SourceRange where) {
  const Names::Clock& clock = names_.clock(name, where);
  const std::string_view operation = clock.op == Op::TimerOn    ? "TON.RES"
                                     : clock.op == Op::TimerOff ? "TOF.RES"
                                                                : "RTO.RES";
  const Expression power = power_of(flow_.hold(where), where);
  out_.keep("reset", kBitCell,
            out_.call(operation, power, clock.index, {}, where), where);
}

void RungWriter::reset(const Instruction& it) {
  const Word& name = it.operands[0];
  if (!name.text.starts_with("T") && !name.text.starts_with("C")) {
    errors_.error("RP052", name.where,
                  quoted_excerpt(name.text) +
                      " cannot be reset: timers (T...) and counters (C...) "
                      "can");
    return;
  }
  if (names_.is_clock(name.text)) return reset_clock(name.text, it.where);
  const Names::Integer target = names_.integer(name);
  if (target.name.empty()) return;
  Expression value;
  push_leaf(value, AstOp::Number,
            out_.keep_text(std::to_string(names_.initial(name.text))),
            it.where);
  store(target, value, name.where, it.where);
}

// The relay is on at the begin of a scan. Where it is off, any power or none
// switches it on: the rung that closes a section need not be true.
void RungWriter::master_relay(const Instruction& it) {
  const std::string_view power = flow_.hold(it.where);
  if (master_.empty() || power.empty() || power == master_) {
    master_ = master_.empty() ? power : std::string_view{};
    return;
  }
  Expression value = name_of(master_, it.where);
  push_unary(value, AstOp::Not, it.where);
  push_leaf(value, AstOp::Name, power, it.where);
  push_binary(value, AstOp::Or, it.where);
  master_ = out_.keep("master", kBitCell, value, it.where);
}

void RungWriter::edge(std::string_view operation, SourceRange where) {
  const Expression power = flow_.take(where);
  flow_.set(
      out_.call(operation, power, out_.element("edge", {}, where), {}, where),
      true);
}

// The power without its first scan of false; false until it was true once.
void RungWriter::one_shot_low(SourceRange where) {
  const Expression power = power_of(flow_.hold(where), where);
  const std::string_view passed = out_.make("low", kBitCell, where);
  const std::string_view high = out_.make("low", kBitCell, where);
  Expression result = power;
  push_leaf(result, AstOp::Name, passed, where);
  push_binary(result, AstOp::Or, where);
  const std::string_view kept = out_.keep("low", kBitCell, result, where);
  Expression next = power;
  push_unary(next, AstOp::Not, where);
  push_leaf(next, AstOp::Name, high, where);
  push_binary(next, AstOp::And, where);
  out_.assign(passed, false, where, next, where);
  Expression was = name_of(high, where);
  push_all(was, power);
  push_binary(was, AstOp::Or, where);
  out_.assign(high, false, where, was, where);
  flow_.set(name_of(kept, where));
}

void RungWriter::oscillator(SourceRange where) {
  Expression value = flow_.take(where);
  const std::string_view on = out_.make("osc", kBitCell, where);
  push_leaf(value, AstOp::Name, on, where);
  push_unary(value, AstOp::Not, where);
  push_binary(value, AstOp::And, where);
  out_.assign(on, false, where, value, where);
  flow_.set(name_of(on, where));
}

}  // namespace rung::ldmicro
