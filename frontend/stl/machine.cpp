#include "frontend/stl/machine.h"

#include <algorithm>
#include <utility>

#include "base/text.h"

namespace rung::stl {
namespace {

/// Calls that call in turn could make a text of any length.
constexpr std::size_t kMostExecuted = 200'000;
constexpr std::size_t kDeepestCall = 8;
constexpr std::string_view kEnd;  // the label behind the last statement

}  // namespace

void Machine::fail(std::string_view code, SourceRange where,
                   std::string message) {
  broken_ = true;
  errors_.error(code, where, std::move(message));
}

void Machine::run() {
  const Block* const cycle = find_block(BlockKind::Organization, 1);
  if (cycle == nullptr) {
    return fail("RP042", {ast_.file, 0, 0}, "there is no OB 1");
  }
  if (!prepare()) return;
  registers_.term = registers_.base = registers_.sta = registers_.saved =
      bit_constant(false, cycle->where);
  reset_status(cycle->where);
  if (const Block* const startup = find_block(BlockKind::Organization, 100)) {
    const std::string_view first =
        writer_.make("start", kBitCell, startup->where);
    ast_.declarations.back().initial = 1;
    Expression on;
    push_leaf(on, AstOp::Name, first, startup->where);
    writer_.set_guard(writer_.keep("run", kBitCell, on, startup->where));
    writer_.assign(first, false, startup->where,
                   bit_constant(false, startup->where), startup->where);
    execute(*startup);
    writer_.set_guard({});
    reset_status(cycle->where);
  }
  if (!stop_bit_.empty()) {
    Expression on;
    push_leaf(on, AstOp::Name, stop_bit_, cycle->where);
    push_unary(on, AstOp::Not, cycle->where);
    writer_.set_guard(writer_.keep("run", kBitCell, on, cycle->where));
  }
  execute(*cycle);
}

void Machine::execute(const Block& block) {
  enter(block, block.where);
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    if (frame.next == frame.block->body.size()) {
      leave();
      continue;
    }
    if (++executed_ > kMostExecuted) {
      frames_.clear();
      return fail("RP047", block.where,
                  "with its calls this block has more than 200000 "
                  "instructions");
    }
    step(frame.block->body[frame.next++]);
  }
}

void Machine::enter(const Block& block, SourceRange where) {
  Frame frame;
  frame.block = &block;
  frame.scope = block.kind == BlockKind::Function ? block.number + 1 : 0;
  frame.guard = writer_.guard();
  for (std::size_t i = 0; i < block.body.size(); ++i) {
    const Statement& statement = block.body[i];
    if (statement.label.empty()) continue;
    if (!frame.labels.emplace(statement.label, i).second) {
      fail("RP046", statement.where,
           "the label " + quoted_excerpt(statement.label) +
               " stands here a second time");
    }
  }
  memory_.begin_block(frame.scope);
  frames_.push_back(std::move(frame));
  registers_.base = bit_constant(false, where);
  registers_.first = true;
  registers_.after_or = false;
}

/// The end of a block, where all its jumps to the end arrive.
void Machine::leave() {
  const SourceRange where = frames_.back().block->where;
  if (!parens_.empty()) {
    fail("RP047", parens_.back().where, "this parenthesis is not closed");
    parens_.clear();
  }
  if (!zones_.empty()) {
    fail("RP047", where, "an `MCR(` of this block has no `)MCR`");
    zones_.clear();
  }
  zone_on_ = false;
  std::vector<Jump>& ends = frames_.back().jumps[std::string(kEnd)];
  const bool forgets = frames_.size() == 1;
  if (!ends.empty() && !forgets) settle_registers(where);
  merge(ends, forgets, where);
  const bool stops = frames_.back().stops;
  const std::string_view guard = frames_.back().guard;
  frames_.pop_back();
  if (stops && !frames_.empty()) {
    frames_.back().stops = true;
  } else {
    writer_.set_guard(guard);
  }
}

