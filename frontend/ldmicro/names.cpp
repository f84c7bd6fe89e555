#include "frontend/ldmicro/names.h"

#include <algorithm>
#include <string>

#include "frontend/token_list.h"

namespace rung::ldmicro {
namespace {

using Role = AstDeclaration::Kind;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_bit_name(std::string_view name) {
  return name.starts_with("X") || name.starts_with("Y") ||
         name.starts_with("R");
}

}  // namespace

Names::Names(const ProgramText& text, Ast& ast, StatementWriter& out,
             ErrorLimit& errors, bool stable_inputs)
    : text_(text),
      ast_(ast),
      out_(out),
      errors_(errors),
      stable_inputs_(stable_inputs) {
  for (const Word& pin : text.pins) {
    if (cells_.contains(pin.text)) {
      fail(pin, "stands in the list twice");
    } else if (pin.text.starts_with("X") && is_name(pin)) {
      bit(pin, Role::Input);
    } else if (pin.text.starts_with("Y") && is_name(pin)) {
      bit(pin, Role::Output);
    }
  }
  for (const Instruction& instruction : text.instructions) survey(instruction);
}

std::string_view Names::fail(const Word& name, std::string_view why) {
  errors_.error("RP052", name.where,
                quoted_excerpt(name.text) + " " + std::string(why));
  return {};
}

bool Names::is_name(const Word& name) {
  const bool good = is_letter(name.text.front()) &&
                    std::all_of(name.text.begin(), name.text.end(), [](char c) {
                      return is_letter(c) || (c >= '0' && c <= '9');
                    });
  if (!good) fail(name, "is no name of a variable that is supported");
  return good;
}

// --- what the program does with a name ---------------------------------------

void Names::survey(const Instruction& instruction) {
  const std::vector<Word>& words = instruction.operands;
  const auto look = [this](const Word& word) {
    uses_[word.text].number = true;
  };
  switch (instruction.kind->op) {
    case Op::TimerOn:
    case Op::TimerOff:
    case Op::TimerRetentive:
      return survey_timer(instruction);
    case Op::CountUp:
    case Op::CountDown:
    case Op::CountCircular:
    case Op::CountReverse:
      look(words[0]);
      look(words[1]);
      return survey_counter(instruction);
    case Op::Compare:
    case Op::Arithmetic:
      std::for_each(words.begin(), words.end(), look);
      return;
    case Op::Move:
      if (number_of(words[1].text) != 0) look(words[0]);
      return look(words[1]);
    default:
      return;
  }
}

void Names::survey_timer(const Instruction& instruction) {
  const Word& name = instruction.operands.front();
  Use& use = uses_[name.text];
  if (use.timer.has_value()) {
    errors_.error("RP088", name.where,
                  quoted_excerpt(name.text) + " is another timer already",
                  {{use.timer, "it is used here"}});
    return;
  }
  use.timer = name.where;
  use.op = instruction.kind->op;
}

void Names::survey_counter(const Instruction& instruction) {
  const std::vector<Word>& words = instruction.operands;
  const auto start = words.size() > 2 ? number_of(words[2].text) : 0;
  if (!start) {
    errors_.error("RP053", words[2].where,
                  "the initial count must be a number: " +
                      quoted_excerpt(words[2].text) + " is not supported");
    return;
  }
  Use& use = uses_[words[0].text];
  if (use.start && *use.start != *start) {
    errors_.error("RP088", words[0].where,
                  "two counters of one name begin with different counts",
                  {{use.counter, "the other is here"}});
    return;
  }
  use.start = start;
  use.counter = words[0].where;
}

bool Names::is_clock(std::string_view name) const {
  const auto use = uses_.find(name);
  return use != uses_.end() && use->second.timer.has_value() &&
         !use->second.number;
}

const Names::Clock& Names::clock(std::string_view name, SourceRange where) {
  Use& use = uses_[name];
  if (!use.clock) {
    const std::string_view kind = use.op == Op::TimerOn    ? "ton-ldmicro"
                                  : use.op == Op::TimerOff ? "tof-ldmicro"
                                                           : "rto-ldmicro";
    use.clock = Clock{out_.element(kind, name, where), use.op};
  }
  return *use.clock;
}

std::int64_t Names::initial(std::string_view name) const {
  const auto use = uses_.find(name);
  return use == uses_.end() ? 0 : use->second.start.value_or(0);
}

void Names::set_initial(std::string_view name, std::int64_t value) {
  AstDeclaration& cell = ast_.declarations[cells_.at(name)];
  cell.initial = value;
  cell.initialised = true;
}

// --- cells -------------------------------------------------------------------

std::string_view Names::bit(const Word& name, Role role) {
  const auto [at, fresh] = cells_.emplace(name.text, 0);
  if (fresh) at->second = out_.declare(name.text, kBitCell, role, name.where);
  return name.text;
}

std::string_view Names::contact(const Word& name) {
  if (!is_name(name)) return {};
  if (name.text.starts_with("Y")) return bit(name, Role::Output);
  if (name.text.starts_with("R")) return bit(name, Role::Memory);
  if (!name.text.starts_with("X")) {
    return fail(name, "has no contact: X, Y and R have one");
  }
  bit(name, Role::Input);
  const std::uint32_t read = ++samples_[name.text];
  if (read == 1 || stable_inputs_) return name.text;
  const std::string_view sample =
      out_.keep_text(std::string(name.text) + "." + std::to_string(read));
  const std::uint32_t at =
      out_.declare(sample, kBitCell, Role::Input, name.where);
  ast_.declarations[at].made = true;
  return sample;
}

std::string_view Names::coil(const Word& name) {
  if (!is_name(name)) return {};
  if (name.text.starts_with("Y")) return bit(name, Role::Output);
  if (name.text.starts_with("R")) return bit(name, Role::Memory);
  return fail(name, "has no coil: Y and R have one");
}

std::int64_t Names::largest(std::string_view name) const {
  const auto listed = text_.variables.find(name);
  if (listed == text_.variables.end()) return 0x7fff'ffff;
  return (std::int64_t{1} << (8 * listed->second.bytes - 1)) - 1;
}

Names::Integer Names::integer(const Word& name) {
  if (!is_name(name)) return {};
  if (is_bit_name(name.text)) {
    return {fail(name, "is a bit: a number is expected here"), {}};
  }
  const auto listed = text_.variables.find(name.text);
  const std::uint32_t bytes =
      listed == text_.variables.end() ? 2 : listed->second.bytes;
  if (bytes > 2) {
    errors_.error(
        "RP087", name.where,
        "a variable of " + std::to_string(bytes) + " bytes is not supported",
        {{listed->second.where, "it is declared here"}});
    return {};
  }
  const CellShape shape = bytes == 2 ? kInt16Cell : CellShape{true, -128, 127};
  const auto [at, fresh] = cells_.emplace(name.text, 0);
  if (fresh) {
    at->second = out_.declare(name.text, shape, Role::Memory, name.where);
    const std::int64_t start = initial(name.text);
    if (start != 0) set_initial(name.text, start);
    if (start < shape.low || start > shape.high) {
      fail(name, "cannot hold its initial count");
    }
  }
  return {name.text, shape};
}

Expression Names::operand(const Word& word) {
  if (const auto value = number_of(word.text)) {
    if (*value < -32'768 || *value > 32'767) {
      errors_.error("RP053", word.where,
                    quoted_excerpt(word.text) + " has more than 16 bits");
      return {};
    }
    Expression nodes;
    push_leaf(nodes, AstOp::Number, out_.keep_text(std::to_string(*value)),
              word.where);
    return nodes;
  }
  const Integer cell = integer(word);
  return cell.name.empty() ? Expression{}
                           : ladder::name_of(cell.name, word.where);
}

}  // namespace rung::ldmicro
