#include "frontend/postfix/lines.h"

#include <charconv>

#include "base/postfix_format.h"

namespace rung::postfix {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Token token_at(std::string_view text, std::size_t begin, std::size_t end) {
  return {.text = text.substr(begin, end - begin),
          .begin = static_cast<std::uint32_t>(begin),
          .end = static_cast<std::uint32_t>(end)};
}

}  // namespace

bool LineReader::next(Line& line) {
  line.tokens.clear();
  line.comment.reset();
  line.open_quote.reset();
  line.is_note = false;
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  while (at_ < end) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (text_.substr(at_, 2) == "//") {
      read_comment(end, line);
      at_ = end;
    } else {
      at_ = read_token(end, line);
    }
  }
  at_ = end + 1;
  return true;
}

void LineReader::read_comment(std::size_t end, Line& line) {
  std::size_t begin = at_ + 2;
  line.is_note = begin < end && text_[begin] == '@';
  if (line.is_note) ++begin;
  while (begin < end && is_blank(text_[begin])) ++begin;
  while (end > begin && is_blank(text_[end - 1])) --end;
  line.comment = token_at(text_, begin, end);
}

// Returns where the token ends.
std::size_t LineReader::read_token(std::size_t end, Line& line) {
  const std::size_t begin = at_;
  const bool target = text_[begin] == '=' && begin + 1 < end &&
                      text_[begin + 1] != '=' && !is_blank(text_[begin + 1]);
  const std::size_t name = begin + (target ? 1 : 0);
  std::size_t stop = name;
  const bool quoted = text_[name] == '"';
  if (quoted) {
    stop = text_.find('"', name + 1);
    if (stop >= end) {
      line.open_quote = token_at(text_, begin, end);
      return end;
    }
    ++stop;
  } else {
    while (stop < end && !is_blank(text_[stop])) ++stop;
  }
  Token token = token_at(text_, begin, stop);
  token.text = quoted ? text_.substr(name + 1, stop - name - 2)
                      : text_.substr(name, stop - name);
  token.quoted = quoted;
  token.target = target;
  line.tokens.push_back(token);
  return stop;
}

std::optional<std::int64_t> read_integer(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end || error != std::errc() || value < kWordMin ||
      value > kWordMax) {
    return std::nullopt;
  }
  return value;
}

std::string shown(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text = "`";
  for (const char c : token.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  if (token.size() > kLongest) text += "...";
  return text + '`';
}

}  // namespace rung::postfix
