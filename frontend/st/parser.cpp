#include "frontend/st/parser.h"

#include <array>
#include <utility>

#include "frontend/iec/bodies.h"
#include "frontend/st/endless.h"

namespace rung::st {
namespace {

using iec::Operator;
using iec::TokenKind;
using iec::Value;

constexpr std::uint32_t kMaxPasses = 1000;

}  // namespace

void Parser::fail(std::string_view code, SourceRange where,
                  std::string message) {
  scope_.fail(code, where, std::move(message));
  failed_ = true;
}

void Parser::run() {
  while (!stopped_) {
    cursor_.skip_line_ends();
    if (cursor_.at(TokenKind::End)) break;
    if (!scope_.step(cursor_.here())) return;
    failed_ = false;
    statement();
    if (failed_) recover();
  }
  if (blocks_.empty() || stopped_) return;
  const Block& open = blocks_.back();
  constexpr std::array<std::string_view, 3> kEnds = {"END_IF", "END_CASE",
                                                     "END_FOR"};
  scope_.fail(
      "RP047", open.where,
      "this has no " + std::string(kEnds[static_cast<std::size_t>(open.kind)]));
}

/// To behind the next `;`, or to a word that begins or ends a block.
void Parser::recover() {
  while (!cursor_.at(TokenKind::End)) {
    if (cursor_.accept(TokenKind::Semicolon)) return;
    const std::string word = cursor_.word();
    if (word.starts_with("END_") || word == "ELSE" || word == "ELSIF") return;
    cursor_.take();
  }
}

void Parser::expect(TokenKind kind, std::string_view shown) {
  cursor_.skip_line_ends();
  if (cursor_.accept(kind)) return;
  fail("RP047", cursor_.here(),
       "expected " + std::string(shown) + " and found " + cursor_.shown());
}

bool Parser::expect_word(std::string_view word) {
  cursor_.skip_line_ends();
  if (cursor_.accept_word(word)) return true;
  fail("RP047", cursor_.here(),
       "expected " + std::string(word) + " and found " + cursor_.shown());
  return false;
}

void Parser::end_statement() {
  if (!failed_) expect(TokenKind::Semicolon, "`;`");
}

void Parser::statement() {
  const SourceRange where = cursor_.here();
  if (cursor_.accept(TokenKind::Semicolon)) return;
  if (cursor_.at(TokenKind::Pragma)) {
    fail("RP041", where,
         "a pragma is not supported: what it does is not known here");
    cursor_.take();
    return;
  }
  if (!blocks_.empty() && blocks_.back().kind == BlockKind::Case &&
      at_label()) {
    return labels();
  }
  const std::string word = cursor_.word();
  const Block* const cases = innermost(BlockKind::Case);
  const bool between = cases != nullptr && cases->taken.empty() &&
                       !cases->has_else && word != "ELSE" && word != "END_CASE";
  if (between) {
    return fail("RP047", where,
                "expected a label of the CASE and found " + cursor_.shown());
  }
  if (keyword(word, where)) return;
  assignment_or_call(where);
}

bool Parser::keyword(const std::string& word, SourceRange where) {
  if (word == "IF") {
    begin_if(where);
  } else if (word == "ELSIF") {
    Block* const block = innermost(BlockKind::If);
    cursor_.take();
    if (block == nullptr) {
      fail("RP047", where, "ELSIF outside of an IF");
    } else if (block->has_else) {
      fail("RP047", where, "ELSIF behind ELSE");
    } else {
      begin_branch(*block, where);
      condition(*block, where);
    }
  } else if (word == "ELSE") {
    begin_else(where);
  } else if (word == "END_IF") {
    end_block(BlockKind::If, "IF", where);
  } else if (word == "CASE") {
    begin_case(where);
  } else if (word == "END_CASE") {
    end_block(BlockKind::Case, "CASE", where);
  } else if (word == "FOR") {
    begin_for(where);
  } else if (word == "END_FOR") {
    end_for(where);
  } else if (word == "RETURN") {
    cursor_.take();
    scope_.leave_body(where);
    end_statement();
  } else if (word == "WHILE" || word == "REPEAT" || word == "EXIT" ||
             word == "GOTO" || word == "__TRY" || word == "INITIAL_STEP" ||
             word == "STEP" || word == "TRANSITION" || word == "ACTION") {
    unsupported(word, where);
  } else {
    return false;
  }
  return true;
}

void Parser::unsupported(const std::string& word, SourceRange where) {
  std::string why = "`" + word + "` is not supported";
  const bool loop = word == "WHILE" || word == "REPEAT";
  const bool endless = loop && keeps_its_condition(cursor_);
  if (endless) {
    why = "nothing in this " + word + " changes its condition: " +
          (word == "WHILE"
               ? "a scan that enters it never ends"
               : "its first pass is the last one, or the scan never ends");
  } else if (loop) {
    why +=
        ": the number of its passes is not constant, so no bound of the "
        "scan is known";
  } else if (word.find("STEP") != word.npos || word == "TRANSITION" ||
             word == "ACTION") {
    why += ": this is a sequential function chart";
  }
  scope_.fail(endless ? "RP100" : "RP041", where, why);
  stopped_ = true;
}

void Parser::assignment_or_call(SourceRange where) {
  if (cursor_.at(TokenKind::Word) && cursor_.at(TokenKind::Open, 1) &&
      scope_.find(cursor_.text(cursor_.peek())) == nullptr) {
    // A function's result may be left unused only with outputs; it is called.
    if (!expressions_.expression()) failed_ = true;
    return end_statement();
  }
  SourceRange target_where;
  iec::Symbol* const target = expressions_.variable(target_where);
  if (target == nullptr) {
    failed_ = true;
    return;
  }
  cursor_.skip_line_ends();
  if (cursor_.at(TokenKind::Open)) {
    if (!expressions_.call(*target, target_where)) failed_ = true;
    return end_statement();
  }
  if (!cursor_.accept(TokenKind::Assign)) {
    return fail("RP047", cursor_.here(),
                "expected `:=` and found " + cursor_.shown());
  }
  std::optional<Value> value = expressions_.expression();
  if (!value) {
    failed_ = true;
    return;
  }
  where.end = value->where.end > where.end ? value->where.end : where.end;
  if (!scope_.write(*target, std::move(*value), target_where, where)) {
    failed_ = true;
  }
  end_statement();
}

Parser::Block* Parser::innermost(BlockKind kind) {
  if (blocks_.empty() || blocks_.back().kind != kind) return nullptr;
  return &blocks_.back();
}

// --- IF ----------------------------------------------------------------------

void Parser::begin_if(SourceRange where) {
  cursor_.take();
  Block block;
  block.kind = BlockKind::If;
  block.where = where;
  // What is entered is left at END_IF, with the RETURNs in between.
  std::optional<Value> value = expressions_.expression();
  if (!value || value->type != &iec::kBool) {
    if (value) fail("RP049", value->where, "the condition of IF is a BOOL");
    value = scope_.bit(true, where);
    failed_ = true;
  }
  block.outer = scope_.enter(*value, where);
  block.rest = block.outer;
  block.taken = scope_.writer().guard();
  blocks_.push_back(std::move(block));
  if (!failed_) expect_word("THEN");
}

/// Leaves the branch before; what follows is on where none is taken so far.
void Parser::begin_branch(Block& block, SourceRange where) {
  scope_.expansion().restore(block.rest);
  if (block.taken.empty()) return;
  Value none{{}, &iec::kBool, {}, where};
  push_leaf(none.nodes, AstOp::Name, block.taken, where);
  push_unary(none.nodes, AstOp::Not, where);
  scope_.enter(none, where);
  block.rest = scope_.expansion().context();
}

void Parser::condition(Block& block, SourceRange where) {
  std::optional<Value> value = expressions_.expression();
  if (value && value->type != &iec::kBool) {
    fail("RP049", value->where, "the condition of ELSIF is a BOOL");
  }
  if (!value || failed_) {
    failed_ = true;
    return;
  }
  scope_.enter(*value, where);
  block.taken = scope_.writer().guard();
  expect_word("THEN");
}

void Parser::begin_else(SourceRange where) {
  cursor_.take();
  if (blocks_.empty() || blocks_.back().kind == BlockKind::For ||
      blocks_.back().has_else) {
    return fail("RP047", where, "ELSE belongs to no IF and no CASE");
  }
  blocks_.back().has_else = true;
  begin_branch(blocks_.back(), where);
}

void Parser::end_block(BlockKind kind, std::string_view word,
                       SourceRange where) {
  cursor_.take();
  Block* const block = innermost(kind);
  if (block == nullptr) {
    scope_.fail("RP047", where,
                "this ends no " + std::string(word) + " that is open");
    stopped_ = true;
    return;
  }
  scope_.leave(block->outer, where);
  blocks_.pop_back();
  cursor_.skip_line_ends();
  cursor_.accept(TokenKind::Semicolon);  // some leave it out
}

// --- CASE --------------------------------------------------------------------

void Parser::begin_case(SourceRange where) {
  cursor_.take();
  Block block;
  block.kind = BlockKind::Case;
  block.where = where;
  Value selector = scope_.number(0, iec::kInt, where);
  std::optional<Value> given = expressions_.expression();
  if (!given) {
    failed_ = true;
  } else if (given->type->kind != iec::Kind::Integer) {
    fail("RP049", given->where, "the selector of CASE is an integer");
  } else {
    selector = std::move(*given);
  }
  if (!selector.constant) {
    // Once: a branch may write what it reads.
    const std::string_view cell = scope_.writer().keep(
        "case", selector.type->shape(), selector.nodes, where);
    selector.nodes.clear();
    push_leaf(selector.nodes, AstOp::Name, cell, where);
    selector.symbol = nullptr;
  }
  block.selector = std::move(selector);
  block.outer = scope_.here();
  block.rest = block.outer;
  blocks_.push_back(std::move(block));
  if (!failed_) expect_word("OF");
}

/// A statement's first word is followed by none of these.
bool Parser::at_label() const {
  if (cursor_.at(TokenKind::Number) || cursor_.at(TokenKind::Minus)) {
    return true;
  }
  return cursor_.at(TokenKind::Word) &&
         (cursor_.at(TokenKind::Colon, 1) || cursor_.at(TokenKind::Comma, 1) ||
          cursor_.at(TokenKind::Range, 1));
}

void Parser::labels() {
  Block& block = blocks_.back();
  const SourceRange where = cursor_.here();
  if (block.has_else) return fail("RP047", where, "a label behind ELSE");
  begin_branch(block, where);
  Value condition = scope_.bit(false, where);
  bool first = true;
  do {
    cursor_.skip_line_ends();
    if (!label(block, condition, first)) return;
    first = false;
    cursor_.skip_line_ends();
  } while (cursor_.accept(TokenKind::Comma));
  scope_.enter(condition, where);
  block.taken = scope_.writer().guard();
  expect(TokenKind::Colon, "`:`");
}

bool Parser::label_value(const Value& selector, Value& result) {
  const SourceRange where = cursor_.here();
  const bool minus = cursor_.accept(TokenKind::Minus);
  std::optional<Value> value;
  if (cursor_.at(TokenKind::Number)) {
    value = scope_.literal(cursor_.text(cursor_.take()), where);
  } else if (cursor_.at(TokenKind::Word)) {
    SourceRange whole;
    iec::Symbol* const symbol = expressions_.variable(whole);
    if (symbol != nullptr) value = scope_.read(*symbol, whole);
  } else {
    fail("RP047", where, "expected a number and found " + cursor_.shown());
    return false;
  }
  if (value && !value->constant) {
    fail("RP049", where, "a label of CASE is a constant");
    return false;
  }
  if (value && minus) value = scope_.negate(std::move(*value), where);
  if (value) value = scope_.convert(std::move(*value), *selector.type, where);
  if (!value) {
    failed_ = true;
    return false;
  }
  result = std::move(*value);
  return true;
}

bool Parser::label(const Block& block, Value& condition, bool first) {
  const SourceRange where = cursor_.here();
  const Value& selector = block.selector;
  Value low;
  if (!label_value(selector, low)) return false;
  std::optional<Value> here;
  if (cursor_.accept(TokenKind::Range)) {
    Value high;
    if (!label_value(selector, high)) return false;
    auto above = scope_.binary(Operator::GreaterEqual, selector, low, where);
    auto below = scope_.binary(Operator::LessEqual, selector, high, where);
    if (above && below) {
      here = scope_.binary(Operator::And, std::move(*above), std::move(*below),
                           where);
    }
  } else {
    here = scope_.binary(Operator::Equal, selector, low, where);
  }
  if (here && !first) {
    here = scope_.binary(Operator::Or, std::move(condition), std::move(*here),
                         where);
  }
  if (!here) {
    failed_ = true;
    return false;
  }
  condition = std::move(*here);
  return true;
}

// --- FOR ---------------------------------------------------------------------

bool Parser::for_value(std::string_view what, std::int64_t& value) {
  std::optional<Value> given = expressions_.expression();
  if (given && given->constant && given->type->kind == iec::Kind::Integer) {
    value = *given->constant;
    return true;
  }
  if (given) {
    scope_.fail("RP041", given->where,
                "the " + std::string(what) +
                    " of a FOR that is no constant is not supported: no bound "
                    "of the scan is known");
  }
  return false;
}

void Parser::begin_for(SourceRange where) {
  cursor_.take();
  Block block;
  block.kind = BlockKind::For;
  block.where = where;
  cursor_.skip_line_ends();
  SourceRange control;
  block.control = expressions_.variable(control);
  stopped_ = true;  // unless all is well
  if (block.control == nullptr) return;
  if (block.control->kind != iec::Symbol::Kind::Cell ||
      block.control->type->kind != iec::Kind::Integer) {
    scope_.fail("RP049", control, "the variable of FOR is an integer");
    return;
  }
  expect(TokenKind::Assign, "`:=`");
  if (failed_ || !scope_.check_writable(*block.control, control)) return;
  if (!for_value("begin", block.next) || !expect_word("TO") ||
      !for_value("end", block.last)) {
    return;
  }
  cursor_.skip_line_ends();
  if (cursor_.accept_word("BY") && !for_value("step", block.step)) return;
  if (block.step == 0) {
    scope_.fail("RP049", where, "a FOR whose step is 0 does not end");
    return;
  }
  if (!expect_word("DO")) return;
  stopped_ = false;
  block.body = cursor_.position();
  blocks_.push_back(std::move(block));
  if (!begin_pass(blocks_.back()) && !stopped_) skip_loop();
}

void Parser::set_control(Block& block, std::int64_t value) {
  block.control->locked = false;
  Value number = scope_.number(value, iec::kLiteral, block.where);
  if (!scope_.write(*block.control, std::move(number), block.where,
                    block.where)) {
    stopped_ = true;
  }
}

/// False: there is none more, and the control variable is past its end.
bool Parser::begin_pass(Block& block) {
  const std::int64_t value = block.next;
  set_control(block, value);
  const bool more = block.step > 0 ? value <= block.last : value >= block.last;
  if (!more || stopped_) return false;
  if (++block.passes > kMaxPasses || scope_.has_failed()) {
    if (block.passes > kMaxPasses) {
      scope_.fail("RP050", block.where, "a FOR of more than 1000 passes");
    }
    stopped_ = true;
    return false;
  }
  block.control->locked = true;
  block.next = value + block.step;
  return true;
}

void Parser::end_for(SourceRange where) {
  Block* const block = innermost(BlockKind::For);
  if (block == nullptr) {
    scope_.fail("RP047", where, "this ends no FOR that is open");
    stopped_ = true;
    return;
  }
  if (begin_pass(*block)) {
    cursor_.go_to(block->body);
    return;
  }
  cursor_.take();
  blocks_.pop_back();
  cursor_.skip_line_ends();
  cursor_.accept(TokenKind::Semicolon);
}

/// Over a loop without a pass.
void Parser::skip_loop() {
  const SourceRange where = blocks_.back().where;
  blocks_.pop_back();
  for (std::size_t depth = 1; depth > 0;) {
    if (cursor_.at(TokenKind::End)) {
      scope_.fail("RP047", where, "this has no END_FOR");
      stopped_ = true;
      return;
    }
    const std::string word = cursor_.word();
    if (word == "FOR") ++depth;
    if (word == "END_FOR") --depth;
    cursor_.take();
  }
  cursor_.skip_line_ends();
  cursor_.accept(TokenKind::Semicolon);
}

}  // namespace rung::st

namespace rung::iec {

Body structured_text(std::shared_ptr<const TokenList> list, std::size_t begin,
                     std::size_t end) {
  return [list = std::move(list), begin, end](Scope& scope) {
    st::Parser(Cursor(*list, begin, end), scope).run();
  };
}

}  // namespace rung::iec
