#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "base/text.h"
#include "frontend/il_iec/parser.h"

namespace rung::il_iec {
namespace {

using Role = AstDeclaration::Kind;

struct Section {
  std::string_view word;
  Role role;
};
constexpr std::array<Section, 3> kSections = {{{"VAR", Role::Memory},
                                               {"VAR_INPUT", Role::Input},
                                               {"VAR_OUTPUT", Role::Output}}};

class Reader {
 public:
  Reader(Cursor& cursor, Names& names, ErrorLimit& errors)
      : cursor_(cursor), names_(names), errors_(errors) {}

  /// The block whose first word is here.
  void section() {
    const Token& token = cursor_.take();
    const std::string word = upper(cursor_.text(token));
    const auto* const row =
        std::find_if(kSections.begin(), kSections.end(),
                     [&](const Section& it) { return it.word == word; });
    if (row == kSections.end()) {
      error("RP041", cursor_.range(token),
            quoted_excerpt(cursor_.text(token)) +
                " is not supported: blocks are VAR, VAR_INPUT and VAR_OUTPUT");
      return skip_section();
    }
    role_ = row->role;
    constant_ = false;
    if (cursor_.word() == "CONSTANT" && role_ == Role::Memory) {
      cursor_.take();
      constant_ = true;
    } else if (cursor_.at(TokenKind::Word) &&
               cursor_.word().ends_with("RETAIN")) {
      error("RP041", cursor_.range(cursor_.peek()),
            quoted_excerpt(cursor_.text(cursor_.peek())) +
                " is not supported: values start anew at power-up");
      cursor_.take();
    }
    while (true) {
      cursor_.skip_line_ends();
      if (cursor_.at(TokenKind::End)) {
        return error("RP042", cursor_.range(token),
                     quoted_excerpt(cursor_.text(token)) + " has no END_VAR");
      }
      if (cursor_.word() == "END_VAR") {
        cursor_.take();
        cursor_.accept(TokenKind::Semicolon);
        return;
      }
      variables();
    }
  }

 private:
  struct Name {
    Token token;
    Token address;  // AT, or End
  };

