#include <algorithm>
#include <cstddef>

#include "frontend/il_iec/token.h"

namespace rung::il_iec {
namespace {

using enum TokenKind;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\f\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

class Lexer {
 public:
  Lexer(std::string_view text, FileId file) {
    list_.text = text;
    list_.file = file;
  }

  TokenList run() {
    if (list_.text.starts_with("\xef\xbb\xbf")) at_ = 3;
    while (at_ < list_.text.size()) step();
    add(LineEnd, 0);
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
      ++at_;
    } else if (is_line_end(c)) {
      add(LineEnd, 1);
    } else if (c == '(' && peek(1) == '*') {
      block_comment();
    } else if (c == '/' && peek(1) == '/') {
      line_comment();
    } else if (is_letter(c)) {
      word();
    } else if (is_digit(c)) {
      number();
    } else if (c == '%') {
      add(Address, run_of(1, [](char next) {
            return is_word(next) || next == '.' || next == '*';
          }));
    } else {
      symbol();
    }
  }

  void comment(std::size_t begin, std::size_t end) {
    std::string_view text = list_.text.substr(begin, end - begin);
    const bool is_line = text.starts_with("@");
    if (is_line) text = trimmed(text.substr(1));
    const auto from =
        static_cast<std::uint32_t>(text.data() - list_.text.data());
    const SourceRange where = {list_.file, from,
                               from + static_cast<std::uint32_t>(text.size())};
    if (is_line) {
      list_.annotations.push_back({text, where});
    } else {
      list_.comments.push_back({text, where});
    }
  }

  // It is a blank: an instruction may go on behind it.
  void block_comment() {
    const std::size_t close = list_.text.find("*)", at_ + 2);
    if (close == std::string_view::npos) {
      const auto begin = static_cast<std::uint32_t>(at_);
      list_.open_comment = {list_.file, begin, begin + 2};
      at_ = list_.text.size();
      return;
    }
    comment(at_ + 2, close);
    at_ = close + 2;
  }

  void line_comment() {
    const std::size_t end =
        std::min(list_.text.find_first_of("\r\n", at_), list_.text.size());
    comment(at_ + 2, end);
    at_ = end;
  }

  void word() {
    const std::size_t length = run_of(1, is_word);
    if (peek(length) != '#') return add(Word, length);
    const std::string prefix = upper(list_.text.substr(at_, length));
    const bool time = prefix == "T" || prefix == "TIME";
    add(time ? Time : Unknown, run_of(length + 1, [](char c) {
          return is_word(c) || c == '.' || c == '-';
        }));
  }

  void number() {
    const std::size_t length = run_of(1, is_word);
    const std::string_view text = list_.text.substr(at_, length);
    const bool plain = std::all_of(text.begin(), text.end(), is_digit);
    const bool goes_on = peek(length) == '#' ||
                         (peek(length) == '.' && is_digit(peek(length + 1)));
    if (plain && !goes_on) return add(Number, length);
    add(Unknown, run_of(length, [](char c) {
          return is_word(c) || c == '.' || c == '#';
        }));
  }

  void symbol() {
    switch (peek()) {
      case ':':
        return peek(1) == '=' ? add(Assign, 2) : add(Colon, 1);
      case '=':
        return peek(1) == '>' ? add(Arrow, 2) : add(Unknown, 1);
      case ',':
        return add(Comma, 1);
      case '.':
        return add(Dot, 1);
      case '(':
        return add(Open, 1);
      case ')':
        return add(Close, 1);
      case '-':
        return add(Minus, 1);
      case '&':
        return add(And, 1);
      case ';':
        return add(Semicolon, 1);
      default:
        break;
    }
    // A character of several bytes is one.
    add(Unknown, run_of(1, [](char c) {
          return (static_cast<unsigned char>(c) & 0xc0U) == 0x80;
        }));
  }

  TokenList list_;
  std::size_t at_ = 0;
};

}  // namespace

TokenList tokenize(std::string_view text, FileId file) {
  return Lexer(text, file).run();
}

std::string upper(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

}  // namespace rung::il_iec
