#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/script/token.h"

namespace rung::script {
namespace {

using enum TokenKind;

struct Symbol {
  std::string_view text;
  TokenKind kind;
};

// By first character, the longest first: the first that fits is the token.
constexpr std::array<Symbol, 55> kSymbols = {{
    {"===", StrictEqual}, {"==", Equal},
    {"=>", Unsupported},  {"=<", Unsupported},
    {"=", Assign},        {"!==", StrictNotEqual},
    {"!=", NotEqual},     {"!", Not},
    {"<<=", Unsupported}, {"<=", LessEqual},
    {"<<", Unsupported},  {"<>", Unsupported},
    {"<", Less},          {">>>=", Unsupported},
    {">>=", Unsupported}, {">>>", Unsupported},
    {">=", GreaterEqual}, {">>", Unsupported},
    {">", Greater},       {"&&=", Unsupported},
    {"&&", And},          {"&=", Unsupported},
    {"&", Unsupported},   {"||=", Unsupported},
    {"||", Or},           {"|=", Unsupported},
    {"|", Unsupported},   {"++", Increment},
    {"+=", PlusAssign},   {"+", Plus},
    {"--", Decrement},    {"-=", MinusAssign},
    {"-", Minus},         {"**=", Unsupported},
    {"**", Unsupported},  {"*=", StarAssign},
    {"*", Star},          {"/=", SlashAssign},
    {"/", Slash},         {"(", Open},
    {")", Close},         {"{", OpenBrace},
    {"}", CloseBrace},    {",", Comma},
    {";", Semicolon},     {"...", Unsupported},
    {".", Dot},           {"^=", Unsupported},
    {"^", Unsupported},   {"~", Unsupported},
    {"%=", Unsupported},  {"%", Unsupported},
    {"?", Unsupported},   {"[", Unsupported},
    {"]", Unsupported},
}};

/// Where the symbols that begin with a character stand in kSymbols.
constexpr std::array<std::uint8_t, 128> kFirstSymbol = [] {
  std::array<std::uint8_t, 128> first = {};
  first.fill(kSymbols.size());
  for (std::size_t i = kSymbols.size(); i-- > 0;) {
    first[static_cast<unsigned char>(kSymbols[i].text[0])] =
        static_cast<std::uint8_t>(i);
  }
  return first;
}();

struct Quote {
  std::string_view text;
  bool is_double;
};
// As typed, and as word processors and papers print them.
constexpr std::array<Quote, 6> kQuotes = {{{"\"", true},
                                           {"'", false},
                                           {"\u201c", true},
                                           {"\u201d", true},
                                           {"\u2018", false},
                                           {"\u2019", false}}};

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

const Quote* quote_at(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (is_ascii(c) && c != '"' && c != '\'') return nullptr;
  for (const Quote& quote : kQuotes) {
    if (text.substr(at).starts_with(quote.text)) return &quote;
  }
  return nullptr;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '$';
}
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_hex_digit(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Bytes of a space or line end at the begin of `text`. No-break spaces and
/// byte order marks come with text pasted from a page; Javascript takes them
/// as spaces too.
std::size_t blank_length(std::string_view text) {
  if (text.empty()) return 0;
  const char c = text[0];
  if (c == ' ' || c == '\t' || c == '\f' || is_line_end(c)) return 1;
  if (is_ascii(c)) return 0;
  if (text.starts_with("\u00a0")) return 2;
  return text.starts_with("\ufeff") ? 3 : 0;
}

std::size_t count_digits(std::string_view text) {
  const auto* end = std::find_if_not(text.begin(), text.end(), is_digit);
  return static_cast<std::size_t>(end - text.begin());
}

/// Is all of `text` a number as Javascript and C both read it? So no leading
/// zeros (octal there), no suffixes and no separators.
bool is_number(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) {
    text.remove_prefix(2);
    return !text.empty() && std::all_of(text.begin(), text.end(), is_hex_digit);
  }
  const std::size_t whole = count_digits(text);
  if (whole > 1 && text[0] == '0') return false;
  text.remove_prefix(whole);
  std::size_t fraction = 0;
  if (text.starts_with('.')) {
    fraction = count_digits(text.substr(1));
    text.remove_prefix(1 + fraction);
  }
  if (whole + fraction == 0) return false;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && count_digits(text) == text.size();
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\f\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return text.substr(text.size());
  return text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

/// A line comment as a section marker; End when it is none. After the word
/// may stand nothing, or a comma and text. Anything else that looks like a
/// marker is doubtful: were it taken for a comment, the plant would run as
/// rungs; were it taken for a marker, rungs would be lost from every proof.
TokenKind section_marker(std::string_view comment) {
  constexpr std::string_view kPunctuation = ",:;.-";
  const std::string_view text = trim(comment);
  const std::string_view word = text.substr(0, 3);
  const std::string_view rest = trim(text.substr(word.size()));
  const bool exact = rest.empty() || rest.starts_with(',');
  if (word == "Var" || word == "Sim") {
    const bool same_word = text.size() > 3 && is_word(text[3]);
    if (same_word) return End;
    if (!exact) return DoubtfulSection;
    return word == "Var" ? VarSection : SimSection;
  }
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (lower != "var" && lower != "sim") return End;
  const bool punctuated =
      rest.empty() || kPunctuation.find(rest[0]) != std::string_view::npos;
  return punctuated && (text.size() == 3 || !is_word(text[3])) ? DoubtfulSection
                                                               : End;
}

class Lexer {
 public:
  Lexer(const SourceSet& sources, FileId file) {
    out_.text = sources[file].text();
    out_.file = file;
    // Dense scripts have a token in three bytes; memory that stays untouched
    // costs nothing, and growing costs more than reading.
    out_.tokens.reserve(out_.text.size() / 3 + 1);
  }
  TokenList run();

 private:
  std::string_view rest() const { return out_.text.substr(at_); }
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {out_.file, static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(end)};
  }
  void add(TokenKind kind, std::size_t length);
  bool skip_blank();
  bool skip_comment();
  void line_comment();
  void block_comment();
  std::size_t line_length() const;
  bool string_literal();
  bool number();
  bool name();
  bool symbol();
  void unknown();

  TokenList out_;
  std::size_t at_ = 0;
  bool starts_line_ = true;
};

void Lexer::add(TokenKind kind, std::size_t length) {
  const SourceRange where = range(at_, at_ + length);
  out_.tokens.push_back({kind, starts_line_, where.begin, where.end});
  starts_line_ = false;
  at_ += length;
}

bool Lexer::skip_blank() {
  const std::size_t before = at_;
  while (const std::size_t length = blank_length(rest())) {
    starts_line_ = starts_line_ || is_line_end(out_.text[at_]);
    at_ += length;
  }
  return at_ != before;
}

std::size_t Lexer::line_length() const {
  const std::string_view text = rest();
  return std::min(text.find_first_of("\r\n"), text.size());
}

void Lexer::line_comment() {
  const std::size_t begin = at_;
  const std::size_t length = line_length();
  const std::string_view text = out_.text.substr(begin + 2, length - 2);
  if (text.starts_with('@')) {
    const std::string_view line = trim(text.substr(1));
    const auto offset =
        static_cast<std::size_t>(line.data() - out_.text.data());
    out_.annotations.push_back({line, range(offset, offset + line.size())});
    at_ += length;
    return;
  }
  const TokenKind marker = section_marker(text);
  if (marker != End) {
    add(marker, length);
    return;
  }
  out_.comments.push_back({text, range(begin, begin + length)});
  at_ += length;
}

void Lexer::block_comment() {
  const std::size_t begin = at_;
  const std::size_t close = out_.text.find("*/", begin + 2);
  const bool closed = close != std::string_view::npos;
  if (!closed) out_.open_comment = range(begin, begin + 2);
  const std::size_t end = closed ? close : out_.text.size();
  const std::string_view text = out_.text.substr(begin + 2, end - begin - 2);
  at_ = closed ? close + 2 : end;
  out_.comments.push_back({text, range(begin, at_)});
  if (text.find_first_of("\r\n") != std::string_view::npos) starts_line_ = true;
}

bool Lexer::skip_comment() {
  if (rest().starts_with("//")) {
    line_comment();
  } else if (rest().starts_with("/*")) {
    block_comment();
  } else {
    return false;
  }
  return true;
}

/// The token includes its quotes. A quote is closed by any of its family, for
/// word processors turn them round at will.
bool Lexer::string_literal() {
  const std::string_view text = rest();
  const Quote* const open = quote_at(text, 0);
  if (open == nullptr) return false;
  TokenKind kind = String;
  std::size_t at = open->text.size();
  for (; at < text.size() && !is_line_end(text[at]); ++at) {
    if (text[at] == '\\') kind = BadString;
    const Quote* const close = quote_at(text, at);
    if (close != nullptr && close->is_double == open->is_double) {
      add(kind, at + close->text.size());
      return true;
    }
  }
  add(BadString, at);
  return true;
}

/// Takes in all that sticks to the number: `5s` is one bad number and not a
/// number and a name.
bool Lexer::number() {
  const std::string_view text = rest();
  const bool begins = is_digit(text[0]) ||
                      (text[0] == '.' && text.size() > 1 && is_digit(text[1]));
  if (!begins) return false;
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  std::size_t end = 0;
  while (end < text.size()) {
    const char c = text[end];
    const char before = end == 0 ? ' ' : text[end - 1];
    const bool sign =
        (c == '+' || c == '-') && !hex && (before == 'e' || before == 'E');
    if (!is_word(c) && c != '.' && !sign) break;
    ++end;
  }
  add(is_number(text.substr(0, end)) ? Number : BadNumber, end);
  return true;
}

bool Lexer::name() {
  const std::string_view text = rest();
  if (!is_letter(text[0])) return false;
  const auto* end = std::find_if_not(text.begin(), text.end(), is_word);
  add(Name, static_cast<std::size_t>(end - text.begin()));
  return true;
}

bool Lexer::symbol() {
  const std::string_view text = rest();
  const auto first = static_cast<unsigned char>(text[0]);
  if (first >= kFirstSymbol.size()) return false;
  for (std::size_t i = kFirstSymbol[first];
       i < kSymbols.size() && kSymbols[i].text[0] == text[0]; ++i) {
    if (!text.starts_with(kSymbols[i].text)) continue;
    add(kSymbols[i].kind, kSymbols[i].text.size());
    return true;
  }
  return false;
}

/// One code point; neighbours join it, so that binary rubbish is one error.
void Lexer::unknown() {
  const bool joins = !out_.tokens.empty() && !starts_line_ &&
                     out_.tokens.back().kind == Unknown &&
                     out_.tokens.back().end == at_;
  std::size_t length = 1;
  while (at_ + length < out_.text.size() &&
         (static_cast<unsigned char>(out_.text[at_ + length]) & 0xc0U) ==
             0x80U) {
    ++length;
  }
  if (joins) {
    at_ += length;
    out_.tokens.back().end = static_cast<std::uint32_t>(at_);
  } else {
    add(Unknown, length);
  }
}

TokenList Lexer::run() {
  while (at_ < out_.text.size()) {
    if (skip_blank() || skip_comment() || name() || number() ||
        string_literal() || symbol()) {
      continue;
    }
    unknown();
  }
  starts_line_ = true;
  add(End, 0);
  return std::move(out_);
}

}  // namespace

TokenList tokenize(const SourceSet& sources, FileId file) {
  return Lexer(sources, file).run();
}

}  // namespace rung::script
