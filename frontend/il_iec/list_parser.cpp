#include "frontend/il_iec/list_parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "frontend/iec/bodies.h"
#include "frontend/iec/declarations.h"

namespace rung::il_iec {
namespace {

using enum Code;

constexpr std::size_t kMaxDepth = 200;

// By name.
constexpr std::array<Operator, 44> kOperators = {{
    {"ADD", Binary, false, false, iec::Operator::Add},
    {"AND", Binary, false, false, iec::Operator::And},
    {"ANDN", Binary, true, false, iec::Operator::And},
    {"CAL", Call},
    {"CALC", Call, false, true},
    {"CALCN", Call, true, true},
    {"CALNC", Call, true, true},
    {"CD", Pin},
    {"CLK", Pin},
    {"CU", Pin},
    {"DIV", Binary, false, false, iec::Operator::Divide},
    {"EQ", Binary, false, false, iec::Operator::Equal},
    {"GE", Binary, false, false, iec::Operator::GreaterEqual},
    {"GT", Binary, false, false, iec::Operator::Greater},
    {"IN", Pin},
    {"JMP", Jump},
    {"JMPC", Jump, false, true},
    {"JMPCN", Jump, true, true},
    {"JMPNC", Jump, true, true},
    {"LD", Load},
    {"LDN", Load, true},
    {"LE", Binary, false, false, iec::Operator::LessEqual},
    {"LT", Binary, false, false, iec::Operator::Less},
    {"MOD", Binary, false, false, iec::Operator::Modulo},
    {"MUL", Binary, false, false, iec::Operator::Multiply},
    {"NE", Binary, false, false, iec::Operator::NotEqual},
    {"NOT", Not},
    {"OR", Binary, false, false, iec::Operator::Or},
    {"ORN", Binary, true, false, iec::Operator::Or},
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
    {"SUB", Binary, false, false, iec::Operator::Subtract},
    {"XOR", Binary, false, false, iec::Operator::Xor},
    {"XORN", Binary, true, false, iec::Operator::Xor},
}};

constexpr Operator kAnd = {"AND", Binary, false, false, iec::Operator::And};
constexpr Operator kAndNot = {"ANDN", Binary, true, false, iec::Operator::And};

bool is_instance(const Symbol* symbol) {
  return symbol != nullptr && (symbol->kind == Symbol::Kind::Block ||
                               symbol->kind == Symbol::Kind::Instance);
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

void ListParser::fail(std::string_view code, SourceRange where,
                      std::string message) {
  scope_.fail(code, where, std::move(message));
  failed_ = true;
}

void ListParser::run() {
  find_labels();
  while (true) {
    cursor_.skip_line_ends();
    if (cursor_.at(TokenKind::End)) break;
    if (!scope_.step(cursor_.here())) return;
    failed_ = false;
    line();
    if (!failed_) continue;
    cursor_.skip_line();
    state_ = State::Broken;
  }
  for (const Frame& frame : frames_) {
    scope_.fail("RP047", frame.where, "this parenthesis is not closed");
  }
}

void ListParser::line() {
  if (cursor_.at(TokenKind::Word) && cursor_.at(TokenKind::Colon, 1)) {
    label();
    if (failed_ || cursor_.at(TokenKind::LineEnd) ||
        cursor_.at(TokenKind::End)) {
      return;
    }
  }
  if (cursor_.at(TokenKind::Semicolon)) return end_line();
  do {
    instruction();
  } while (!failed_ && (!frames_.empty() || cursor_.at(TokenKind::Close)) &&
           !cursor_.at(TokenKind::LineEnd) && !cursor_.at(TokenKind::End) &&
           !cursor_.at(TokenKind::Semicolon));
  if (!failed_) end_line();
}

void ListParser::end_line() {
  if (cursor_.accept(TokenKind::Semicolon)) check_comment();
  const bool ends =
      cursor_.at(TokenKind::LineEnd) || cursor_.at(TokenKind::End);
  if (failed_ || ends) return;
  fail("RP047", cursor_.here(),
       "expected the end of the line and found " + cursor_.shown());
}

// Behind `;` some write a comment; an instruction there must not be lost.
void ListParser::check_comment() {
  const std::string word = cursor_.word();
  if (is_operator(word) || cursor_.at(TokenKind::Colon, 1) ||
      word.starts_with("END_")) {
    return fail("RP047", cursor_.here(),
                "an instruction behind `;`: each has a line of its own (a "
                "comment is written `(* *)`)");
  }
  cursor_.skip_line();
}

const Operator* ListParser::take_operator(SourceRange& where) {
  const Token token = cursor_.peek();
  where = cursor_.here();
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
    fail(
        "RP040", where,
        quoted_excerpt(cursor_.text(token)) +
            " is no operator of instruction lists, and no function that is "
            "supported" +
            (scope_.errors().is_full() ? std::string()
                                       : did_you_mean(word, operator_names())));
  } else {
    fail("RP040", where,
         "expected an instruction and found " + cursor_.shown());
  }
  return nullptr;
}

bool ListParser::plain(std::string_view name, SourceRange where) {
  if (frames_.empty()) return true;
  fail("RP047", where,
       quoted_excerpt(name) + " inside of parentheses is not supported");
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

bool ListParser::known(SourceRange where, const iec::Type& type,
                       std::string_view what) {
  if (!known(where)) return false;
  if (value_.type == &type) return true;
  fail("RP049", where,
       std::string(what) + " takes a " + std::string(type.name) +
           ", and the current result is a " + std::string(value_.type->name));
  return false;
}

void ListParser::set_value(std::optional<Value> value) {
  if (!value) {
    failed_ = true;
    return;
  }
  value_ = std::move(*value);
  state_ = State::Known;
}

void ListParser::instruction() {
  const SourceRange here = cursor_.here();
  if (cursor_.accept(TokenKind::Close)) return close(here);
  const bool is_function = cursor_.at(TokenKind::Word) &&
                           !is_operator(cursor_.word()) &&
                           scope_.is_function(cursor_.text(cursor_.peek()));
  if (is_function) return function(here);
  SourceRange where;
  const Operator* const op = take_operator(where);
  if (op != nullptr) execute(*op, where);
}

void ListParser::execute(const Operator& op, SourceRange where) {
  switch (op.code) {
    case Load:
      return load(op, where);
    case Binary:
      return binary(op, where);
    case Not:
      // Some write an operand, which means nothing.
      if (known(where)) set_value(scope_.invert(std::move(value_), where));
      return;
    case Store:
    case Set:
    case Reset:
      return store(op, where);
    case Code::Jump:
    case Return:
      return jump(op, where);
    case Call:
      return call(op, where);
    case Code::Pin: {
      Symbol* const instance = instance_here();
      if (instance != nullptr) pin_operator(op, *instance, where);
      return;
    }
  }
}

void ListParser::load(const Operator& op, SourceRange where) {
  Symbol* const instance = cursor_.at(TokenKind::Word)
                               ? scope_.find(cursor_.text(cursor_.peek()))
                               : nullptr;
  if (is_instance(instance) && !cursor_.at(TokenKind::Dot, 1) && !op.negate &&
      state_ == State::Known) {
    cursor_.take();
    return pin_operator(op, *instance, where);
  }
  std::optional<Value> value = operand();
  if (value && op.negate) value = scope_.invert(std::move(*value), where);
  set_value(std::move(value));
}

void ListParser::binary(const Operator& op, SourceRange where) {
  if (cursor_.at(TokenKind::Open)) {
    const SourceRange open = cursor_.range(cursor_.take());
    const bool has_value = known(where);
    if (frames_.size() >= kMaxDepth) {
      return fail("RP047", where, "parentheses nest more than 200 deep");
    }
    frames_.push_back({std::move(value_), &op,
                       has_value ? State::Known : State::Broken,
                       cover(where, open)});
    if (!has_value) return;
    state_ = State::None;
    if (cursor_.at(TokenKind::LineEnd) || cursor_.at(TokenKind::Semicolon)) {
      return;
    }
    // AND( a is AND( and LD a.
    const bool starts = is_operator(cursor_.word()) &&
                        !cursor_.at(TokenKind::Dot, 1) &&
                        scope_.find(cursor_.word()) == nullptr;
    if (starts) return;
    static constexpr Operator kLoad = {"LD", Load};
    return load(kLoad, where);
  }
  std::optional<Value> right = operand();
  if (!right) failed_ = true;
  if (failed_ || !known(where)) return;
  apply(op, std::move(*right), where);
}

void ListParser::close(SourceRange where) {
  if (frames_.empty()) {
    return fail("RP047", where, "this parenthesis closes nothing");
  }
  Frame frame = std::move(frames_.back());
  const bool has_value = frame.state == State::Known && known(where);
  frames_.pop_back();
  if (!has_value) {
    failed_ = true;
    return;
  }
  Value right = std::move(value_);
  value_ = std::move(frame.left);
  state_ = frame.state;
  apply(*frame.op, std::move(right), frame.where);
}

void ListParser::apply(const Operator& op, Value right, SourceRange where) {
  std::optional<Value> operand = std::move(right);
  if (op.negate) operand = scope_.invert(std::move(*operand), where);
  if (!operand) {
    failed_ = true;
    return;
  }
  set_value(
      scope_.binary(op.op, std::move(value_), std::move(*operand), where));
}

void ListParser::store(const Operator& op, SourceRange where) {
  if (!plain(op.name, where)) return;
  if (!cursor_.at(TokenKind::Word) && !cursor_.at(TokenKind::Address)) {
    return fail("RP047", cursor_.here(),
                quoted_excerpt(op.name) +
                    " needs a variable and is followed by " + cursor_.shown());
  }
  Symbol* const instance = scope_.find(cursor_.text(cursor_.peek()));
  if (op.code != Store && is_instance(instance) &&
      !cursor_.at(TokenKind::Dot, 1)) {
    cursor_.take();
    return pin_operator(op, *instance, where);
  }
  SourceRange target_where;
  Symbol* const target = variable(target_where);
  if (target == nullptr) {
    failed_ = true;
    return;
  }
  if (!known(where)) return;
  write(op, *target, target_where, cover(where, target_where));
}

void ListParser::write(const Operator& op, Symbol& target,
                       SourceRange target_where, SourceRange where) {
  if (op.code != Store) return set_or_reset(op, target, target_where, where);
  std::optional<Value> stored = value_;
  if (op.negate) stored = scope_.invert(std::move(*stored), where);
  if (!stored ||
      !scope_.write(target, std::move(*stored), target_where, where)) {
    failed_ = true;
    return;
  }
  if (target.kind == Symbol::Kind::Preset) return;
  // The current result goes on, also where it read this variable.
  set_value(scope_.read(target, target_where));
  if (op.negate) set_value(scope_.invert(std::move(value_), where));
}

void ListParser::set_or_reset(const Operator& op, Symbol& target,
                              SourceRange target_where, SourceRange where) {
  if (!known(where, iec::kBool, op.name)) return;
  if (!scope_.check_writable(target, target_where)) {
    failed_ = true;
    return;
  }
  if (target.type != &iec::kBool) {
    return fail("RP049", target_where,
                quoted_excerpt(op.name) + " takes a BOOL");
  }
  if (is_live()) keep_value(where);
  std::optional<Value> old = scope_.read(target, target_where);
  std::optional<Value> stored;
  if (op.code == Set) {
    stored = scope_.binary(iec::Operator::Or, std::move(*old), value_, where);
  } else if (auto kept = scope_.invert(value_, where)) {
    stored = scope_.binary(iec::Operator::And, std::move(*old),
                           std::move(*kept), where);
  }
  if (!stored ||
      !scope_.write(target, std::move(*stored), target_where, where)) {
    failed_ = true;
  }
}

/// May the current result be used behind this instruction?
bool ListParser::is_live() const {
  Cursor ahead = cursor_;
  ahead.skip_line();
  ahead.skip_line_ends();
  const std::string word = ahead.word();
  // `LD counter` gives the current result to an input of the block.
  if (ahead.at(TokenKind::Word, 1) &&
      is_instance(scope_.find(ahead.text(ahead.peek(1))))) {
    return true;
  }
  return word != "LD" && word != "LDN" && !ahead.at(TokenKind::End);
}

/// A result of more than one contact is computed once: what it reads may be
/// written before it is used again.
void ListParser::keep_value(SourceRange where) {
  if (value_.nodes.back().op == AstOp::Bool) return;
  if (value_.nodes.size() == 1 && kept_ == value_.nodes.back().text) return;
  kept_ =
      scope_.writer().keep("kept", value_.type->shape(), value_.nodes, where);
  value_.nodes.clear();
  value_.symbol = nullptr;
  push_leaf(value_.nodes, AstOp::Name, kept_, where);
}

}  // namespace rung::il_iec

namespace rung::iec {

Body instruction_list(std::shared_ptr<const TokenList> list, std::size_t begin,
                      std::size_t end) {
  return [list = std::move(list), begin, end](Scope& scope) {
    il_iec::ListParser(Cursor(*list, begin, end), scope).run();
  };
}

bool looks_like_list(const TokenList& list, std::size_t begin,
                     std::size_t end) {
  Cursor cursor(list, begin, end);
  cursor.skip_line_ends();
  while (cursor.at(TokenKind::Word) && cursor.at(TokenKind::Colon, 1)) {
    cursor.take();
    cursor.take();
    cursor.skip_line_ends();
  }
  if (!cursor.at(TokenKind::Word)) return false;
  // `CALC foo`, `foo_f a, b`; `LD := x;` is structured text, `R = I0;` a
  // script.
  if (il_iec::is_operator(cursor.word())) {
    for (const TokenKind other :
         {TokenKind::Assign, TokenKind::Equal, TokenKind::Dot, TokenKind::Open,
          TokenKind::Semicolon}) {
      if (cursor.at(other, 1)) return false;
    }
    return true;
  }
  if (cursor.at(TokenKind::Word, 1)) {
    // A sequential function chart is no list.
    return !is_reserved(cursor.word()) && cursor.word() != "INITIAL_STEP";
  }
  if (!cursor.at(TokenKind::Open, 1)) return false;
  // A call: a statement has `;` behind it.
  std::size_t depth = 0;
  while (!cursor.at(TokenKind::End)) {
    const TokenKind kind = cursor.take().kind;
    if (kind == TokenKind::Open) ++depth;
    if (kind == TokenKind::Close && --depth == 0) break;
  }
  return cursor.at(TokenKind::LineEnd);
}

}  // namespace rung::iec
