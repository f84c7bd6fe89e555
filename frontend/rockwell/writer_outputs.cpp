#include <string>
#include <utility>

#include "frontend/ladder/words.h"
#include "frontend/rockwell/writer.h"
#include "frontend/token_list.h"

namespace rung::rockwell {

using ladder::both;
using ladder::name_of;
using ladder::power_of;
using ladder::truth;

void Writer::assign_bit(std::string_view cell, const Expression& value,
                        SourceRange where) {
  if (!cell.empty()) out_.assign(cell, false, where, value, where);
}

void Writer::enter(SourceRange where) {
  outside_ = out_.guard();
  const std::string_view power = flow_->hold(where);
  if (power.empty()) return;
  if (outside_.empty()) return out_.set_guard(power);
  out_.set_guard(out_.keep(
      "behind", kBitCell,
      both(name_of(outside_, where), AstOp::And, name_of(power, where), where),
      where));
}

void Writer::leave() { out_.set_guard(outside_); }

// --- bits --------------------------------------------------------------------

void Writer::energize(const Instruction& it, const Step& step) {
  const Operand& name = it.operands[0];
  assign_bit(tags_.place(name, Place::Kind::Bit).name, flow_->use(step),
             it.where);
}

void Writer::latch(const Instruction& it, bool value) {
  const Operand& name = it.operands[0];
  const std::string_view cell = tags_.place(name, Place::Kind::Bit).name;
  Expression power = power_of(flow_->hold(it.where), it.where);
  if (!value) push_unary(power, AstOp::Not, it.where);
  assign_bit(cell,
             both(power, value ? AstOp::Or : AstOp::And,
                  name_of(cell, name.where), it.where),
             it.where);
}

// The storage bit holds the power of the scan before.
void Writer::one_shot(const Instruction& it) {
  const SourceRange where = it.where;
  const std::string_view storage =
      tags_.place(it.operands[0], Place::Kind::Bit).name;
  const Expression power = power_of(flow_->hold(where), where);
  const bool falling = it.kind->op == Op::OneShotFalling;
  Expression now = power;
  Expression before = name_of(storage, where);
  push_unary(falling ? now : before, AstOp::Not, where);
  const Expression pulse = both(now, AstOp::And, before, where);
  if (it.kind->op == Op::OneShot) {
    const std::string_view kept = out_.keep("pulse", kBitCell, pulse, where);
    flow_->set(name_of(kept, where));
  } else {
    assign_bit(tags_.place(it.operands[1], Place::Kind::Bit).name, pulse,
               where);
  }
  assign_bit(storage, power, where);
}

// --- integers ----------------------------------------------------------------

void Writer::compare(const Instruction& it) {
  flow_->contact(both(tags_.word(it.operands[0]), it.kind->operation,
                      tags_.word(it.operands[1]), it.where),
                 it.where);
}

// Inside of low..high; where low is above high, outside of what is between.
void Writer::limit(const Instruction& it) {
  const SourceRange where = it.where;
  const Expression low = tags_.word(it.operands[0]);
  const Expression test = tags_.word(it.operands[1]);
  const Expression high = tags_.word(it.operands[2]);
  const Expression above = both(test, AstOp::GreaterEqual, low, where);
  const Expression below = both(test, AstOp::LessEqual, high, where);
  const Expression inside =
      both(both(low, AstOp::LessEqual, high, where), AstOp::And,
           both(above, AstOp::And, below, where), where);
  const Expression outside =
      both(both(low, AstOp::Greater, high, where), AstOp::And,
           both(above, AstOp::Or, below, where), where);
  flow_->contact(both(inside, AstOp::Or, outside, where), where);
}

void Writer::store_word(const Operand& operand, const Expression& value,
                        SourceRange where) {
  enter(where);
  out_.assign(tags_.place(operand, Place::Kind::Word).name, true, operand.where,
              value, where);
  leave();
}

void Writer::move(const Instruction& it) {
  const Operand& name = it.operands.back();
  const Operand zero = {"0", it.where};
  const Operand& source = it.kind->op == Op::Clear ? zero : it.operands[0];
  const Place target = tags_.place(name, Place::Kind::Word);
  if (!tags_.bits_of(target).empty()) {
    return split(target, source, name, it.where);
  }
  Expression value = tags_.word(source);
  ladder::wrap(value, target.bits, it.where);
  store_word(name, value, it.where);
}

// Each bit of a number to its cell.
void Writer::split(const Place& target, const Operand& source,
                   const Operand& name, SourceRange where) {
  const auto number = number_of(source.text);
  if (!number) {
    errors_.error("RP087", name.where,
                  quoted_excerpt(name.text) +
                      " is used bit by bit elsewhere: only numbers can be "
                      "moved there");
    return;
  }
  enter(where);
  std::uint32_t bit = 0;
  for (const std::string_view cell : tags_.bits_of(target)) {
    assign_bit(cell, truth(((*number >> bit++) & 1) != 0, where), where);
  }
  leave();
}

void Writer::arithmetic(const Instruction& it) {
  const Operand& name = it.operands[2];
  const Place target = tags_.place(name, Place::Kind::Word);
  if (!tags_.bits_of(target).empty()) {
    return split(target, name, name, it.where);
  }
  const auto divisor = number_of(it.operands[1].text);
  if (it.kind->operation == AstOp::Divide && (!divisor || *divisor == 0)) {
    errors_.error("RP053", it.operands[1].where,
                  "the divisor must be a number other than 0");
    return;
  }
  Expression value = both(tags_.word(it.operands[0]), it.kind->operation,
                          tags_.word(it.operands[1]), it.where);
  ladder::wrap(value, target.bits, it.where);
  store_word(name, value, it.where);
}

// --- timers and counters -----------------------------------------------------

// The instance of a timer or a counter; null after an error.
Writer::Block* Writer::block(const Instruction& it) {
  const Operand& name = it.operands[0];
  const bool timer = it.kind->op == Op::Timer;
  const auto [at, fresh] = blocks_.emplace(name.text, Block{});
  Block& block = at->second;
  if (fresh) {
    block.name = it.kind->name;
    block.index = out_.element(!timer                ? "counter-logix"
                               : block.name == "RTO" ? "rto-logix"
                               : block.name == "TOF" ? "tof-logix"
                                                     : "ton-logix",
                               name.text, name.where);
  } else if (timer && block.name != it.kind->name) {
    errors_.error("RP088", name.where,
                  quoted_excerpt(name.text) + " is the timer of a " +
                      std::string(block.name) + " already");
    return nullptr;
  }
  return &block;
}

// DN, or a cell in its place: it is executed in any case.
std::string_view Writer::execute(const Instruction& it, const Block& block,
                                 const Expression& power) {
  std::string_view done = tags_.member(it.operands[0].text, "DN");
  if (done.empty()) done = out_.make("done", kBitCell, it.where);
  assign_bit(
      done,
      out_.call(it.kind->name, power, block.index, tags_.preset(it), it.where),
      it.where);
  return done;
}

void Writer::timer(const Instruction& it) {
  const SourceRange where = it.where;
  const std::string_view name = it.operands[0].text;
  const Block* const block = this->block(it);
  if (block == nullptr) return;
  const Expression power = power_of(flow_->hold(where), where);
  const std::string_view done = execute(it, *block, power);
  assign_bit(tags_.member(name, "EN"), power, where);
  Expression runs = power;
  Expression is_done = name_of(done, where);
  push_unary(block->name == "TOF" ? runs : is_done, AstOp::Not, where);
  assign_bit(tags_.member(name, "TT"), both(runs, AstOp::And, is_done, where),
             where);
}

void Writer::counter(const Instruction& it) {
  const SourceRange where = it.where;
  const std::string_view name = it.operands[0].text;
  const Block* const block = this->block(it);
  const Expression power = power_of(flow_->hold(where), where);
  execute(it, *block, power);
  const bool up = it.kind->operation != AstOp::Not;
  assign_bit(tags_.member(name, up ? "CU" : "CD"), power, where);
  store_count(name, *block, where);
}

// The count as a cell, if something looks at it.
void Writer::store_count(std::string_view name, const Block& block,
                         SourceRange where) {
  const std::string_view cell = tags_.member(name, "ACC");
  if (cell.empty()) return;
  constexpr CellShape kCount = {true, -2'147'483'648, 2'147'483'647};
  const std::string_view now = out_.keep(
      "count", kCount, out_.call("CTU.ACC", {}, block.index, {}, where), where);
  out_.assign(cell, true, where, name_of(now, where), where);
}

void Writer::reset(const Instruction& it) {
  const SourceRange where = it.where;
  const Operand& name = it.operands[0];
  const auto block = blocks_.find(name.text);
  const bool known = block != blocks_.end();
  if (!known || block->second.name == "TOF") {
    errors_.error("RP087", name.where,
                  quoted_excerpt(name.text) +
                      (known ? " is an off-delay timer: RES of it is not "
                               "supported"
                             : " is no timer and no counter of a rung above"));
    return;
  }
  enter(where);
  const std::string_view kind = block->second.name;
  const std::string_view operation = kind == "TON"   ? "TON.RES"
                                     : kind == "RTO" ? "RTO.RES"
                                                     : "CTU.RES";
  out_.keep("reset", kBitCell,
            out_.call(operation, power_of(out_.guard(), where),
                      block->second.index, {}, where),
            where);
  for (const std::string_view member : {"DN", "EN", "TT", "CU", "CD"}) {
    assign_bit(tags_.member(name.text, member), truth(false, where), where);
  }
  store_count(name.text, block->second, where);
  leave();
}

}  // namespace rung::rockwell
