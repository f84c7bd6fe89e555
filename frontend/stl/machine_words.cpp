// Machine: accumulators, timers, counters and the checks of awlsim's tests.

#include <utility>

#include "frontend/stl/literals.h"
#include "frontend/stl/machine.h"

namespace rung::stl {
namespace {

/// Bits of the status word by number, and awlsim's names for them.
constexpr std::array<std::string_view, 9> kStatusBits = {
    "NER", "VKE", "STA", "OR", "OS", "OV", "A0", "A1", "BIE"};

bool is_counted_name(std::string_view text) {
  return text.size() > 1 && text.size() < 7 &&
         std::string_view("TZC").find(text[0]) != std::string_view::npos &&
         text.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

}  // namespace

// --- loads and transfers -----------------------------------------------------

std::optional<Word> Machine::word_operand(const Operand& operand) {
  Word word;
  if (const auto literal = literal_of(operand.text)) {
    word.constant = literal;
    return word;
  }
  if (operand.text == "STW") return status_word(operand.where);
  if (const auto address = address_of(operand.text, frames_.back().scope)) {
    if (address->size != 0) {
      memory_.check_written(*address, operand.where);
      return memory_.load(*address, operand.where);
    }
  }
  Counted* const counted = find_counted(operand);
  if (counted != nullptr && !counted->preset) {
    const std::string_view value = writer_.keep(
        "accu", kInt16Cell,
        writer_.call("Z.VALUE", {}, *counted->index, {}, operand.where),
        operand.where);
    push_leaf(word.nodes, AstOp::Name, value, operand.where);
    return word;
  }
  fail("RP043", operand.where,
       quoted_excerpt(operand.text) +
           " cannot be loaded: whole numbers, bytes, words and counters can");
  return std::nullopt;
}

void Machine::load(const Statement& statement, const Operator& op) {
  const Operand& operand = statement.operands[0];
  auto word = word_operand(operand);
  if (!word) {
    registers_.accu1.constant = 0;  // what follows is not to blame
    return;
  }
  if (op.code == Code::LoadBcd) {
    const Counted* const counted = find_counted(operand);
    if (counted == nullptr || counted->preset) {
      return fail("RP043", operand.where,
                  "`LC` is supported for counters only");
    }
    const Expression value = bcd_of(word->nodes, operand.where);
    const std::string_view kept =
        writer_.keep("accu", kInt16Cell, value, operand.where);
    word->nodes.clear();
    push_leaf(word->nodes, AstOp::Name, kept, operand.where);
  }
  registers_.accu2 = std::move(registers_.accu1);
  registers_.accu1 = *std::move(word);
}

/// The digits of a number from 0 to 999 as four bits each; of a negative one
/// the negation.
Expression Machine::bcd_of(const Expression& value, SourceRange where) {
  Expression result = value;
  for (const auto& [divisor, factor] : {std::pair{10, 6}, {100, 96}}) {
    push_all(result, value);
    push_with(writer_, result, AstOp::Divide, divisor, where);
    push_with(writer_, result, AstOp::Multiply, factor, where);
    push_binary(result, AstOp::Add, where);
  }
  return result;
}

bool Machine::has_value(const Word& word, SourceRange where) {
  if (word.known && (word.constant || !word.nodes.empty())) return true;
  fail("RP048", where, "an accumulator has no value here");
  return false;
}

Word Machine::status_word(SourceRange where) {
  Expression value;
  push_number(writer_, value, 0, where);
  std::uint32_t number = 0;
  for (const std::string_view name : kStatusBits) {
    const auto bit = status_bit(std::string(name), where);
    if (!bit) return {};
    push_all(value, *bit);
    push_conversion(value, "to_word", where);
    push_with(writer_, value, AstOp::Multiply, std::int64_t{1} << number++,
              where);
    push_binary(value, AstOp::Add, where);
  }
  Word word;
  push_leaf(word.nodes, AstOp::Name,
            writer_.keep("accu", kInt16Cell, value, where), where);
  return word;
}

std::optional<Expression> Machine::status_bit(const std::string& name,
                                              SourceRange where) {
  std::size_t number = kStatusBits.size();
  for (std::size_t i = 0; i < kStatusBits.size(); ++i) {
    if (kStatusBits.at(i) == name || name == std::to_string(i)) number = i;
  }
  if (number == kStatusBits.size()) {
    fail("RP044", where, "the status word has no bit " + quoted_excerpt(name));
    return std::nullopt;
  }
  if (number == 0 && registers_.after_or) return result();
  if (number == 0) return bit_constant(!registers_.first, where);
  if (number == 1) return result();
  if (number == 2) return registers_.sta;
  if (number == 3) return registers_.base;
  if (number == 8) return registers_.saved;
  const Expression& flag = registers_.flags.at(number - 4);
  if (!flag.empty()) return flag;
  fail("RP044", where,
       "the bit " + quoted_excerpt(name) +
           " of the status word is not known here: arithmetic above sets it, "
           "or it depends on the path");
  return std::nullopt;
}

void Machine::reset_status(SourceRange where) {
  const Expression off = bit_constant(false, where);
  registers_.term = registers_.base = registers_.sta = registers_.saved = off;
  registers_.flags.fill(off);
  registers_.joined = false;
  registers_.first = true;
  registers_.after_or = false;
}

void Machine::transfer(const Statement& statement) {
  const Operand& operand = statement.operands[0];
  const SourceRange where = statement.where;
  const Word& accu = registers_.accu1;
  if (!has_value(accu, where)) return;
  if (operand.text == "STW") {
    if (!accu.constant) {
      return fail("RP043", where,
                  "only a constant can be transferred to the status word");
    }
    const std::uint32_t bits = *accu.constant;
    const auto bit = [&](unsigned number) {
      return bit_constant(((bits >> number) & 1U) != 0, where);
    };
    registers_.first = (bits & 1U) == 0;
    registers_.after_or = false;
    registers_.term = bit(1);
    registers_.joined = false;
    registers_.sta = bit(2);
    registers_.base = bit(3);
    for (unsigned i = 0; i < 4; ++i) registers_.flags.at(i) = bit(4 + i);
    registers_.saved = bit(8);
    return;
  }
  const auto address = address_of(operand.text, frames_.back().scope);
  if (!address || address->size == 0 || address->area == 'E') {
    return fail("RP044", operand.where,
                quoted_excerpt(operand.text) +
                    " is no byte or word that can be written");
  }
  if (in_zone()) {
    return fail("RP040", where, "`T` in an MCR zone is not supported");
  }
  if (sees_status_ || registers_.after_or || !registers_.first ||
      is_read_later()) {
    settle_registers(where);
  }
  memory_.mark_written(*address, writer_.guard() == frames_.back().guard);
  memory_.store(*address, accu, where);
}

// --- comparison and arithmetic -----------------------------------------------

void Machine::compare(const Operator& op, SourceRange where) {
  const Word& right = registers_.accu1;
  const Word& left = registers_.accu2;
  if (!has_value(right, where) || !has_value(left, where)) return;
  Expression value = memory_.as_int(left, op.wide, where);
  push_all(value, memory_.as_int(right, op.wide, where));
  push_binary(value, op.compare, where);
  registers_.term = std::move(value);
  registers_.joined = false;
  registers_.base = bit_constant(false, where);
  registers_.sta = bit_constant(true, where);
  registers_.first = false;
  registers_.after_or = false;
  registers_.flags.fill({});  // OS stays; none of them is looked at
}

void Machine::add(const Operator& op, SourceRange where) {
  const Word& right = registers_.accu1;
  const Word& left = registers_.accu2;
  if (!has_value(right, where) || !has_value(left, where)) return;
  if (right.wide || right.constant.value_or(0) > 0xffffU) {
    return fail("RP043", where, "the accumulator holds more than 16 bits");
  }
  Expression value = memory_.as_int(left, false, where);
  push_all(value, memory_.as_int(right, false, where));
  push_binary(value, op.code == Code::Add ? AstOp::Add : AstOp::Subtract,
              where);
  push_conversion(value, "wrap16", where);
  const std::string_view kept = writer_.keep("accu", kInt16Cell, value, where);
  registers_.accu1 = {};
  push_leaf(registers_.accu1.nodes, AstOp::Name, kept, where);
  registers_.accu2 = {};  // with four accumulators it is the third
  registers_.flags.fill({});
}

/// ITB: a number of more than three digits stays as it is.
void Machine::to_bcd(SourceRange where) {
  if (!has_value(registers_.accu1, where)) return;
  if (registers_.accu1.wide ||
      registers_.accu1.constant.value_or(0) > 0xffffU) {
    return fail("RP043", where, "the accumulator holds more than 16 bits");
  }
  const auto leaf = [&](std::string_view cell) {
    Expression nodes;
    push_leaf(nodes, AstOp::Name, cell, where);
    return nodes;
  };
  const Expression number =
      leaf(writer_.keep("value", kInt16Cell,
                        memory_.as_int(registers_.accu1, false, where), where));
  const Expression digits = bcd_of(number, where);
  Expression large = number;
  push_with(writer_, large, AstOp::Greater, 999, where);
  push_all(large, number);
  push_with(writer_, large, AstOp::Less, -999, where);
  push_binary(large, AstOp::Or, where);
  large = leaf(writer_.keep("large", kBitCell, large, where));
  Expression minus = number;
  push_with(writer_, minus, AstOp::Less, 0, where);
  minus = leaf(writer_.keep("minus", kBitCell, minus, where));
  // large ? number : minus ? -digits - 4096 : digits
  Expression value = large;
  push_conversion(value, "to_word", where);
  push_all(value, number);
  push_binary(value, AstOp::Multiply, where);
  for (const bool negative : {false, true}) {
    push_all(value, large);
    push_unary(value, AstOp::Not, where);
    push_all(value, minus);
    if (!negative) push_unary(value, AstOp::Not, where);
    push_binary(value, AstOp::And, where);
    push_conversion(value, "to_word", where);
    if (negative) push_number(writer_, value, -4096, where);
    push_all(value, digits);
    if (negative) push_binary(value, AstOp::Subtract, where);
    push_binary(value, AstOp::Multiply, where);
    push_binary(value, AstOp::Add, where);
  }
  push_conversion(value, "wrap16", where);
  registers_.accu1 = {};
  registers_.accu1.nodes = leaf(writer_.keep("accu", kInt16Cell, value, where));
  registers_.flags.fill({});
}

// --- timers and counters -----------------------------------------------------

/// A timer that is started somewhere, or a counter; null where it is neither.
Machine::Counted* Machine::find_counted(const Operand& operand) {
  if (!is_counted_name(operand.text)) return nullptr;
  const auto known = counted_.find(operand.text);
  if (known == counted_.end()) {
    if (operand.text[0] == 'T') {
      fail("RP041", operand.where,
           quoted_excerpt(operand.text) + " is started nowhere");
      return nullptr;
    }
    Counted counter{"counter-s7", "Z", {}, {}, operand.where};
    counted_.emplace(operand.text, counter);
  }
  Counted& found = counted_.at(operand.text);
  if (!found.index) {
    found.index = writer_.element(found.kind, writer_.keep_text(operand.text),
                                  operand.where);
  }
  return &found;
}

/// The result of an element's step is its status; nothing needs it.
void Machine::step_element(Counted& counted, std::string_view operation,
                           const Expression& operands,
                           std::optional<std::int64_t> preset,
                           SourceRange where) {
  const std::string_view made = writer_.make("step", kBitCell, where);
  writer_.assign(
      made, false, where,
      writer_.call(operation, operands, *counted.index, preset, where), where);
  end_result(registers_.sta);
}

void Machine::timer(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  Counted* const counted = find_counted(statement.operands[0]);
  if (counted == nullptr || !counted->preset) {
    return fail("RP044", statement.operands[0].where,
                quoted_excerpt(statement.operands[0].text) + " is no timer");
  }
  const auto loaded = registers_.accu1.constant;
  if (!registers_.accu1.known || !loaded ||
      s5time_of(*loaded) != counted->preset) {
    return fail("RP045", where,
                "the time must be a constant that is loaded above, such as "
                "`L S5T#2S`");
  }
  if (in_zone()) {
    return fail("RP040", where, "a timer in an MCR zone is not supported");
  }
  step_element(*counted, op.element, result(), counted->preset, where);
}

void Machine::counter(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  Counted* const counted = find_counted(statement.operands[0]);
  if (counted == nullptr || counted->preset || in_zone()) {
    return fail("RP040", where,
                quoted_excerpt(statement.name) +
                    " is supported for counters only, and not in an MCR zone");
  }
  std::string_view operation = op.negate ? "Z.DOWN" : "Z.UP";
  if (op.code == Code::Release) operation = "Z.FR";
  step_element(*counted, operation, result(), {}, where);
}

void Machine::reset_counted(const Statement& statement) {
  Counted* const counted = find_counted(statement.operands[0]);
  if (counted == nullptr || in_zone()) {
    return fail("RP040", statement.where,
                "`R` of a timer or counter in an MCR zone is not supported");
  }
  step_element(*counted, writer_.keep_text(std::string(counted->prefix) + ".R"),
               result(), {}, statement.where);
}

/// The number that the accumulator holds as three digits. That these are digits
/// is a check where it is no constant: the controller stops where they are not.
std::optional<Expression> Machine::loaded_count(SourceRange where) {
  const Word& accu = registers_.accu1;
  if (!has_value(accu, where)) return std::nullopt;
  Expression number;
  if (accu.constant) {
    const auto count = count_of(*accu.constant);
    if (!count) {
      fail("RP045", where, "the count is no number of three digits");
      return std::nullopt;
    }
    push_number(writer_, number, *count, where);
    return number;
  }
  const std::string_view bits = memory_.pattern(accu, false, where);
  push_leaf(number, AstOp::Name, bits, where);
  Expression legal = number;
  push_with(writer_, legal, AstOp::LessEqual, 0x999, where);
  for (const auto& [divisor, factor] : {std::pair{16, 6}, {256, 60}}) {
    // Below this place there are digits: number mod 16 <= 9 and so on.
    Expression part;
    push_leaf(part, AstOp::Name, bits, where);
    push_with(writer_, part, AstOp::Divide, divisor, where);
    Expression digit;
    push_leaf(digit, AstOp::Name, bits, where);
    push_with(writer_, digit, AstOp::Divide, divisor / 16, where);
    push_all(digit, part);
    push_with(writer_, digit, AstOp::Multiply, 16, where);
    push_binary(digit, AstOp::Subtract, where);
    push_all(legal, digit);
    push_with(writer_, legal, AstOp::LessEqual, 9, where);
    push_binary(legal, AstOp::And, where);
    push_all(number, part);
    push_with(writer_, number, AstOp::Multiply, factor, where);
    push_binary(number, AstOp::Subtract, where);
  }
  Expression unused = result();
  push_unary(unused, AstOp::Not, where);
  push_all(legal, unused);
  push_binary(legal, AstOp::Or, where);
  add_check(std::move(legal), "digits", where);
  return number;
}

void Machine::set_counter(const Statement& statement) {
  const SourceRange where = statement.where;
  Counted* const counted = find_counted(statement.operands[0]);
  if (counted == nullptr || counted->preset || in_zone()) {
    return fail("RP040", where,
                "`S` is supported for bits and counters, and for these not in "
                "an MCR zone");
  }
  Expression operands = result();
  const auto count = loaded_count(where);
  if (!count) return;
  push_all(operands, *count);
  step_element(*counted, "Z.S", operands, {}, where);
}

// --- checks ------------------------------------------------------------------

/// The 32 bits of what a check names.
bool Machine::push_checked(Expression& nodes, const Operand& operand) {
  const SourceRange where = operand.where;
  std::optional<Expression> bit;
  if (operand.text.starts_with("__STW")) {
    bit = status_bit(operand.text.substr(5), where);
    if (!bit) return false;
  } else if (operand.text == "__ACCU1" || operand.text == "__ACCU2") {
    const Word& accu =
        operand.text == "__ACCU1" ? registers_.accu1 : registers_.accu2;
    if (!has_value(accu, where)) return false;
    push_leaf(nodes, AstOp::Name, memory_.pattern(accu, true, where), where);
    return true;
  } else if (const auto literal = literal_of(operand.text)) {
    push_number(writer_, nodes, *literal, where);
    return true;
  } else {
    const auto address = address_of(operand.text, frames_.back().scope);
    if (address && address->size != 0) {
      const auto word = word_operand(operand);
      if (!word) return false;
      push_leaf(nodes, AstOp::Name, memory_.pattern(*word, true, where), where);
      return true;
    }
    bit = bit_operand(operand);
    if (!bit) return false;
  }
  push_all(nodes, *bit);
  push_conversion(nodes, "to_word", where);
  return true;
}

/// A check becomes a property: where it is executed, it holds.
void Machine::check(const Statement& statement, const Operator& op) {
  const SourceRange where = statement.where;
  Expression value;
  if (!push_checked(value, statement.operands[0]) ||
      !push_checked(value, statement.operands[1])) {
    return;
  }
  push_binary(value, op.compare, where);
  add_check(std::move(value), "assert", where);
}

void Machine::add_check(Expression value, std::string_view name,
                        SourceRange where) {
  if (!writer_.guard().empty()) {
    push_leaf(value, AstOp::Name, writer_.guard(), where);
    push_unary(value, AstOp::Not, where);
    push_binary(value, AstOp::Or, where);
  }
  const std::string_view bit = writer_.keep(name, kBitCell, value, where);
  const std::string line = std::string(name) + "-" + std::to_string(++checks_) +
                           ": always " + std::string(bit);
  ast_.annotations.push_back({writer_.keep_text(line), where});
}

}  // namespace rung::stl
