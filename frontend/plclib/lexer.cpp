#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "frontend/plclib/token.h"

namespace rung::plclib {
namespace {

using enum TokenKind;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\f' || is_line_end(c);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\f\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// The longer ones first.
constexpr std::array<std::string_view, 22> kSymbols = {
    "<<=", ">>=", "...", "==", "!=", "<=", ">=", "&&", "||", "++", "--",
    "+=",  "-=",  "*=",  "/=", "%=", "&=", "|=", "^=", "<<", ">>", "::"};

class Lexer {
 public:
  Lexer(std::string_view text, FileId file) {
    list_.text = text;
    list_.file = file;
  }

  TokenList run() {
    if (list_.text.starts_with("\xef\xbb\xbf")) at_ = 3;
    while (at_ < list_.text.size()) step();
    add(End, 0);
    return std::move(list_);
  }

 private:
  char peek(std::size_t ahead = 0) const {
    const std::size_t at = at_ + ahead;
    return at < list_.text.size() ? list_.text[at] : '\0';
  }

  void add(TokenKind kind, std::size_t length) {
    list_.tokens.push_back({kind, static_cast<std::uint32_t>(at_),
                            static_cast<std::uint32_t>(at_ + length)});
    at_ += length;
    line_begins_ = false;
  }

  template <class Condition>
  std::size_t run_of(std::size_t from, Condition condition) const {
    std::size_t length = from;
    while (at_ + length < list_.text.size() &&
           condition(list_.text[at_ + length])) {
      ++length;
    }
    return length;
  }

  void step() {
    const char c = peek();
    if (is_blank(c)) {
      if (is_line_end(c)) line_begins_ = true;
      ++at_;
    } else if (c == '/' && peek(1) == '/') {
      line_comment();
    } else if (c == '/' && peek(1) == '*') {
      block_comment();
    } else if (c == '#' && line_begins_) {
      directive();
    } else if (is_letter(c)) {
      add(Word, run_of(1, is_word));
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      add(Number, run_of(1, [](char next) {
            return is_word(next) || next == '.' || next == '\'';
          }));
    } else if (c == '"' || c == '\'') {
      text(c);
    } else {
      symbol();
    }
  }

  void comment(std::size_t begin, std::size_t end) {
    const std::string_view content = list_.text.substr(begin, end - begin);
    const auto place = [&](std::string_view part) {
      const auto offset =
          static_cast<std::uint32_t>(part.data() - list_.text.data());
      return SourceRange{list_.file, offset,
                         offset + static_cast<std::uint32_t>(part.size())};
    };
    if (content.starts_with('@')) {
      const std::string_view line = trimmed(content.substr(1));
      if (!line.empty()) list_.annotations.push_back({line, place(line)});
    } else {
      list_.comments.push_back({content, place(content)});
    }
  }

  void line_comment() {
    const std::size_t end =
        std::min(list_.text.find_first_of("\r\n", at_), list_.text.size());
    comment(at_ + 2, end);
    at_ = end;
  }

  void block_comment() {
    const std::size_t close = list_.text.find("*/", at_ + 2);
    if (close == std::string_view::npos) {
      const auto begin = static_cast<std::uint32_t>(at_);
      list_.open_comment = {list_.file, begin, begin + 2};
      at_ = list_.text.size();
      return;
    }
    comment(at_ + 2, close);
    at_ = close + 2;
  }

  // To the end of the line or the comment in it.
  void directive() {
    std::size_t length = 1;
    while (at_ + length < list_.text.size() && !is_line_end(peek(length)) &&
           !(peek(length) == '/' &&
             (peek(length + 1) == '/' || peek(length + 1) == '*'))) {
      ++length;
    }
    while (is_blank(peek(length - 1))) --length;
    add(Directive, length);
  }

  // A backslash takes the character behind it; a text ends in its line.
  void text(char quote) {
    std::size_t length = 1;
    while (at_ + length < list_.text.size() && !is_line_end(peek(length))) {
      if (peek(length) == quote) return add(Text, length + 1);
      const bool escaped =
          peek(length) == '\\' && !is_line_end(peek(length + 1));
      length += escaped ? 2 : 1;
    }
    add(Unknown, std::min(length, list_.text.size() - at_));
  }

  void symbol() {
    const std::string_view rest = list_.text.substr(at_);
    for (const std::string_view known : kSymbols) {
      if (rest.starts_with(known)) return add(Symbol, known.size());
    }
    constexpr std::string_view kSingles = "+-*/%&|^~!<>=?:;,.(){}[]";
    if (kSingles.find(peek()) != std::string_view::npos) return add(Symbol, 1);
    // A character of several bytes is one.
    add(Unknown, run_of(1, [](char c) {
          return (static_cast<unsigned char>(c) & 0xc0U) == 0x80;
        }));
  }

  TokenList list_;
  std::size_t at_ = 0;
  bool line_begins_ = true;
};

}  // namespace

TokenList tokenize(std::string_view text, FileId file) {
  return Lexer(text, file).run();
}

}  // namespace rung::plclib
