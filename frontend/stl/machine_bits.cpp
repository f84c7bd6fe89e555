// Machine: bit logic. The status word changes as the tables of "Statement List
// for S7-300 and S7-400" say; awlsim's test insn_BOOL has each case.

#include <algorithm>
#include <utility>

#include "frontend/stl/machine.h"

namespace rung::stl {
namespace {

constexpr std::size_t kDeepestParen = 7;
constexpr std::size_t kFarthestLook = 50;

AstOp sign_of(Join join) {
  if (join == Join::Or) return AstOp::Or;
  return join == Join::Xor ? AstOp::Xor : AstOp::And;
}

/// `left op right`; constants are not written.
Expression joined(Expression left, AstOp op, const Expression& right) {
  const SourceRange where = right.back().where;
  const auto fold = [&](bool constant, const Expression& other) -> Expression {
    if (op == AstOp::And) return constant ? other : bit_constant(false, where);
    if (op == AstOp::Or) return constant ? bit_constant(true, where) : other;
    Expression result = other;
    if (constant) push_unary(result, AstOp::Not, where);
    return result;
  };
  if (const auto constant = constant_bit(right)) {
    return fold(*constant, left);
  }
  if (const auto constant = constant_bit(left)) return fold(*constant, right);
  push_all(left, right);
  push_binary(left, op, where);
  return left;
}

/// A constant or a bit that nothing writes again in this scan.
bool is_settled(const Expression& nodes) {
  if (nodes.size() != 1) return false;
  return nodes[0].op == AstOp::Bool ||
         (nodes[0].text[0] >= 'a' && nodes[0].text[0] <= 'z');
}

}  // namespace

Expression Machine::result() const {
  return registers_.joined ? joined(registers_.base, AstOp::Or, registers_.term)
                           : registers_.term;
}

void Machine::settle(Expression& nodes, std::string_view prefix,
                     SourceRange where) {
  if (is_settled(nodes)) return;
  const std::string_view kept = writer_.keep(prefix, kBitCell, nodes, where);
  nodes.clear();
  push_leaf(nodes, AstOp::Name, kept, where);
}

void Machine::settle_result(SourceRange where) {
  settle(registers_.base, "result", where);
  registers_.term = result();
  registers_.joined = false;
  settle(registers_.term, "result", where);
}

/// The result, to be replaced; the OR bit stays.
Expression Machine::take_result(SourceRange where) {
  settle(registers_.base, "result", where);
  Expression value = result();
  registers_.joined = false;
  return value;
}

/// OR and /FC are 0 behind an instruction that uses a result up.
void Machine::end_result(Expression sta) {
  registers_.term = result();
  registers_.joined = false;
  registers_.base = bit_constant(false, registers_.term.back().where);
  registers_.sta = std::move(sta);
  registers_.first = true;
  registers_.after_or = false;
}

/// May what stands below look at the result as it is now, once /FC is 0?
bool Machine::is_read_later() const {
  const Frame& frame = frames_.back();
  const bool labelled = frame.next < frame.block->body.size() &&
                        !frame.block->body[frame.next].label.empty();
  return labelled || is_read_from(frame.next);
}

bool Machine::is_read_from(std::size_t first) const {
  const Frame& frame = frames_.back();
  const std::size_t size = frame.block->body.size();
  const std::size_t last = std::min(size, first + kFarthestLook);
  for (std::size_t i = first; i < last; ++i) {
    const Statement& statement = frame.block->body[i];
    if (i > first && !statement.label.empty()) return true;
    if (statement.name.empty()) continue;
    const Operator* const op = find_operator(statement.name, mnemonics_);
    if (op == nullptr) return true;
    switch (op->code) {
      case Code::Nothing:
      case Code::Load:
      case Code::LoadBcd:
      case Code::Transfer:
      case Code::Swap:
      case Code::Add:
      case Code::Subtract:
      case Code::ToBcd:
        if (sees_status_) return true;
        continue;
      case Code::Logic:
        return statement.operands.empty();
      case Code::Open:
        continue;
      case Code::SetResult:
      case Code::Compare:
      case Code::ResetStatus:
        return false;
      default:
        return true;
    }
  }
  return last < size || frames_.size() > 1;
}

// --- queries -----------------------------------------------------------------

std::optional<Expression> Machine::bit_operand(const Operand& operand) {
  Expression nodes;
  if (const auto address = address_of(operand.text, frames_.back().scope)) {
    if (address->size == 0) {
      memory_.check_written(*address, operand.where);
      push_leaf(nodes, AstOp::Name, memory_.bit(*address, operand.where),
                operand.where);
      return nodes;
    }
  }
  if (operand.text == "BIE" || operand.text == "BR") return registers_.saved;
  if (Counted* const counted = find_counted(operand)) {
    const bool timer = counted->preset.has_value();
    const std::string_view kept = writer_.keep(
        "status", kBitCell,
        writer_.call(writer_.keep_text(std::string(counted->prefix) + ".Q"), {},
                     *counted->index, timer ? counted->preset : std::nullopt,
                     operand.where),
        operand.where);
    push_leaf(nodes, AstOp::Name, kept, operand.where);
    return nodes;
  }
  const bool symbol =
      operand.text.starts_with("\"") || operand.text.starts_with("#");
  fail(symbol ? "RP041" : "RP044", operand.where,
       quoted_excerpt(operand.text) +
           (symbol ? " is a symbol: addresses are supported"
                   : " is no bit, timer or counter that is supported"));
  return std::nullopt;
}

void Machine::logic(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  if (statement.operands.empty()) {
    return and_before_or(where);
  }
  auto value = bit_operand(statement.operands[0]);
  if (!value) return;
  if (sees_status_) registers_.sta = *value;
  if (op.negate) push_unary(*value, AstOp::Not, where);
  join(*std::move(value), op.join);
}

/// The result so far is joined to what follows, if it is one.
void Machine::and_before_or(SourceRange where) {
  Registers& now = registers_;
  now.sta = bit_constant(true, where);
  if (now.first) {
    if (!now.after_or) now.base = bit_constant(false, where);
    return;
  }
  if (now.joined || constant_bit(now.base) == false) {
    now.base = result();
    now.term = bit_constant(false, where);
    now.joined = true;
  } else {
    settle(now.base, "result", where);
    settle(now.term, "result", where);
    now.base = joined(now.base, AstOp::Or, now.term);
  }
  now.first = true;
  now.after_or = true;
}

void Machine::join(Expression value, Join join) {
  Registers& now = registers_;
  const SourceRange where = value.back().where;
  const bool begins = now.first && !now.after_or;
  if (join == Join::And) {
    if (begins) now.base = bit_constant(false, where);
    if (now.after_or && !now.joined) now.base = now.term;
    now.term = now.first ? std::move(value)
                         : joined(std::move(now.term), AstOp::And, value);
    now.joined = true;
  } else {
    now.term =
        begins ? std::move(value) : joined(result(), sign_of(join), value);
    now.joined = false;
    now.base = bit_constant(false, where);
  }
  now.first = false;
  now.after_or = false;
}

void Machine::open(const Operator& op, SourceRange where) {
  if (parens_.size() == kDeepestParen) {
    return fail("RP047", where, "more than 7 parentheses are open");
  }
  // The result itself stays as it is until the first query. Where that begins
  // a new result on the outside, too, nothing looks at it.
  if (registers_.first && !registers_.after_or) {
    settle(registers_.base, "result", where);
    registers_.term = take_result(where);
  } else {
    settle_result(where);
  }
  parens_.push_back({&op, registers_, where});
  registers_.base = bit_constant(false, where);
  registers_.sta = bit_constant(true, where);
  registers_.first = true;
  registers_.after_or = false;
}

void Machine::close(SourceRange where) {
  if (parens_.empty()) {
    return fail("RP047", where, "this parenthesis closes nothing");
  }
  const Paren paren = std::move(parens_.back());
  parens_.pop_back();
  Registers& now = registers_;
  Expression value = result();
  const Registers inner = now;
  if (paren.op->negate) push_unary(value, AstOp::Not, where);
  now = paren.outer;
  now.accu1 = inner.accu1;
  now.accu2 = inner.accu2;
  now.flags = inner.flags;
  now.saved = inner.saved;
  join(std::move(value), paren.op->join);
  now.sta = bit_constant(true, where);
}

// --- writes ------------------------------------------------------------------

std::optional<Address> Machine::bit_target(const Operand& operand) {
  const auto address = address_of(operand.text, frames_.back().scope);
  if (!address || address->size != 0) {
    fail("RP044", operand.where,
         quoted_excerpt(operand.text) + " is no bit that can be written");
    return std::nullopt;
  }
  if (address->area == 'E') {
    fail("RP044", operand.where,
         quoted_excerpt(operand.text) +
             " is an input: writing the image of inputs is not supported");
    return std::nullopt;
  }
  return address;
}

void Machine::write_bit(const Statement& statement, const Operator& op) {
  const Operand& operand = statement.operands[0];
  const SourceRange where = statement.where;
  if (op.code == Code::Reset && find_counted(operand) != nullptr) {
    return reset_counted(statement);
  }
  if (op.code == Code::Set && find_counted(operand) != nullptr) {
    return set_counter(statement);
  }
  const auto address = bit_target(operand);
  if (!address) return;
  if (is_read_later() || !parens_.empty()) settle_registers(where);
  Expression value = result();
  Expression sta = value;
  if (in_zone()) value = joined(value, AstOp::And, zones_.back());
  if (op.code == Code::Assign) sta = value;
  if (op.code == Code::Assign) {
    const bool always = writer_.guard() == frames_.back().guard;
    memory_.mark_written(*address, always);
  } else {
    memory_.check_written(*address, operand.where);
  }
  const std::string_view cell = memory_.bit(*address, operand.where);
  if (op.code != Code::Assign) {
    Expression old;
    push_leaf(old, AstOp::Name, cell, operand.where);
    if (op.code == Code::Reset) push_unary(value, AstOp::Not, where);
    value = joined(std::move(value),
                   op.code == Code::Set ? AstOp::Or : AstOp::And, old);
  }
  writer_.assign(cell, false, operand.where, value, where);
  if (!is_settled(sta)) sta = bit_constant(false, where);  // nobody sees it
  end_result(std::move(sta));
}

/// The memory bit is a cell like others, and may be written elsewhere, too.
void Machine::edge(const Statement& statement, const Operator& op) {
  const Operand& operand = statement.operands[0];
  const SourceRange where = statement.where;
  const auto address = bit_target(operand);
  if (!address) return;
  memory_.check_written(*address, operand.where);
  settle_registers(where);
  const std::string_view cell = memory_.bit(*address, operand.where);
  Expression old;
  push_leaf(old, AstOp::Name, cell, operand.where);
  settle(old, "edge", where);
  const Expression now = result();
  writer_.assign(cell, false, operand.where, now, where);
  Expression was = old;
  Expression is = now;
  push_unary(op.negate ? is : was, AstOp::Not, where);
  end_result(now);
  registers_.term = joined(is, AstOp::And, was);
  registers_.first = false;
  registers_.after_or = false;
}

void Machine::zone(const Operator& op, SourceRange where) {
  constexpr std::size_t kDeepestZone = 8;
  if (op.code == Code::ZoneOn) {
    zone_on_ = true;
  } else if (op.code == Code::ZoneOff) {
    zone_on_ = false;
  } else if (op.code == Code::ZoneOpen) {
    if (zones_.size() == kDeepestZone || !parens_.empty()) {
      return fail("RP047", where, "more than 8 MCR zones are open");
    }
    settle_result(where);
    Expression power = result();
    if (!zones_.empty()) power = joined(power, AstOp::And, zones_.back());
    settle(power, "zone", where);
    zones_.push_back(power);
    end_result(bit_constant(true, where));
  } else if (zones_.empty()) {
    fail("RP047", where, "no `MCR(` is open here");
  } else {
    zones_.pop_back();
    settle_result(where);
    end_result(bit_constant(true, where));
  }
}

}  // namespace rung::stl
