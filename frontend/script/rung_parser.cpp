#include <string>

#include "frontend/script/parser.h"

namespace rung::script {

using enum TokenKind;

bool StatementParser::at_section_end() const {
  return cursor_->at(End) || cursor_->at(VarSection) || cursor_->at(SimSection);
}

bool StatementParser::end_statement() {
  const Token& token = cursor_->peek();
  if (token.kind == Semicolon) {
    cursor_->take();
    return true;
  }
  if (at_section_end() || token.starts_line || token.kind == CloseBrace) {
    return true;
  }
  if (token.kind == Close) {
    errors_->error("RP011", cursor_->range(token), "this `)` closes nothing");
  } else {
    report_unexpected(*cursor_, token, "an operator or `;`", *errors_);
  }
  return false;
}

void RungParser::run() {
  while (!at_section_end()) rung();
}

void RungParser::rung() {
  const Token& token = cursor().peek();
  if (token.kind == Semicolon) {
    cursor().take();
    return;
  }
  if (token.kind != Name) {
    report_unexpected(cursor(), token, "the name that a rung assigns",
                      errors());
    cursor().take();
    recover();
    return;
  }
  cursor().take();
  const std::string_view name = cursor().text(token);
  if (is_reserved(name) || name == "true" || name == "false") {
    errors().error("RP013", cursor().range(token),
                   quoted_excerpt(name) +
                       " cannot be used in a rung: a rung is `name "
                       "= expression;`");
    recover();
  } else if (cursor().at(Assign)) {
    cursor().take();
    assignment(token);
  } else {
    no_assignment(token);
    recover();
  }
}

void RungParser::assignment(const Token& target) {
  const auto value = expressions().parse();
  if (!value) {
    recover();
    return;
  }
  ast().rungs.push_back({.target = cursor().text(target),
                         .target_where = cursor().range(target),
                         .value = value->nodes,
                         .where = from(target, value->end)});
  if (!end_statement()) recover();
}

/// A name with something else than `=` behind it.
void RungParser::no_assignment(const Token& target) {
  const Token& token = cursor().peek();
  const std::string name = quoted_excerpt(cursor().text(target));
  const std::string seen = quoted_excerpt(cursor().text(token));
  if (at_section_end() || token.starts_line || token.kind == Semicolon) {
    errors().error("RP010", cursor().range(target),
                   "expected `=` after " + name +
                       ": a rung is `name = "
                       "expression;`");
    return;
  }
  if (token.kind == Open) {
    errors().error(
        "RP010", cursor().range(target),
        "the result of " + name + " is lost: a rung is `name = expression;`");
  } else if (token.kind == Equal || token.kind == StrictEqual) {
    errors().error("RP010", cursor().range(token),
                   seen + " compares: a rung assigns with `=`");
  } else if (is_update(token.kind)) {
    errors().error("RP012", cursor().range(token),
                   "the operator " + seen +
                       " is not supported in a rung: write `name = "
                       "expression;`");
  } else {
    report_unexpected(cursor(), token, "`=` after " + name, errors());
  }
}

/// To the next rung: past `;`, or where a line begins with `name =`.
void RungParser::recover() {
  while (!at_section_end() && !starts_assignment(cursor())) {
    if (cursor().take().kind == Semicolon) return;
  }
}

}  // namespace rung::script