void Machine::step(const Statement& statement) {
  if (skips_arguments_) {
    skips_arguments_ = statement.name.find(')') == std::string::npos;
    for (const Operand& operand : statement.operands) {
      if (operand.text.find(')') != std::string::npos) skips_arguments_ = false;
    }
    return;
  }
  if (!statement.label.empty()) label(statement);
  if (statement.name.empty()) return;
  const Operator* const op = find_operator(statement.name, mnemonics_);
  if (op == nullptr) {
    std::string hint;
    if (!errors_.is_full()) {
      hint = did_you_mean(statement.name, operator_names());
    }
    return fail("RP040", statement.where,
                quoted_excerpt(statement.name) +
                    " is no instruction that is supported" + hint);
  }
  if (statement.name == "SE" && mnemonics_ == Mnemonics::Both) {
    return fail("RP040", statement.where,
                "`SE` is an on-delay in German and an extended pulse in "
                "English, and nothing tells which this is");
  }
  const bool alone = op->code == Code::Logic && statement.name == "O";
  const std::size_t count = statement.operands.size();
  if (count != op->operands && !(alone && count == 0)) {
    skips_arguments_ =
        count > 0 && statement.operands.back().text.ends_with("(");
    return fail("RP047", statement.where,
                quoted_excerpt(statement.name) + " has " +
                    std::to_string(op->operands) + " operands, and here " +
                    std::to_string(count) + " are given");
  }
  dispatch(statement, *op);
}

void Machine::dispatch(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  switch (op.code) {
    case Code::Logic:
      return logic(statement, op);
    case Code::Open:
      return open(op, where);
    case Code::Close:
      return close(where);
    case Code::Assign:
    case Code::Set:
    case Code::Reset:
      return write_bit(statement, op);
    case Code::Not:
      if (registers_.after_or) {
        return fail("RP047", where, "`NOT` behind an `O` alone");
      }
      registers_.term = take_result(where);
      push_unary(registers_.term, AstOp::Not, where);
      registers_.joined = false;
      registers_.sta = bit_constant(true, where);
      return;
    case Code::SetResult:
      registers_.term = bit_constant(!op.negate, where);
      registers_.joined = false;
      return end_result(registers_.term);
    case Code::Save:
      settle_result(where);
      registers_.saved = result();
      return;
    case Code::Edge:
      return edge(statement, op);
    case Code::Jump:
      return jump(statement, op);
    case Code::End:
      return end(op, where);
    case Code::Call:
      return call(statement, op);
    case Code::ZoneOn:
    case Code::ZoneOpen:
    case Code::ZoneClose:
    case Code::ZoneOff:
      return zone(op, where);
    default:
      return dispatch_words(statement, op);
  }
}

void Machine::dispatch_words(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  switch (op.code) {
    case Code::Load:
    case Code::LoadBcd:
      return load(statement, op);
    case Code::Transfer:
      return transfer(statement);
    case Code::Compare:
      return compare(op, where);
    case Code::Add:
    case Code::Subtract:
      return add(op, where);
    case Code::ToBcd:
      return to_bcd(where);
    case Code::Swap:
      return std::swap(registers_.accu1, registers_.accu2);
    case Code::Timer:
      return timer(statement, op);
    case Code::Release:
    case Code::Count:
      return counter(statement, op);
    case Code::ResetStatus:
      return reset_status(where);
    case Code::Assert:
      return check(statement, op);
    default:
      return;  // NOP
  }
}

// --- jumps -------------------------------------------------------------------

/// What a jump takes along must not change on the way.
void Machine::settle_registers(SourceRange where) {
  settle_result(where);
  settle(registers_.base, "result", where);
  if (sees_status_) settle(registers_.sta, "result", where);
}

void Machine::jump_to(const std::string& label, const Expression& condition,
                      SourceRange where) {
  Frame& frame = frames_.back();
  const std::string_view before = writer_.guard();
  Expression on = condition;
  push_unary(on, AstOp::Not, where);
  if (!before.empty()) {
    push_leaf(on, AstOp::Name, before, where);
    push_binary(on, AstOp::And, where);
  }
  const std::string_view after = writer_.keep("run", kBitCell, on, where);
  if (reachable_) {
    frame.jumps[label].push_back({before, after, registers_});
    ++frame.open_jumps;
  }
  writer_.set_guard(after);
  if (constant_bit(condition).value_or(false)) reachable_ = false;
}

