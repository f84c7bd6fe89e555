#include "frontend/il_iec/list_parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"

namespace rung::il_iec {
namespace {

using enum Code;

// By name.
constexpr std::array<Operator, 44> kOperators = {{
    {"ADD", Binary, false, false, AstOp::Add},
    {"AND", Binary, false, false, AstOp::And},
    {"ANDN", Binary, true, false, AstOp::And},
    {"CAL", Call},
    {"CALC", Call, false, true},
    {"CALCN", Call, true, true},
    {"CALNC", Call, true, true},
    {"CD", Pin},
    {"CLK", Pin},
    {"CU", Pin},
    {"DIV", Binary, false, false, AstOp::Divide},
    {"EQ", Binary, false, false, AstOp::Equal},
    {"GE", Binary, false, false, AstOp::GreaterEqual},
    {"GT", Binary, false, false, AstOp::Greater},
    {"IN", Pin},
    {"JMP", Jump},
    {"JMPC", Jump, false, true},
    {"JMPCN", Jump, true, true},
    {"JMPNC", Jump, true, true},
    {"LD", Load},
    {"LDN", Load, true},
    {"LE", Binary, false, false, AstOp::LessEqual},
    {"LT", Binary, false, false, AstOp::Less},
    {"MOD", Unknown},
    {"MUL", Binary, false, false, AstOp::Multiply},
    {"NE", Binary, false, false, AstOp::NotEqual},
    {"NOT", Not},
    {"OR", Binary, false, false, AstOp::Or},
    {"ORN", Binary, true, false, AstOp::Or},
    {"PT", Pin},
    {"PV", Pin},
    {"R", Reset},
    {"R1", Pin},
    {"RET", Return},
    {"RETC", Return, false, true},
    {"RETCN", Return, true, true},
    {"RETNC", Return, true, true},
    {"S", Set},
    {"S1", Pin},
    {"ST", Store},
    {"STN", Store, true},
    {"SUB", Binary, false, false, AstOp::Subtract},
    {"XOR", Binary, false, false, AstOp::Xor},
    {"XORN", Binary, true, false, AstOp::Xor},
}};

constexpr Operator kAnd = {"AND", Binary, false, false, AstOp::And};
constexpr Operator kAndNot = {"ANDN", Binary, true, false, AstOp::And};

bool is_logic(AstOp op) {
  return op == AstOp::And || op == AstOp::Or || op == AstOp::Xor;
}
bool is_arithmetic(AstOp op) {
  return op == AstOp::Add || op == AstOp::Subtract || op == AstOp::Multiply ||
         op == AstOp::Divide;
}
bool is_equality(AstOp op) {
  return op == AstOp::Equal || op == AstOp::NotEqual;
}

}  // namespace

const Operator* find_operator(std::string_view upper_word) {
  const auto* const found =
      std::find_if(kOperators.begin(), kOperators.end(),
                   [&](const Operator& it) { return it.name == upper_word; });
  return found == kOperators.end() || upper_word.empty() ? nullptr : found;
}

std::vector<std::string_view> operator_names() {
  std::vector<std::string_view> names;
  names.reserve(kOperators.size());
  for (const Operator& it : kOperators) names.push_back(it.name);
  return names;
}

bool is_operator(std::string_view upper_word) {
  return find_operator(upper_word) != nullptr;
}

void read_instructions(Cursor& cursor, Names& names, Writer& writer,
                       ErrorLimit& errors, std::string_view end_word,
                       bool by_use) {
  ListParser(cursor, names, writer, errors, by_use).run(end_word);
}

void ListParser::fail(std::string_view code, SourceRange where,
                      std::string message) {
  errors_.error(code, where, std::move(message));
  failed_ = true;
}

/// None where the message is only counted.
std::string ListParser::suggestion(
    std::string_view word, const std::vector<std::string_view>& known) const {
  return errors_.is_full() ? std::string() : did_you_mean(word, known);
}
std::string ListParser::suggestion(std::string_view word) const {
  return errors_.is_full() ? std::string() : did_you_mean(word, names_.known());
}

void ListParser::run(std::string_view end_word) {
  find_labels(end_word);
  while (true) {
    cursor_.skip_line_ends();
    if (cursor_.at(TokenKind::End)) break;
    if (!end_word.empty() && cursor_.word() == end_word) break;
    failed_ = false;
    line(end_word);
    if (!failed_) continue;
    while (!cursor_.at(TokenKind::LineEnd) && !cursor_.at(TokenKind::End) &&
           (end_word.empty() || cursor_.word() != end_word)) {
      cursor_.take();
    }
    stack_.resize(start());
    state_ = State::Broken;
  }
  for (const Frame& frame : frames_) {
    errors_.error("RP047", frame.where, "this parenthesis is not closed");
  }
}

void ListParser::line(std::string_view end_word) {
  if (cursor_.at(TokenKind::Word) && cursor_.at(TokenKind::Colon, 1)) {
    label();
    if (failed_ || cursor_.at(TokenKind::LineEnd)) return;
    if (!end_word.empty() && cursor_.word() == end_word) return;
  }
  if (cursor_.at(TokenKind::Semicolon)) return end_line();
  do {
    instruction();
  } while (!failed_ && (!frames_.empty() || cursor_.at(TokenKind::Close)) &&
           !cursor_.at(TokenKind::LineEnd) &&
           !cursor_.at(TokenKind::Semicolon));
  if (!failed_) end_line();
}

void ListParser::end_line() {
  if (cursor_.accept(TokenKind::Semicolon)) check_comment();
  if (failed_ || cursor_.at(TokenKind::LineEnd)) return;
  fail("RP047", cursor_.range(cursor_.peek()),
       "expected the end of the line and found " + cursor_.shown());
}

// Behind `;` some write a comment; an instruction there must not be lost.
void ListParser::check_comment() {
  const std::string word = cursor_.word();
  if (is_operator(word) || cursor_.at(TokenKind::Colon, 1) ||
      word.starts_with("END_")) {
    return fail("RP047", cursor_.range(cursor_.peek()),
                "an instruction behind `;`: each has a line of its own (a "
                "comment is written `(* *)`)");
  }
  cursor_.skip_line();
}

const Operator* ListParser::take_operator(SourceRange& where) {
  const Token token = cursor_.peek();
  where = cursor_.range(token);
  if (token.kind == TokenKind::And) {
    cursor_.take();
    const bool negated =
        cursor_.word() == "N" && cursor_.peek().begin == token.end;
    if (negated) where.end = cursor_.range(cursor_.take()).end;
    return negated ? &kAndNot : &kAnd;
  }
  const std::string word = cursor_.word();
  if (const Operator* const found = find_operator(word)) {
    cursor_.take();
    return found;
  }
  if (token.kind == TokenKind::Word) {
    fail("RP040", where,
         quoted_excerpt(cursor_.text(token)) +
             " is no operator of instruction lists" +
             suggestion(word, operator_names()));
  } else {
    fail("RP040", where,
         "expected an instruction and found " + cursor_.shown());
  }
  return nullptr;
}

bool ListParser::plain(const Operator& op, SourceRange where) {
  if (frames_.empty()) return true;
  fail("RP047", where,
       quoted_excerpt(op.name) + " inside of parentheses is not supported");
  return false;
}

bool ListParser::known(SourceRange where) {
  if (state_ == State::Known) return true;
  if (state_ == State::None) {
    fail("RP048", where,
         "there is no current result here: begin with LD (none is left at the "
         "begin, behind a label that is jumped to, and behind CAL, JMP, RET)");
  }
  failed_ = true;
  return false;
}

bool ListParser::known(SourceRange where, Kind kind, std::string_view what) {
  if (!known(where)) return false;
  if (kind_ == kind) return true;
  fail("RP049", where,
       std::string(what) + " takes a " + std::string(to_string(kind)) +
           ", and the current result is a " + std::string(to_string(kind_)));
  return false;
}

void ListParser::instruction() {
  if (cursor_.at(TokenKind::Close)) {
    return close(cursor_.range(cursor_.take()));
  }
  SourceRange where;
  const Operator* const op = take_operator(where);
  if (op == nullptr) return;
  switch (op->code) {
    case Load:
      return load(*op, where);
    case Binary:
      return binary(*op, where);
    case Not:
      return invert(where);
    case Store:
    case Set:
    case Reset:
      return store(*op, where);
    case Code::Jump:
    case Return:
      return jump(*op, where);
    case Call:
      return call(*op, where);
    case Code::Pin: {
      Instance* const instance = instance_here();
      if (instance == nullptr) return;
      return pin_operator(*op, *instance, where);
    }
    case Unknown:
      return fail("RP040", where,
                  quoted_excerpt(op->name) + " is not supported");
  }
}

void ListParser::load(const Operator& op, SourceRange where) {
  Instance* const instance = names_.find_instance(cursor_.word());
  if (instance != nullptr && !cursor_.at(TokenKind::Dot, 1) && !op.negate &&
      state_ == State::Known) {
    cursor_.take();
    return pin_operator(op, *instance, where);
  }
  std::optional<Value> value = operand();
  if (!value) return;
  forget();
  if (op.negate && value->kind != Kind::Bool) {
    return fail("RP049", where, "LDN takes a BOOL");
  }
  stack_.insert(stack_.end(), value->nodes.begin(), value->nodes.end());
  if (op.negate) push_unary(stack_, AstOp::Not, where);
  kind_ = value->kind;
  state_ = State::Known;
}

void ListParser::binary(const Operator& op, SourceRange where) {
  if (cursor_.at(TokenKind::Open)) {
    const SourceRange open = cursor_.range(cursor_.take());
    const bool has_value = known(where);
    frames_.push_back({stack_.size(), &op,
                       has_value ? State::Known : State::Broken, kind_,
                       cover(where, open)});
    if (!has_value) return;
    state_ = State::None;
    if (cursor_.at(TokenKind::LineEnd) || cursor_.at(TokenKind::Semicolon)) {
      return;
    }
    // AND( a is AND( and LD a.
    const bool starts = is_operator(cursor_.word()) &&
                        !cursor_.at(TokenKind::Dot, 1) &&
                        !names_.is_known(cursor_.word());
    if (starts) return;
    static constexpr Operator kLoad = {"LD", Load};
    return load(kLoad, where);
  }
  const std::optional<Value> right = operand();
  if (!right || !known(where)) return;
  stack_.insert(stack_.end(), right->nodes.begin(), right->nodes.end());
  apply(op, right->kind, where);
}

void ListParser::close(SourceRange where) {
  if (frames_.empty()) {
    return fail("RP047", where, "this parenthesis closes nothing");
  }
  const Frame frame = frames_.back();
  const bool has_value = frame.state == State::Known && known(where);
  frames_.pop_back();
  if (!has_value) {
    failed_ = true;
    return;
  }
  const Kind right = kind_;
  state_ = frame.state;
  kind_ = frame.kind;
  apply(*frame.op, right, frame.where);
}

/// The stack holds both operands.
void ListParser::apply(const Operator& op, Kind right, SourceRange where) {
  const bool bits = kind_ == Kind::Bool;
  if (kind_ != right) {
    return fail("RP049", where,
                quoted_excerpt(op.name) +
                    " takes two of one type, and is given a " +
                    std::string(to_string(kind_)) + " and a " +
                    std::string(to_string(right)));
  }
  if ((is_logic(op.op) && !bits) ||
      (is_arithmetic(op.op) && kind_ != Kind::Int) ||
      (bits && !is_logic(op.op) && !is_equality(op.op))) {
    return fail("RP049", where,
                quoted_excerpt(op.name) + " of two " +
                    std::string(to_string(kind_)) + " is not supported");
  }
  if (op.op == AstOp::Divide &&
      (stack_.back().op != AstOp::Number || stack_.back().text == "0")) {
    return fail("RP049", where,
                "DIV takes a constant divisor other than 0: no other is "
                "supported");
  }
  if (op.negate) push_unary(stack_, AstOp::Not, where);
  if (bits && is_equality(op.op)) {
    push_binary(stack_, AstOp::Xor, where);
    if (op.op == AstOp::Equal) push_unary(stack_, AstOp::Not, where);
    return;
  }
  push_binary(stack_, op.op, where);
  if (is_arithmetic(op.op)) return push_conversion(stack_, "wrap16", where);
  kind_ = Kind::Bool;
}

void ListParser::invert(SourceRange where) {
  if (!known(where, Kind::Bool, "NOT")) return;
  push_unary(stack_, AstOp::Not, where);
}

void ListParser::store(const Operator& op, SourceRange where) {
  if (!plain(op, where)) return;
  Instance* const instance = names_.find_instance(cursor_.word());
  if (op.code != Store && instance != nullptr &&
      !cursor_.at(TokenKind::Dot, 1)) {
    cursor_.take();
    return pin_operator(op, *instance, where);
  }
  const Token first = cursor_.peek();
  if (first.kind != TokenKind::Word && first.kind != TokenKind::Address) {
    return fail("RP047", cursor_.range(first),
                quoted_excerpt(op.name) +
                    " needs a variable and is followed by " + cursor_.shown());
  }
  SourceRange target_where;
  bool is_preset = false;
  Cell* const cell = cell_here(first, target_where, is_preset);
  if (cell == nullptr && !is_preset) return;
  if (!known(where)) return;
  if (is_preset) {
    Instance* const timer = names_.find_instance(upper(cursor_.text(first)));
    if (op.code != Store || op.negate) {
      return fail("RP049", where, quoted_excerpt(op.name) + " takes a BOOL");
    }
    return set_preset(*timer, {value(), kind_}, target_where);
  }
  write(op, *cell, target_where, cover(where, target_where));
}

void ListParser::write(const Operator& op, Cell& cell, SourceRange target_where,
                       SourceRange where) {
  if (op.code != Store) return set_or_reset(op, cell, target_where, where);
  if (cell.kind != kind_) {
    return fail("RP049", where,
                quoted_excerpt(cell.name) + " is a " +
                    std::string(to_string(cell.kind)) +
                    ", and the current result is a " +
                    std::string(to_string(kind_)));
  }
  if (op.negate && kind_ != Kind::Bool) {
    return fail("RP049", where, "STN takes a BOOL");
  }
  Expression stored = value();
  if (op.negate) push_unary(stored, AstOp::Not, where);
  writer_.assign(cell, target_where, stored, where);
  // The current result goes on, also where it read this variable.
  stack_.resize(start());
  push_leaf(stack_, AstOp::Name, cell.name, target_where);
  if (op.negate) push_unary(stack_, AstOp::Not, where);
}

void ListParser::set_or_reset(const Operator& op, Cell& cell,
                              SourceRange target_where, SourceRange where) {
  if (!known(where, Kind::Bool, op.name)) return;
  if (cell.kind != Kind::Bool) {
    return fail("RP049", target_where,
                quoted_excerpt(op.name) + " takes a BOOL");
  }
  if (is_live()) keep_value(where);
  Expression stored;
  push_leaf(stored, AstOp::Name, cell.name, target_where);
  stored.insert(stored.end(),
                stack_.begin() + static_cast<std::ptrdiff_t>(start()),
                stack_.end());
  if (op.code == Set) {
    push_binary(stored, AstOp::Or, where);
  } else {
    push_unary(stored, AstOp::Not, where);
    push_binary(stored, AstOp::And, where);
  }
  writer_.assign(cell, target_where, stored, where);
}

/// May the current result be used behind this instruction?
bool ListParser::is_live() const {
  Cursor ahead = cursor_;
  ahead.skip_line();
  ahead.skip_line_ends();
  const std::string word = ahead.word();
  // `LD counter` gives the current result to an input of the block.
  if (names_.find_instance(ahead.word(1)) != nullptr) return true;
  return word != "LD" && word != "LDN" && !word.starts_with("END_") &&
         !ahead.at(TokenKind::End);
}

/// A result of more than one contact is computed once: what it reads may be
/// written before it is used again.
void ListParser::keep_value(SourceRange where) {
  if (stack_.back().op == AstOp::Bool) return;
  const Expression all = value();
  if (all.size() == 1 && kept_ == all.back().text) return;
  kept_ = writer_.keep("kept", kind_, all, where);
  stack_.resize(start());
  push_leaf(stack_, AstOp::Name, kept_, where);
}

}  // namespace rung::il_iec
