#include <string>

#include "frontend/ladder/words.h"
#include "frontend/ldmicro/rung_writer.h"
#include "frontend/token_list.h"

// Timers and counters. A timer counts scans of a fixed length; where nothing
// but resets looks at the count it is an element with a clock, else a number.

namespace rung::ldmicro {

using ladder::both;
using ladder::name_of;
using ladder::power_of;
using ladder::word_of;

// --- timers ------------------------------------------------------------------

std::optional<std::int64_t> RungWriter::period(const Instruction& it) {
  constexpr std::int64_t kLongest = 0x7fff'ffff;
  const auto delay = number_of(it.operands[1].text);
  const auto adjust =
      it.operands.size() > 2 ? number_of(it.operands[2].text) : adjust_;
  if (!delay || !adjust || *delay < 0 || *adjust < -kLongest ||
      *adjust > kLongest) {
    errors_.error("RP053", it.where,
                  "the delay of a timer must be a number of us, and the "
                  "adjustment one of cycles");
    return std::nullopt;
  }
  const std::int64_t scans = *delay / text_.cycle_us + *adjust;
  const std::int64_t most = names_.largest(it.operands[0].text);
  if (scans < 1 || scans > most || *delay > 1000 * kLongest ||
      scans * (text_.cycle_us / 1000) > kLongest) {
    errors_.error("RP053", it.where,
                  scans < 1 ? "the delay of this timer is less than a cycle"
                            : "the delay of this timer is too long");
    return std::nullopt;
  }
  return scans;
}

void RungWriter::timer(const Instruction& it) {
  const Word& name = it.operands[0];
  if (!name.text.starts_with("T")) {
    errors_.error("RP052", name.where,
                  quoted_excerpt(name.text) + " is no name of a timer: T...");
    return;
  }
  const auto scans = period(it);
  if (!scans) return;
  if (!names_.is_clock(name.text)) return counted_timer(it, *scans);
  const Names::Clock& clock = names_.clock(name.text, name.where);
  const Expression power = flow_.take(it.where);
  flow_.set(out_.call(it.kind->name, power, clock.index,
                      *scans * (text_.cycle_us / 1000), it.where),
            true);
}

void RungWriter::counted_timer(const Instruction& it, std::int64_t scans) {
  const Word& name = it.operands[0];
  const Names::Integer cell = names_.integer(name);
  if (cell.name.empty()) return;
  if (scans > cell.shape.high) {
    errors_.error("RP053", it.where,
                  "the delay of this timer is too long: its variable cannot "
                  "hold the scans");
    return;
  }
  const SourceRange where = it.where;
  Expression preset;
  push_leaf(preset, AstOp::Number, out_.keep_text(std::to_string(scans)),
            where);
  const Expression count = name_of(cell.name, name.where);
  const Expression power = power_of(flow_.hold(where), where);
  Expression counts = power;  // the timed state
  if (it.kind->op == Op::TimerOff) push_unary(counts, AstOp::Not, where);
  // RTO does not look at the power when it has counted.
  Expression ended = both(count, AstOp::GreaterEqual, preset, where);
  if (it.kind->op == Op::TimerOn) {
    ended = both(power, AstOp::And, ended, where);
  } else if (it.kind->op == Op::TimerOff) {
    names_.set_initial(cell.name, scans);
    ended =
        both(power, AstOp::Or, both(count, AstOp::Less, preset, where), where);
  }
  const std::string_view result = out_.keep("timer", kBitCell, ended, where);
  const Expression more =
      both(counts, AstOp::And, both(count, AstOp::Less, preset, where), where);
  Expression next = both(count, AstOp::Add, word_of(more, where), where);
  if (it.kind->op != Op::TimerRetentive) {  // 0 while it does not time
    next = both(word_of(counts, where), AstOp::Multiply, next, where);
  }
  ladder::wrap(next, cell.bits(), where);
  out_.assign(cell.name, true, name.where, next, where);
  flow_.set(name_of(result, where));
}

// --- counters ----------------------------------------------------------------

// The bit that is true in a scan that counts: by default a rising edge.
std::optional<std::string_view> RungWriter::counting(const Instruction& it) {
  const std::string_view kind =
      it.operands.size() > 3 ? it.operands[3].text : "/";
  const SourceRange where = it.where;
  if (kind == "/" || kind == "\\") {
    edge(kind == "/" ? "RISE" : "FALL", where);
  } else if (kind == "o") {
    Expression power = flow_.take(where);
    push_unary(power, AstOp::Not, where);
    flow_.set(power);
  } else if (kind != "-") {
    errors_.error("RP053", it.operands[3].where,
                  quoted_excerpt(kind) +
                      " is no way to count: they are `/`, `\\`, `-`, `o`");
    return std::nullopt;
  }
  return flow_.hold(where);
}

void RungWriter::counter(const Instruction& it) {
  const Word& name = it.operands[0];
  if (!name.text.starts_with("C")) {
    errors_.error("RP052", name.where,
                  quoted_excerpt(name.text) + " is no name of a counter: C...");
    return;
  }
  const Names::Integer cell = names_.integer(name);
  const Expression limit = names_.operand(it.operands[1]);
  const auto event = counting(it);
  if (cell.name.empty() || limit.empty() || !event) return;
  const bool round =
      it.kind->op == Op::CountCircular || it.kind->op == Op::CountReverse;
  if (round) return count_round(it, cell, limit, *event);
  count_to(it, cell, limit, *event);
}

// CTU stops at the limit and is true there; CTD is true before it.
void RungWriter::count_to(const Instruction& it, const Names::Integer& cell,
                          const Expression& limit, std::string_view event) {
  const bool up = it.kind->op == Op::CountUp;
  const SourceRange where = it.where;
  const Expression count = name_of(cell.name, it.operands[0].where);
  const Expression more =
      both(power_of(event, where), AstOp::And,
           both(count, up ? AstOp::Less : AstOp::Greater, limit, where), where);
  Expression next = both(count, up ? AstOp::Add : AstOp::Subtract,
                         word_of(more, where), where);
  ladder::wrap(next, cell.bits(), where);
  out_.assign(cell.name, true, it.operands[0].where, next, where);
  flow_.set(
      both(count, up ? AstOp::GreaterEqual : AstOp::Greater, limit, where));
}

// CTC goes from the limit to its initial count, CTR the other way; both are
// true in the scan in which they do.
void RungWriter::count_round(const Instruction& it, const Names::Integer& cell,
                             const Expression& limit, std::string_view event) {
  const bool up = it.kind->op == Op::CountCircular;
  const SourceRange where = it.where;
  const SourceRange name = it.operands[0].where;
  Expression one;
  push_leaf(one, AstOp::Number, "1", where);
  Expression next = both(name_of(cell.name, name),
                         up ? AstOp::Add : AstOp::Subtract, one, where);
  ladder::wrap(next, cell.bits(), where);
  const std::string_view stepped = out_.keep("next", cell.shape, next, where);
  const std::string_view around =
      out_.keep("around", kBitCell,
                both(power_of(event, where), AstOp::And,
                     both(name_of(stepped, where),
                          up ? AstOp::Greater : AstOp::Less, limit, where),
                     where),
                where);
  out_.set_guard(event);
  out_.assign(cell.name, true, name, name_of(stepped, where), where);
  Expression start;
  push_leaf(start, AstOp::Number,
            out_.keep_text(std::to_string(names_.initial(cell.name))), where);
  out_.set_guard(around);
  out_.assign(cell.name, true, name, start, where);
  out_.set_guard({});
  flow_.set(name_of(around, where));
}

}  // namespace rung::ldmicro