void Machine::jump(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  if (!parens_.empty() || !zones_.empty()) {
    return fail("RP046", where,
                "a jump inside of parentheses or of an MCR zone is not "
                "supported");
  }
  const std::string name = statement.operands[0].text;
  Frame& frame = frames_.back();
  const auto target = frame.labels.find(name);
  if (target == frame.labels.end()) {
    std::vector<std::string_view> known;
    for (const auto& [label, place] : frame.labels) known.push_back(label);
    return fail("RP046", statement.operands[0].where,
                "there is no label " + quoted_excerpt(name) +
                    (errors_.is_full() ? "" : did_you_mean(name, known)));
  }
  if (target->second < frame.next) {
    return fail("RP046", statement.operands[0].where,
                "a jump back: only jumps to labels further down are "
                "supported, as a loop has no bound");
  }
  Expression condition = bit_constant(true, where);
  if (op.condition != Condition::None) {
    settle_result(where);
    condition = op.condition == Condition::Saved ? registers_.saved : result();
    if (op.saves) registers_.saved = result();
    if (op.negate) push_unary(condition, AstOp::Not, where);
    const bool result_set = op.condition == Condition::Result;
    if (result_set) registers_.term = bit_constant(true, where);
    if (result_set) registers_.joined = false;
    end_result(bit_constant(true, where));
  }
  settle_registers(where);
  jump_to(name, condition, where);
}

void Machine::label(const Statement& statement) {
  Frame& frame = frames_.back();
  const auto found = frame.jumps.find(statement.label);
  if (found == frame.jumps.end()) {
    if (!reachable_) end_result(registers_.sta);
    return;
  }
  if (!parens_.empty() || !zones_.empty()) {
    fail("RP046", statement.where,
         "a label inside of parentheses or of an MCR zone is not supported");
  }
  const bool forgets =
      registers_.first && !registers_.after_or && !is_read_from(frame.next - 1);
  if (!forgets) settle_registers(statement.where);
  merge(found->second, forgets, statement.where);
}

/// On from here: who was on, and who jumped here. `forgets`: nothing below
/// looks at the result.
void Machine::merge(std::vector<Jump>& jumps, bool forgets, SourceRange where) {
  if (jumps.empty()) return;
  Frame& frame = frames_.back();
  if (!reachable_) {
    // Nothing arrives from above: the first jump's values stand for it.
    registers_ = jumps.front().registers;
  }
  std::vector<const Expression*> terms;
  std::vector<const Expression*> bases;
  std::vector<const Expression*> stas;
  std::vector<const Expression*> saved;
  std::vector<Expression> results;
  results.reserve(jumps.size());
  for (const Jump& jump : jumps) {
    results.push_back(jump.registers.term);
    terms.push_back(&results.back());
    bases.push_back(&jump.registers.base);
    stas.push_back(&jump.registers.sta);
    saved.push_back(&jump.registers.saved);
    if (jump.registers.first != registers_.first ||
        jump.registers.after_or != registers_.after_or) {
      fail("RP048", where,
           "on one path to this label the next query begins a new result, and "
           "on another it does not: that is not supported");
    }
    merge_word(registers_.accu1, jump.registers.accu1);
    merge_word(registers_.accu2, jump.registers.accu2);
    for (std::size_t i = 0; i < registers_.flags.size(); ++i) {
      const Expression& other = jump.registers.flags.at(i);
      Expression& here = registers_.flags.at(i);
      const bool same =
          !here.empty() && !other.empty() && here[0].text == other[0].text;
      if (!same) here.clear();
    }
  }
  if (forgets) {
    registers_.term = bit_constant(false, where);
  } else {
    merge_bit(registers_.term, jumps, terms, where);
  }
  merge_bit(registers_.base, jumps, bases, where);
  if (sees_status_) merge_bit(registers_.sta, jumps, stas, where);
  merge_bit(registers_.saved, jumps, saved, where);
  Expression on;
  push_leaf(on, AstOp::Name, writer_.guard(), where);
  for (const Jump& jump : jumps) {
    if (!jump.before.empty()) push_leaf(on, AstOp::Name, jump.before, where);
    push_leaf(on, AstOp::Name, jump.after, where);
    push_unary(on, AstOp::Not, where);
    if (!jump.before.empty()) push_binary(on, AstOp::And, where);
    push_binary(on, AstOp::Or, where);
  }
  frame.open_jumps -= jumps.size();
  reachable_ = true;
  jumps.clear();
  if (frame.open_jumps == 0 && !frame.stops) {
    writer_.set_guard(frame.guard);
  } else {
    writer_.set_guard(writer_.keep("run", kBitCell, on, where));
  }
}

