#include <algorithm>
#include <cstddef>

#include "frontend/iec/token.h"

namespace rung::iec {
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

struct Symbol {
  std::string_view text;
  TokenKind kind;
};
// Longer ones first.
constexpr Symbol kSymbols[] = {
    {":=", Assign},    {"=>", Arrow},        {"**", Power},  {"<>", NotEqual},
    {"<=", LessEqual}, {">=", GreaterEqual}, {"..", Range},  {":", Colon},
    {",", Comma},      {".", Dot},           {"(", Open},    {")", Close},
    {"+", Plus},       {"-", Minus},         {"*", Times},   {"/", Divide},
    {"=", Equal},      {"<", Less},          {">", Greater}, {"&", And},
    {";", Semicolon},
};

class Lexer {
 public:
  Lexer(std::string_view text, FileId file, std::size_t begin, std::size_t end)
      : at_(begin), end_(std::min(end, text.size())) {
    list_.text = text;
    list_.file = file;
  }

  TokenList run() {
    if (at_ == 0 && list_.text.starts_with("\xef\xbb\xbf")) at_ = 3;
    while (at_ < end_) step();
    add(LineEnd, 0);
    add(End, 0);
    return std::move(list_);
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < end_ ? list_.text[at_ + ahead] : '\0';
  }

  void add(TokenKind kind, std::size_t length) {
    list_.tokens.push_back({kind, static_cast<std::uint32_t>(at_),
                            static_cast<std::uint32_t>(at_ + length)});
    at_ += length;
  }

  template <class Condition>
  std::size_t run_of(std::size_t from, Condition condition) const {
    std::size_t length = from;
    while (at_ + length < end_ && condition(list_.text[at_ + length])) {
      ++length;
    }
    return length;
  }

  /// Where `text` stands from here on, but not behind the end.
  std::size_t find(std::string_view text, std::size_t from) const {
    const std::size_t found =
        list_.text.substr(0, end_).find(text, std::min(from, end_));
    return found;
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
    } else if (c == '\'' || c == '"') {
      string(c);
    } else if (c == '{') {
      pragma();
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
    const std::size_t close = find("*)", at_ + 2);
    if (close == std::string_view::npos) return unclosed();
    comment(at_ + 2, close);
    at_ = close + 2;
  }

  void unclosed() {
    const auto begin = static_cast<std::uint32_t>(at_);
    list_.open_comment = {list_.file, begin, begin + 1};
    at_ = end_;
  }

  void line_comment() {
    const std::size_t end =
        std::min(list_.text.find_first_of("\r\n", at_), end_);
    comment(at_ + 2, end);
    at_ = end;
  }

  void word() {
    const std::size_t length = run_of(1, is_word);
    if (peek(length) != '#') return add(Word, length);
    const std::string prefix = upper(list_.text.substr(at_, length));
    if (prefix == "T" || prefix == "TIME") {
      return add(Time, run_of(length + 1, [](char c) {
                   return is_word(c) || c == '.' || c == '-';
                 }));
    }
    // INT#5, INT#16#FF, BOOL#TRUE; a literal of a type that is not supported
    // is refused where it stands.
    std::size_t end = run_of(length + 1, [](char c) {
      return is_word(c) || c == '#' || c == '-' || c == '+';
    });
    const bool real = peek(end) == '.' && is_digit(peek(end + 1));
    if (real) end = run_of(end + 1, is_word);
    add(real ? Real : Number, end);
  }

  void number() {
    std::size_t length = run_of(1, is_word);
    if (peek(length) == '#') {
      return add(Number, run_of(length + 1, is_word));
    }
    if (peek(length) != '.' || !is_digit(peek(length + 1))) {
      return add(Number, length);
    }
    length = run_of(length + 1, is_word);
    const char last = peek(length - 1);
    const bool exponent = last == 'e' || last == 'E';
    if (exponent && (peek(length) == '-' || peek(length) == '+')) {
      length = run_of(length + 1, is_digit);
    }
    add(Real, length);
  }

  // One line at the most: what is not closed there is a character of its own.
  void string(char quote) {
    std::size_t length = 1;
    while (at_ + length < end_ && peek(length) != quote &&
           !is_line_end(peek(length))) {
      length += peek(length) == '$' && !is_line_end(peek(length + 1)) ? 2 : 1;
    }
    if (peek(length) != quote) return add(Unknown, 1);
    add(String, length + 1);
  }

  // `{{` is closed by `}}`.
  void pragma() {
    const bool twice = peek(1) == '{';
    const std::string_view mark = twice ? "}}" : "}";
    const std::size_t close = find(mark, at_ + 1);
    if (close == std::string_view::npos) return unclosed();
    add(Pragma, close + mark.size() - at_);
  }

  void symbol() {
    const std::string_view rest = list_.text.substr(at_, end_ - at_);
    for (const Symbol& it : kSymbols) {
      if (rest.starts_with(it.text)) return add(it.kind, it.text.size());
    }
    // A character of several bytes is one.
    add(Unknown, run_of(1, [](char c) {
          return (static_cast<unsigned char>(c) & 0xc0U) == 0x80;
        }));
  }

  TokenList list_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
};

}  // namespace

TokenList tokenize(std::string_view text, FileId file, std::size_t begin,
                   std::size_t end) {
  return Lexer(text, file, begin, end).run();
}

std::string upper(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

}  // namespace rung::iec
