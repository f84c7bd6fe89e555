#include "frontend/iec/declarations.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace rung::iec {
namespace {

struct Section {
  std::string_view word;
  Role role;
};
constexpr std::array<Section, 7> kSections = {{{"VAR", Role::Local},
                                               {"VAR_EXTERNAL", Role::External},
                                               {"VAR_GLOBAL", Role::Global},
                                               {"VAR_INPUT", Role::Input},
                                               {"VAR_IN_OUT", Role::InOut},
                                               {"VAR_OUTPUT", Role::Output},
                                               {"VAR_TEMP", Role::Temp}}};

constexpr std::array<std::string_view, 28> kReserved = {
    "AND",      "BY",      "CASE",   "DO",         "ELSE",    "ELSIF",
    "END_CASE", "END_FOR", "END_IF", "END_REPEAT", "END_VAR", "END_WHILE",
    "EXIT",     "FALSE",   "FOR",    "IF",         "MOD",     "NOT",
    "OF",       "OR",      "REPEAT", "RETURN",     "THEN",    "TO",
    "TRUE",     "UNTIL",   "WHILE",  "XOR"};

class Reader {
 public:
  Reader(Cursor& cursor, std::vector<Variable>& variables, ErrorLimit& errors)
      : cursor_(cursor), variables_(variables), errors_(errors) {}

  void section() {
    const Token token = cursor_.take();
    const std::string word = upper(cursor_.text(token));
    const auto* const found =
        std::find_if(kSections.begin(), kSections.end(),
                     [&](const Section& it) { return it.word == word; });
    if (found == kSections.end()) {
      error("RP041", cursor_.range(token),
            quoted_excerpt(cursor_.text(token)) + " is not supported");
      return skip_section();
    }
    shape_ = {};
    shape_.role = found->role;
    qualifiers();
    while (true) {
      cursor_.skip_line_ends();
      if (cursor_.at(TokenKind::End)) {
        return error("RP042", cursor_.range(token),
                     quoted_excerpt(cursor_.text(token)) + " has no END_VAR");
      }
      if (cursor_.accept_word("END_VAR")) {
        cursor_.accept(TokenKind::Semicolon);
        return;
      }
      declaration();
    }
  }

 private:
  void error(std::string_view code, SourceRange where, std::string message) {
    errors_.error(code, where, std::move(message));
  }

  void qualifiers() {
    while (true) {
      const std::string word = cursor_.word();
      if (word == "CONSTANT") {
        shape_.constant = true;
      } else if (word == "RETAIN" || word == "PERSISTENT") {
        shape_.retain = true;
      } else if (word != "NON_RETAIN") {
        return;
      }
      cursor_.take();
    }
  }

  void skip_section() {
    while (!cursor_.at(TokenKind::End) && cursor_.word() != "END_VAR") {
      cursor_.take();
    }
    cursor_.take();
  }

  /// To behind the next `;`, or to END_VAR.
  void recover() {
    while (!cursor_.at(TokenKind::End) && cursor_.word() != "END_VAR") {
      if (cursor_.take().kind == TokenKind::Semicolon) return;
    }
  }

  void expected(std::string_view what) {
    error("RP042", cursor_.here(),
          "expected " + std::string(what) + " and found " + cursor_.shown());
    recover();
  }

  // name [AT %..] {, name} : type [:= value] ;
  void declaration() {
    const std::size_t first = variables_.size();
    do {
      cursor_.skip_line_ends();
      if (!cursor_.at(TokenKind::Word)) {
        return expected("the name of a variable");
      }
      if (!name()) return;
      cursor_.skip_line_ends();
    } while (cursor_.accept(TokenKind::Comma));
    if (!cursor_.accept(TokenKind::Colon)) return expected("`:` and a type");
    cursor_.skip_line_ends();
    if (!cursor_.at(TokenKind::Word)) return expected("a type");
    const SourceRange type = text_up_to(true);
    SourceRange initial;
    if (cursor_.accept(TokenKind::Assign)) {
      cursor_.skip_line_ends();
      initial = text_up_to(false);
      if (initial.begin == initial.end) return expected("an initial value");
    }
    if (!cursor_.accept(TokenKind::Semicolon)) return expected("`;`");
    for (std::size_t i = first; i < variables_.size(); ++i) {
      variables_[i].type = text_of(type);
      variables_[i].type_where = type;
      variables_[i].initial = text_of(initial);
    }
  }

  bool name() {
    const Token token = cursor_.take();
    Variable variable = shape_;
    variable.name = cursor_.text(token);
    variable.where = cursor_.range(token);
    if (is_reserved(upper(variable.name))) {
      error("RP042", variable.where,
            quoted_excerpt(variable.name) + " is a reserved word");
    }
    if (cursor_.accept_word("AT")) {
      if (!cursor_.at(TokenKind::Address)) {
        expected("an address such as %IX0.0");
        return false;
      }
      variable.address = cursor_.text(cursor_.take());
    }
    variables_.push_back(variable);
    return true;
  }

  /// From here to before `;`, END_VAR, and `:=` if that is an end too.
  SourceRange text_up_to(bool assign) {
    SourceRange where = cursor_.here();
    where.end = where.begin;
    while (!cursor_.at(TokenKind::End) && !cursor_.at(TokenKind::Semicolon) &&
           cursor_.word() != "END_VAR" &&
           !(assign && cursor_.at(TokenKind::Assign))) {
      const bool blank = cursor_.at(TokenKind::LineEnd);
      const SourceRange token = cursor_.range(cursor_.take());
      if (!blank) where.end = token.end;
    }
    return where;
  }

  std::string_view text_of(SourceRange where) const {
    return cursor_.list().text.substr(where.begin, where.end - where.begin);
  }

  Cursor& cursor_;
  std::vector<Variable>& variables_;
  ErrorLimit& errors_;
  Variable shape_;
};

}  // namespace

bool is_reserved(std::string_view upper_word) {
  return std::find(kReserved.begin(), kReserved.end(), upper_word) !=
         kReserved.end();
}

bool read_declarations(Cursor& cursor, std::vector<Variable>& variables,
                       ErrorLimit& errors) {
  Reader reader(cursor, variables, errors);
  for (bool any = false;; any = true) {
    cursor.skip_line_ends();
    const std::string word = cursor.word();
    if (word != "VAR" && !word.starts_with("VAR_")) return any;
    reader.section();
  }
}

}  // namespace rung::iec