/// The value of the path that was taken; all are constants or made bits.
void Machine::merge_bit(Expression& here, const std::vector<Jump>& jumps,
                        const std::vector<const Expression*>& values,
                        SourceRange where) {
  const bool same =
      std::all_of(values.begin(), values.end(), [&](const Expression* value) {
        return (*value)[0].text == here[0].text;
      });
  if (same) return;
  Expression merged = here;
  push_leaf(merged, AstOp::Name, writer_.guard(), where);
  push_binary(merged, AstOp::And, where);
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    push_all(merged, *values[i]);
    push_leaf(merged, AstOp::Name, jumps[i].after, where);
    push_unary(merged, AstOp::Not, where);
    push_binary(merged, AstOp::And, where);
    if (!jumps[i].before.empty()) {
      push_leaf(merged, AstOp::Name, jumps[i].before, where);
      push_binary(merged, AstOp::And, where);
    }
    push_binary(merged, AstOp::Or, where);
  }
  const std::string_view kept = writer_.keep("result", kBitCell, merged, where);
  here.clear();
  push_leaf(here, AstOp::Name, kept, where);
}

void Machine::merge_word(Word& here, const Word& other) {
  const bool constants = here.constant && here.constant == other.constant;
  const bool cells = !here.constant && !other.constant &&
                     here.nodes.size() == 1 && other.nodes.size() == 1 &&
                     here.nodes[0].text == other.nodes[0].text;
  here.known = here.known && other.known && (constants || cells);
}

// --- blocks ------------------------------------------------------------------

void Machine::end(const Operator& op, SourceRange where) {
  if (!parens_.empty() || !zones_.empty()) {
    return fail("RP046", where,
                "the end of a block inside of parentheses or of an MCR zone");
  }
  Expression condition = bit_constant(true, where);
  settle_registers(where);
  if (op.condition == Condition::Result) {
    condition = result();
    registers_.term = bit_constant(true, where);
  }
  end_result(bit_constant(true, where));
  jump_to(std::string(kEnd), condition, where);
}

/// STOP: nothing of this scan and no scan to come is executed.
void Machine::stop(SourceRange where) {
  writer_.assign(stop_bit_, false, where, bit_constant(true, where), where);
  const Expression off = bit_constant(false, where);
  writer_.set_guard(writer_.keep("run", kBitCell, off, where));
  frames_.back().stops = true;
  reachable_ = false;
}

void Machine::call(const Statement& statement, const Operator& op) {
  const Operand& operand = statement.operands[0];
  const SourceRange where = statement.where;
  if (!parens_.empty() || zone_on_) {
    return fail("RP046", where,
                "a call inside of parentheses or of an MCR zone is not "
                "supported");
  }
  if (op.condition != Condition::None) {
    return fail("RP040", where,
                "`CC` is not supported: a jump over a `UC` says the same");
  }
  const bool stops = operand.text == "SFC46";
  const auto found = functions_.find(operand.text);
  const Block* const block =
      found == functions_.end() ? nullptr : found->second;
  if (block == nullptr && !stops) {
    skips_arguments_ = operand.text.ends_with("(");
    return fail("RP041", operand.where,
                "a call of " + quoted_excerpt(operand.text) +
                    " is not supported: functions of this text without "
                    "parameters are");
  }
  const bool recursive =
      std::any_of(frames_.begin(), frames_.end(),
                  [&](const Frame& frame) { return frame.block == block; });
  if (recursive || frames_.size() > kDeepestCall) {
    return fail("RP041", operand.where,
                "calls in a circle or more than 8 deep are not supported");
  }
  settle_registers(where);
  end_result(bit_constant(true, where));
  if (stops) return stop(where);
  enter(*block, where);
}

}  // namespace rung::stl
