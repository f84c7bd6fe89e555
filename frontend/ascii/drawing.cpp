#include "frontend/ascii/drawing.h"

#include <algorithm>

#include "frontend/token_list.h"

namespace rung::ascii {
namespace {

constexpr std::string_view kBlanks = " \t\f\r\n";
// What wires and the symbols of elements are made of.
constexpr std::string_view kDrawn = "|+-[]()/<>=: ";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

}  // namespace

bool is_text(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '%';
}

Drawing::Drawing(std::string_view text, Ast& ast, ErrorLimit& errors)
    : source_(text), blanked_(text), file_(ast.file) {
  if (text.starts_with("\xef\xbb\xbf")) {
    std::fill_n(blanked_.begin(), 3, ' ');
  }
  blank_comments(text, ast, errors);
  split(errors);
}

SourceRange Drawing::at_bytes(std::size_t begin, std::size_t end) const {
  return {file_, static_cast<std::uint32_t>(begin),
          static_cast<std::uint32_t>(end)};
}

char Drawing::at(std::uint32_t row, std::uint32_t column) const {
  if (row >= lines_.size() || column >= lines_[row].length) return ' ';
  return blanked_[lines_[row].begin + column];
}

SourceRange Drawing::range(std::uint32_t row, std::uint32_t begin,
                           std::uint32_t end) const {
  const std::size_t from = lines_[row].begin;
  return at_bytes(from + begin,
                  from + std::min<std::size_t>(end, lines_[row].length));
}

std::string_view Drawing::text(std::uint32_t row, std::uint32_t begin,
                               std::uint32_t end) const {
  return source_.substr(lines_[row].begin + begin, end - begin);
}

std::size_t Drawing::first_text(std::uint32_t row, std::uint32_t column) const {
  const std::vector<Text>& texts = texts_[row];
  const auto at = std::lower_bound(
      texts.begin(), texts.end(), column,
      [](const Text& it, std::uint32_t value) { return it.end <= value; });
  return static_cast<std::size_t>(at - texts.begin());
}

void Drawing::blank(std::uint32_t row, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < std::min(end, columns(row)); ++i) {
    blanked_[lines_[row].begin + i] = ' ';
  }
  const std::size_t count = texts_[row].size();
  for (std::size_t i = first_text(row, begin);
       i < count && texts_[row][i].begin < end; ++i) {
    texts_[row][i].text = {};
    texts_[row][i].used = true;
  }
}

// --- comments and pragmas ----------------------------------------------------

void Drawing::blank_comments(std::string_view text, Ast& ast,
                             ErrorLimit& errors) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    if (text.substr(at, 2) == "(*") {
      end = comment(text, at, "*)", ast, errors);
    } else if (text.substr(at, 2) == "//") {
      end = comment(text, at, "\n", ast, errors);
    } else if (text[at] == '{') {
      end = pragma(text, at, errors);
    } else {
      ++at;
      continue;
    }
    for (; at < end; ++at) {
      if (blanked_[at] != '\n' && blanked_[at] != '\r') blanked_[at] = ' ';
    }
  }
}

// To behind its end.
std::size_t Drawing::comment(std::string_view text, std::size_t at,
                             std::string_view close, Ast& ast,
                             ErrorLimit& errors) {
  const std::size_t found = text.find(close, at + 2);
  if (found == text.npos && close != "\n") {
    errors.error("RP007", at_bytes(at, at + 2), "this comment is not closed");
  }
  const std::size_t stop = std::min(found, text.size());
  std::string_view inside = text.substr(at + 2, stop - at - 2);
  const bool is_line = inside.starts_with("@");
  inside = trimmed(inside.substr(is_line ? 1 : 0));
  const auto begin =
      inside.empty() ? at
                     : static_cast<std::size_t>(inside.data() - text.data());
  const SourceRange where = at_bytes(begin, begin + inside.size());
  const bool names_language = inside.starts_with("language") &&
                              (inside.size() == 8 || inside[8] == ' ');
  if (!is_line) {
    ast.comments.push_back({inside, where});
  } else if (!names_language) {
    ast.annotations.push_back({inside, where});
  }
  return std::min(stop + (close == "\n" ? 0 : close.size()), text.size());
}

// `\{` and `\}` are no brackets. What other tools are told is not for this one.
std::size_t Drawing::pragma(std::string_view text, std::size_t at,
                            ErrorLimit& errors) {
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != '}') {
    end += text[end] == '\\' ? 2U : 1U;
  }
  if (end >= text.size()) {
    errors.error("RP007", at_bytes(at, at + 1), "this pragma is not closed");
    return text.size();
  }
  const std::string_view inside = trimmed(text.substr(at + 1, end - at - 1));
  constexpr std::string_view kLanguage = "LANGUAGE ";
  if (inside.starts_with(kLanguage) &&
      trimmed(inside.substr(kLanguage.size())) != "BottomOperandContext") {
    errors.error("RP087", at_bytes(at, end + 1),
                 quoted_excerpt(inside) +
                     " is not supported: the pragma is `LANGUAGE "
                     "BottomOperandContext`");
  }
  return end + 1;
}

// --- rows --------------------------------------------------------------------

void Drawing::split(ErrorLimit& errors) {
  const std::string_view all = blanked_;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\n', at), all.size());
    std::size_t length = end - at;
    while (length > 0 && kBlanks.find(all[at + length - 1]) != kBlanks.npos) {
      --length;
    }
    lines_.push_back({at, length});
    at = end + 1;
  }
  texts_.resize(lines_.size());
  for (std::uint32_t row = 0; row < rows(); ++row) {
    if (!label(row)) find_texts(row, errors);
  }
}

// `name:` and nothing else
bool Drawing::label(std::uint32_t row) {
  const Line line = lines_[row];
  if (line.length < 2 || at(row, columns(row) - 1) != ':') return false;
  std::uint32_t begin = 0;
  while (at(row, begin) == ' ') ++begin;
  for (std::uint32_t i = begin; i + 1 < columns(row); ++i) {
    if (!is_text(at(row, i))) return false;
  }
  labels_.push_back({text(row, begin, columns(row) - 1), row});
  lines_[row].length = 0;
  return true;
}

// The `-` of a number, which a wire never touches.
bool Drawing::is_sign(std::uint32_t row, std::uint32_t column) const {
  const char next = at(row, column + 1);
  return at(row, column) == '-' && next >= '0' && next <= '9' &&
         (column == 0 || at(row, column - 1) == ' ');
}

// A row with wires has texts only in elements and behind `>>`: those are not
// operands, and who reads the wires finds them.
void Drawing::find_texts(std::uint32_t row, ErrorLimit& errors) {
  bool wires = false;
  for (std::uint32_t i = 0; i < columns(row); ++i) {
    const char c = at(row, i);
    wires = wires || c == '+' || (c == '-' && !is_sign(row, i));
    if (is_text(c) || kDrawn.find(c) != kDrawn.npos || c == '?') continue;
    return errors.error("RP051", range(row, i, i + 1),
                        "this character has no meaning in a drawing");
  }
  for (std::uint32_t i = 0; !wires && i < columns(row);) {
    if (!is_text(at(row, i)) && !is_sign(row, i)) {
      ++i;
      continue;
    }
    std::uint32_t end = i + 1;
    while (is_text(at(row, end))) ++end;
    texts_[row].push_back({text(row, i, end), i, end, false});
    i = end;
  }
}

}  // namespace rung::ascii
