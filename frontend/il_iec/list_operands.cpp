// ListParser: operands, and calls of function blocks.

#include <algorithm>
#include <charconv>
#include <utility>

#include "frontend/il_iec/list_parser.h"

namespace rung::il_iec {
namespace {

const Pin* find_pin(std::span<const Pin> pins, std::string_view upper_name) {
  const auto found =
      std::find_if(pins.begin(), pins.end(),
                   [&](const Pin& pin) { return pin.name == upper_name; });
  return found == pins.end() ? nullptr : &*found;
}

std::string pin_list(const Block& block) {
  std::string text;
  for (const std::span<const Pin> pins : {block.inputs, block.outputs}) {
    for (const Pin& pin : pins) {
      text += (text.empty() ? "" : " ") + std::string(pin.name);
    }
  }
  return text;
}

std::string no_pin(const Block& block, std::string_view name) {
  return "a " + std::string(block.name) + " has no " + quoted_excerpt(name) +
         ": it has " + pin_list(block);
}

}  // namespace

std::optional<Value> ListParser::operand() {
  const Token& token = cursor_.peek();
  const SourceRange where = cursor_.range(token);
  switch (token.kind) {
    case TokenKind::Word:
      return name_operand();
    case TokenKind::Address:
      return address_operand(cursor_.take());
    case TokenKind::Number:
      return number_operand(cursor_.take(), false);
    case TokenKind::Minus:
      cursor_.take();
      return number_operand(token, true);
    case TokenKind::Time: {
      const auto time = milliseconds_of(cursor_.text(cursor_.take()));
      if (!time) {
        fail("RP043", where,
             quoted_excerpt(cursor_.text(token)) +
                 " is no time: T#1h2m3s4ms, in whole milliseconds, up to 24 "
                 "days");
        return std::nullopt;
      }
      Value value{{}, Kind::Time};
      push_leaf(value.nodes, AstOp::Number, names_.keep(std::to_string(*time)),
                where);
      return value;
    }
    default:
      fail("RP047", where, "expected an operand and found " + cursor_.shown());
      return std::nullopt;
  }
}

std::optional<Value> ListParser::number_operand(const Token& first,
                                                bool negative) {
  const Token& digits = negative ? cursor_.peek() : first;
  SourceRange where = cursor_.range(first);
  std::int64_t number = 0;
  bool good = digits.kind == TokenKind::Number;
  if (good) {
    if (negative) cursor_.take();
    const std::string_view text = cursor_.text(digits);
    where.end = cursor_.range(digits).end;
    const auto [stop, problem] =
        std::from_chars(text.data(), text.data() + text.size(), number);
    good = problem == std::errc() && number <= (negative ? 32'768 : 32'767);
  }
  if (!good) {
    fail("RP043", where, "an INT literal is from -32768 to 32767");
    return std::nullopt;
  }
  Value value{{}, Kind::Int};
  push_leaf(value.nodes, AstOp::Number,
            names_.keep(std::to_string(negative ? -number : number)), where);
  return value;
}

std::optional<Value> ListParser::address_operand(const Token& token) {
  const Cell* const cell = cell_of(token);
  if (cell == nullptr) return std::nullopt;
  Value value{{}, cell->kind};
  push_leaf(value.nodes, AstOp::Name, cell->name, cursor_.range(token));
  return value;
}

std::optional<Value> ListParser::name_operand() {
  const Token& token = cursor_.take();
  const SourceRange where = cursor_.range(token);
  const std::string key = upper(cursor_.text(token));
  if (Instance* const instance = names_.find_instance(key)) {
    return pin_operand(*instance, token);
  }
  Value value;
  if (key == "TRUE" || key == "FALSE") {
    push_leaf(value.nodes, AstOp::Bool, key == "TRUE" ? "true" : "false",
              where);
    return value;
  }
  const Cell* const cell = use(cursor_.text(token), key, Kind::Bool, where);
  if (cell == nullptr) return std::nullopt;
  value.kind = cell->kind;
  if (!cell->constant) {
    push_leaf(value.nodes, AstOp::Name, cell->name, where);
  } else if (cell->kind == Kind::Bool) {
    push_leaf(value.nodes, AstOp::Bool, cell->initial != 0 ? "true" : "false",
              where);
  } else {
    push_leaf(value.nodes, AstOp::Number,
              names_.keep(std::to_string(cell->initial)), where);
  }
  return value;
}

std::optional<Value> ListParser::pin_operand(Instance& instance,
                                             const Token& first) {
  const Block& block = *instance.block;
  if (!cursor_.at(TokenKind::Dot) || !cursor_.at(TokenKind::Word, 1)) {
    fail("RP049", cursor_.range(first),
         quoted_excerpt(instance.name) + " is a " + std::string(block.name) +
             ": name an output of it, such as `" + std::string(instance.name) +
             "." + std::string(block.outputs.front().name) + "`");
    return std::nullopt;
  }
  cursor_.take();
  const Token& member = cursor_.take();
  const SourceRange where = cover(cursor_.range(first), cursor_.range(member));
  const std::string name = upper(cursor_.text(member));
  const Pin* pin = find_pin(block.outputs, name);
  if (pin == nullptr) pin = find_pin(block.inputs, name);
  if (pin == nullptr || pin->name == "PT") {
    fail("RP049", where,
         pin == nullptr ? no_pin(block, cursor_.text(member))
                        : "PT of a timer cannot be read: it is a constant");
    return std::nullopt;
  }
  Value value{{}, pin->kind};
  push_leaf(value.nodes, AstOp::Name, names_.pin(instance, *pin, where).name,
            where);
  return value;
}

/// The variable of a name or an address, which is made where it is allowed.
Cell* ListParser::use(std::string_view text, const std::string& key, Kind kind,
                      SourceRange where) {
  if (Cell* const cell = names_.find_cell(key)) return cell;
  const bool address = key.front() == '%';
  if (!address && !by_use_) {
    fail("RP041", where,
         quoted_excerpt(text) + " is not declared" + suggestion(text));
    return nullptr;
  }
  if (!address && cursor_.at(TokenKind::Dot)) {
    fail("RP041", where,
         quoted_excerpt(text) +
             " is not declared: a function block needs a "
             "declaration, VAR " +
             std::string(text.substr(0, 40)) + " : TON; END_VAR");
    return nullptr;
  }
  Cell cell;
  cell.kind = kind;
  cell.by_use = !address;
  cell.input = address && key[1] == 'I';
  auto role = AstDeclaration::Kind::Memory;
  if (cell.input) role = AstDeclaration::Kind::Input;
  if (address && key[1] == 'Q') role = AstDeclaration::Kind::Output;
  const std::string_view name = address ? names_.keep(key) : text;
  return &names_.add(key, cell, declaration_of(name, kind, role, where));
}

Cell* ListParser::cell_of(const Token& token) {
  const std::string_view text = cursor_.text(token);
  const SourceRange where = cursor_.range(token);
  const std::string key = address_key(text);
  if (key.empty()) {
    fail("RP044", where,
         quoted_excerpt(text) +
             " is no address that is supported: bits are %IX0.0, "
             "%QX0.0 and %MX0.0, words %IW0, %QW0 and %MW0");
    return nullptr;
  }
  if (const std::string* const variable = names_.at_address(key)) {
    return names_.find_cell(*variable);
  }
  if (names_.find_cell(key) == nullptr) {
    if (names_.overlaps(key)) {
      fail("RP044", where,
           "bits and words of one area may overlap: that is not supported");
      return nullptr;
    }
    names_.add_address(key, key);
  }
  return use(text, key, key[2] == 'X' ? Kind::Bool : Kind::Int, where);
}

/// What a store writes.
Cell* ListParser::cell_here(const Token& first, SourceRange& where,
                            bool& is_preset) {
  cursor_.take();
  where = cursor_.range(first);
  Cell* cell = nullptr;
  if (first.kind == TokenKind::Address) {
    cell = cell_of(first);
  } else {
    const std::string key = upper(cursor_.text(first));
    if (Instance* const instance = names_.find_instance(key)) {
      return target_pin(*instance, where, is_preset);
    }
    if (key == "TRUE" || key == "FALSE") {
      fail("RP047", where, "a literal cannot be written");
      return nullptr;
    }
    cell = use(cursor_.text(first), key, Kind::Bool, where);
  }
  if (cell == nullptr) return nullptr;
  if (cell->input || cell->constant) {
    fail("RP044", where,
         quoted_excerpt(cell->name) +
             (cell->input ? " is an input" : " is a constant") +
             ": no instruction can write it");
    return nullptr;
  }
  return cell;
}

Cell* ListParser::target_pin(Instance& instance, SourceRange& where,
                             bool& is_preset) {
  const Block& block = *instance.block;
  if (!cursor_.at(TokenKind::Dot) || !cursor_.at(TokenKind::Word, 1)) {
    fail("RP049", where,
         quoted_excerpt(instance.name) + " is a " + std::string(block.name) +
             ": name an input of it");
    return nullptr;
  }
  cursor_.take();
  const Token& member = cursor_.take();
  where = cover(where, cursor_.range(member));
  const std::string name = upper(cursor_.text(member));
  const Pin* const pin = find_pin(block.inputs, name);
  if (pin == nullptr) {
    const bool output = find_pin(block.outputs, name) != nullptr;
    fail("RP049", where,
         output ? quoted_excerpt(cursor_.text(member)) +
                      " is an output: only the block writes it"
                : no_pin(block, cursor_.text(member)));
    return nullptr;
  }
  is_preset = pin->name == "PT";
  return is_preset ? nullptr : &names_.pin(instance, *pin, where);
}

Instance* ListParser::instance_here() {
  const Token& token = cursor_.peek();
  Instance* const instance = names_.find_instance(cursor_.word());
  if (instance == nullptr) {
    const bool word = token.kind == TokenKind::Word;
    fail("RP041", cursor_.range(token),
         word ? quoted_excerpt(cursor_.text(token)) +
                    " is not declared as a function block" +
                    suggestion(cursor_.text(token))
              : "expected a function block and found " + cursor_.shown());
    return nullptr;
  }
  cursor_.take();
  return instance;
}

void ListParser::set_preset(Instance& instance, const Value& value,
                            SourceRange where) {
  const bool constant = value.kind == Kind::Time && value.nodes.size() == 1 &&
                        value.nodes[0].op == AstOp::Number;
  if (!constant) {
    return fail("RP045", where,
                "PT must be a TIME literal or a constant: no other preset is "
                "supported");
  }
  const std::string_view text = value.nodes[0].text;
  std::int64_t time = 0;
  std::from_chars(text.data(), text.data() + text.size(), time);
  instance.preset = time;
}

void ListParser::give(Instance& instance, const Pin& pin, const Value& value,
                      SourceRange where) {
  if (pin.name == "PT") return set_preset(instance, value, where);
  if (pin.kind != value.kind) {
    return fail("RP049", where,
                quoted_excerpt(pin.name) + " is a " +
                    std::string(to_string(pin.kind)) + " and is given a " +
                    std::string(to_string(value.kind)));
  }
  writer_.assign(names_.pin(instance, pin, where), where, value.nodes, where);
}

void ListParser::execute(Instance& instance, SourceRange where) {
  const bool timer = find_pin(instance.block->inputs, "PT") != nullptr;
  if (timer && !instance.preset) {
    return fail("RP045", where,
                quoted_excerpt(instance.name) +
                    " has no PT here: give it in the call, or above it and "
                    "behind no condition");
  }
  writer_.call(instance, where);
  // Behind a condition PT may not have been set.
  if (!writer_.guard().empty()) instance.preset.reset();
}

void ListParser::pin_operator(const Operator& op, Instance& instance,
                              SourceRange where) {
  if (!plain(op, where) || !known(where)) return;
  const Pin* const pin = find_pin(instance.block->inputs, op.name);
  if (pin == nullptr) {
    return fail("RP049", where, no_pin(*instance.block, op.name));
  }
  give(instance, *pin, {value(), kind_}, where);
  if (failed_) return;
  execute(instance, where);
  forget();
}

void ListParser::call(const Operator& op, SourceRange where) {
  if (!plain(op, where)) return;
  const std::string_view before = writer_.guard();
  if (op.condition) {
    if (!known(where, Kind::Bool, op.name)) return;
    Expression on;
    if (!before.empty()) push_leaf(on, AstOp::Name, before, where);
    const Expression condition = value();
    on.insert(on.end(), condition.begin(), condition.end());
    if (op.negate) push_unary(on, AstOp::Not, where);
    if (!before.empty()) push_binary(on, AstOp::And, where);
    writer_.set_guard(writer_.keep("run", Kind::Bool, on, where));
  }
  Instance* const instance = instance_here();
  if (instance != nullptr) arguments(*instance, where);
  writer_.set_guard(before);
  forget();
}

/// The operands of a call, if there are any, the call, and its outputs.
void ListParser::arguments(Instance& instance, SourceRange where) {
  std::vector<Output> outputs;
  if (cursor_.accept(TokenKind::Open)) {
    std::size_t count = 0;
    cursor_.skip_line_ends();
    while (!cursor_.at(TokenKind::Close)) {
      argument(instance, count++, outputs);
      if (failed_) return;
      cursor_.skip_line_ends();
      if (cursor_.accept(TokenKind::Comma)) {
        cursor_.skip_line_ends();
      } else if (!cursor_.at(TokenKind::Close)) {
        return fail("RP047", cursor_.range(cursor_.peek()),
                    "expected `,` or `)` and found " + cursor_.shown());
      }
    }
    cursor_.take();
  }
  execute(instance, where);
  for (const Output& output : outputs) {
    if (failed_) return;
    Expression value;
    push_leaf(value, AstOp::Name,
              names_.pin(instance, *output.pin, output.where).name,
              output.where);
    writer_.assign(*output.target, output.where, value, output.where);
  }
}

void ListParser::argument(Instance& instance, std::size_t index,
                          std::vector<Output>& outputs) {
  const Block& block = *instance.block;
  const Token& first = cursor_.peek();
  const SourceRange where = cursor_.range(first);
  // `Q` and `=>` may stand on two lines.
  std::size_t ahead = 1;
  while (cursor_.at(TokenKind::LineEnd, ahead)) ++ahead;
  const bool input =
      first.kind == TokenKind::Word && cursor_.at(TokenKind::Assign, ahead);
  const bool output =
      first.kind == TokenKind::Word && cursor_.at(TokenKind::Arrow, ahead);
  if (!input && !output) {
    if (index >= block.inputs.size()) {
      return fail("RP049", where,
                  "a " + std::string(block.name) + " has " +
                      std::to_string(block.inputs.size()) +
                      " inputs: outputs are written `Q => variable`");
    }
    const std::optional<Value> value = operand();
    if (value) give(instance, block.inputs[index], *value, where);
    return;
  }
  const std::string name = cursor_.word();
  const Pin* const pin = find_pin(input ? block.inputs : block.outputs, name);
  if (pin == nullptr) {
    return fail("RP049", where,
                "a " + std::string(block.name) + " has no " +
                    (input ? "input " : "output ") +
                    quoted_excerpt(cursor_.text(first)) + ": it has " +
                    pin_list(block));
  }
  for (std::size_t i = 0; i <= ahead; ++i) cursor_.take();
  cursor_.skip_line_ends();
  if (input) {
    const std::optional<Value> value = operand();
    if (value) give(instance, *pin, *value, where);
    return;
  }
  output_argument(*pin, outputs);
}

void ListParser::output_argument(const Pin& pin, std::vector<Output>& outputs) {
  const Token first = cursor_.peek();
  if (first.kind != TokenKind::Word && first.kind != TokenKind::Address) {
    return fail("RP047", cursor_.range(first),
                "expected a variable and found " + cursor_.shown());
  }
  SourceRange where;
  bool is_preset = false;
  Cell* const target = cell_here(first, where, is_preset);
  if (is_preset) return fail("RP045", where, "PT must be a constant");
  if (target == nullptr) return;
  if (target->kind != pin.kind) {
    return fail("RP049", where,
                quoted_excerpt(target->name) + " is a " +
                    std::string(to_string(target->kind)) + ", and " +
                    quoted_excerpt(pin.name) + " is a " +
                    std::string(to_string(pin.kind)));
  }
  outputs.push_back({&pin, target, where});
}

}  // namespace rung::il_iec