  void error(std::string_view code, SourceRange where, std::string message,
             std::vector<Label> labels = {}) {
    errors_.error(code, where, std::move(message), std::move(labels));
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

  bool expect(TokenKind kind, std::string_view what) {
    cursor_.skip_line_ends();
    if (cursor_.accept(kind)) return true;
    error("RP042", cursor_.range(cursor_.peek()),
          "expected " + std::string(what) + " and found " + cursor_.shown());
    recover();
    return false;
  }

  // name [AT %..] {, name} : type [:= value] ;
  void variables() {
    std::vector<Name> list;
    do {
      cursor_.skip_line_ends();
      if (!cursor_.at(TokenKind::Word)) {
        expect(TokenKind::Word, "the name of a variable");
        return;
      }
      Name name{cursor_.take(), {}};
      if (cursor_.word() == "AT") {
        cursor_.take();
        if (!cursor_.at(TokenKind::Address)) {
          expect(TokenKind::Address, "an address such as %IX0.0");
          return;
        }
        name.address = cursor_.take();
      }
      list.push_back(name);
      cursor_.skip_line_ends();
    } while (cursor_.accept(TokenKind::Comma));
    if (!expect(TokenKind::Colon, "`:` and a type")) return;
    cursor_.skip_line_ends();
    if (!cursor_.at(TokenKind::Word)) {
      expect(TokenKind::Word, "a type");
      return;
    }
    const Token type = cursor_.take();
    declare(list, type);
  }

  void declare(const std::vector<Name>& list, const Token& type) {
    const std::string word = upper(cursor_.text(type));
    if (const Block* const block = find_block(word)) {
      if (!expect(TokenKind::Semicolon, "`;`")) return;
      for (const Name& name : list) instance(name, *block, type);
      return;
    }
    const std::optional<Kind> kind = kind_of(word);
    if (!kind) {
      std::vector<std::string_view> known = {"BOOL", "INT", "TIME"};
      for (const Block& block : blocks()) known.push_back(block.name);
      error("RP041", cursor_.range(type),
            "the type " + quoted_excerpt(cursor_.text(type)) +
                " is not supported" + did_you_mean(word, known) +
                ": types are BOOL, INT, TIME and the standard function blocks");
      return recover();
    }
    std::int64_t initial = 0;
    const bool given = cursor_.accept(TokenKind::Assign);
    if (given && !value(*kind, initial)) return;
    if (!expect(TokenKind::Semicolon, "`;`")) return;
    for (const Name& name : list) variable(name, *kind, given, initial);
  }

  static std::optional<Kind> kind_of(std::string_view word) {
    if (word == "BOOL") return Kind::Bool;
    if (word == "INT") return Kind::Int;
    if (word == "TIME") return Kind::Time;
    return std::nullopt;
  }

  bool value(Kind kind, std::int64_t& result) {
    const SourceRange where = cursor_.range(cursor_.peek());
    const bool negative = kind == Kind::Int && cursor_.accept(TokenKind::Minus);
    const Token token = cursor_.take();
    const std::string text = upper(cursor_.text(token));
    bool good = false;
    if (kind == Kind::Bool) {
      good = text == "TRUE" || text == "FALSE" || text == "0" || text == "1";
      result = text == "TRUE" || text == "1" ? 1 : 0;
    } else if (kind == Kind::Time) {
      const auto time =
          token.kind == TokenKind::Time ? milliseconds_of(text) : std::nullopt;
      good = time.has_value();
      result = time.value_or(0);
    } else if (token.kind == TokenKind::Number) {
      const auto [stop, problem] =
          std::from_chars(text.data(), text.data() + text.size(), result);
      good = problem == std::errc() && stop == text.data() + text.size() &&
             result <= (negative ? 32'768 : 32'767);
      if (negative) result = -result;
    }
    if (good) return true;
    error("RP043", where,
          "an initial value of type " + std::string(to_string(kind)) +
              " is expected: a literal of its range");
    recover();
    return false;
  }

  bool is_new(const Token& name, const std::string& key) {
    if (is_operator(key) || key == "TRUE" || key == "FALSE") {
      error("RP042", cursor_.range(name),
            quoted_excerpt(cursor_.text(name)) + " is a reserved word");
      return false;
    }
    if (!names_.is_known(key)) return true;
    error("RP042", cursor_.range(name),
          quoted_excerpt(cursor_.text(name)) + " is declared a second time",
          {{names_.place_of(key), "it is declared here"}});
    return false;
  }

  void instance(const Name& name, const Block& block, const Token& type) {
    const std::string key = upper(cursor_.text(name.token));
    if (!is_new(name.token, key)) return;
    if (role_ != Role::Memory || name.address.kind == TokenKind::Address ||
        constant_) {
      return error("RP041", cursor_.range(type),
                   "a function block is declared in VAR, without an address");
    }
    names_.add_instance(key, cursor_.text(name.token), block,
                        cursor_.range(name.token));
  }

  void variable(const Name& name, Kind kind, bool given, std::int64_t initial) {
    const std::string key = upper(cursor_.text(name.token));
    if (!is_new(name.token, key)) return;
    Role role = role_;
    if (name.address.kind == TokenKind::Address && !locate(name, kind, role)) {
      return;
    }
    Cell cell;
    cell.kind = kind;
    cell.constant = constant_;
    cell.initial = initial;
    cell.input = role == Role::Input;
    AstDeclaration declaration = declaration_of(
        cursor_.text(name.token), kind, role, cursor_.range(name.token));
    declaration.initial = initial;
    declaration.initialised = given;
    if (cell.input && given && initial != 0) {
      return error("RP043", cursor_.range(name.token),
                   "an input has no initial value: every scan samples it");
    }
    names_.add(key, cell, declaration);
    if (name.address.kind == TokenKind::Address) {
      names_.add_address(address_key(cursor_.text(name.address)), key);
    }
  }

  bool locate(const Name& name, Kind kind, Role& role) {
    const std::string_view text = cursor_.text(name.address);
    const SourceRange where = cursor_.range(name.address);
    const std::string address = address_key(text);
    const char size = kind == Kind::Bool ? 'X' : 'W';
    if (address.empty() || address[2] != size || kind == Kind::Time) {
      error("RP044", where,
            quoted_excerpt(text) + " is no address of a " +
                std::string(to_string(kind)) +
                ": %IX0.0 and the like for BOOL, %IW0 for INT");
      return false;
    }
    if (const std::string* const other = names_.at_address(address)) {
      error("RP044", where, quoted_excerpt(text) + " has a variable already",
            {{names_.place_of(*other), "it is declared here"}});
      return false;
    }
    if (names_.overlaps(address)) {
      error("RP044", where,
            "bits and words of one area may overlap: that is not supported");
      return false;
    }
    const Role by_area = address[1] == 'I'   ? Role::Input
                         : address[1] == 'Q' ? Role::Output
                                             : Role::Memory;
    if (role_ != Role::Memory && role_ != by_area) {
      error("RP044", where,
            quoted_excerpt(text) +
                " does not fit the block of variables it is in");
      return false;
    }
    role = by_area;
    return true;
  }

  Cursor& cursor_;
  Names& names_;
  ErrorLimit& errors_;
  Role role_ = Role::Memory;
  bool constant_ = false;
};

}  // namespace

bool read_declarations(Cursor& cursor, Names& names, ErrorLimit& errors) {
  Reader reader(cursor, names, errors);
  bool any = false;
  while (true) {
    cursor.skip_line_ends();
    const std::string word = cursor.word();
    if (word != "VAR" && !word.starts_with("VAR_")) return any;
    any = true;
    reader.section();
  }
}

}  // namespace rung::il_iec
