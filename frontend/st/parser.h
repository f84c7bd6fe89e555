#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/iec/cursor.h"
#include "frontend/iec/scope.h"
#include "frontend/st/expression_parser.h"

namespace rung::st {

/// Executes the statements of a body once: IF and CASE become conditions, FOR
/// its passes.
class Parser {
 public:
  Parser(iec::Cursor cursor, iec::Scope& scope)
      : cursor_(cursor), scope_(scope), expressions_(cursor_, scope) {}

  void run();

 private:
  enum class BlockKind : std::uint8_t { If, Case, For };
  struct Block {
    BlockKind kind = BlockKind::If;
    SourceRange where;
    iec::Context outer;      // where it began
    iec::Context rest;       // of IF and CASE: no branch so far is taken
    std::string_view taken;  // the last branch's condition; empty: none yet
    bool has_else = false;
    iec::Value selector;  // of CASE
    // Of FOR.
    iec::Symbol* control = nullptr;
    std::int64_t next = 0;
    std::int64_t last = 0;
    std::int64_t step = 1;
    std::size_t body = 0;
    std::uint32_t passes = 0;
  };

  void statement();
  bool keyword(const std::string& word, SourceRange where);
  void assignment_or_call(SourceRange where);
  void expect(iec::TokenKind kind, std::string_view shown);
  bool expect_word(std::string_view word);
  void fail(std::string_view code, SourceRange where, std::string message);
  void unsupported(const std::string& word, SourceRange where);
  void recover();
  void end_statement();

  void begin_if(SourceRange where);
  void begin_branch(Block& block, SourceRange where);
  void condition(Block& block, SourceRange where);
  void begin_else(SourceRange where);
  void end_block(BlockKind kind, std::string_view word, SourceRange where);

  void begin_case(SourceRange where);
  bool at_label() const;
  void labels();
  bool label(const Block& block, iec::Value& condition, bool first);
  bool label_value(const iec::Value& selector, iec::Value& result);

  void begin_for(SourceRange where);
  bool for_value(std::string_view what, std::int64_t& value);
  bool begin_pass(Block& block);
  void end_for(SourceRange where);
  void skip_loop();
  void set_control(Block& block, std::int64_t value);

  Block* innermost(BlockKind kind);

  iec::Cursor cursor_;
  iec::Scope& scope_;
  ExpressionParser expressions_;
  std::vector<Block> blocks_;
  bool failed_ = false;   // in this statement
  bool stopped_ = false;  // no statement is read any more
};

}  // namespace rung::st
