#pragma once

#include <string_view>
#include <unordered_set>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"
#include "frontend/script/expression_parser.h"
#include "frontend/script/token.h"

namespace rung::script {

/// What the sections have in common: a place, an end of statement, recovery.
class StatementParser {
 public:
  StatementParser(Cursor& cursor, Ast& ast, ErrorLimit& errors)
      : cursor_(&cursor),
        ast_(&ast),
        errors_(&errors),
        expressions_(cursor, ast.nodes, errors) {}

 protected:
  bool at_section_end() const;
  /// Takes `;` or sees another end of a statement; false after an error.
  bool end_statement();
  SourceRange from(const Token& first, std::uint32_t end) const {
    return {cursor_->file(), first.begin, end};
  }
  Cursor& cursor() { return *cursor_; }
  const Cursor& cursor() const { return *cursor_; }
  Ast& ast() { return *ast_; }
  ErrorLimit& errors() { return *errors_; }
  ExpressionParser& expressions() { return expressions_; }

 private:
  Cursor* cursor_;
  Ast* ast_;
  ErrorLimit* errors_;
  ExpressionParser expressions_;
};

/// The rungs, up to the first section marker or the end.
class RungParser : public StatementParser {
 public:
  using StatementParser::StatementParser;
  void run();

 private:
  void rung();
  void assignment(const Token& target);
  void no_assignment(const Token& target);
  void recover();
};

/// The sections `//Var` and `//Sim`: a small part of Javascript.
class PlantParser : public StatementParser {
 public:
  enum class Section : std::uint8_t { Var, Sim };

  PlantParser(Cursor& cursor, Ast& ast, ErrorLimit& errors, Section section)
      : StatementParser(cursor, ast, errors), section_(section) {}
  void run();

 private:
  /// A body that is being read.
  struct Open {
    enum class Kind : std::uint8_t { Block, If, Else };
    Kind kind = Kind::Block;
    Token token;
    bool broken = false;  // an `if` whose condition has an error
  };

  void statement();
  bool named_statement();  // these: false after an error
  bool if_head(const Token& word);
  bool declarations();
  bool assignment(const Token& target);
  bool update(const Token& target);
  bool prefix_update();
  bool call(const Token& callee, const Token& last);
  bool skip_arguments(const Token& callee);
  bool check_argument(const Token& token);
  void skip_parentheses();
  bool check_expression(const AstExpression& value);
  void close_block();
  void finish_statement();
  void step(const Token& target, const Token& sign);
  void emit(const Token& target, AstExpression value, std::uint32_t end);
  void bracket(AstPlantStatement::Kind kind, const Token& token);
  void note_ignored(std::string_view name, const SourceRange& where);
  void recover();

  Section section_;
  std::vector<Open> open_;
  std::unordered_set<std::string_view> ignored_;
};

}  // namespace rung::script
