#include "analysis/property_text.h"

#include <algorithm>

namespace rung {

bool is_word_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '$' || c == '%';
}

std::size_t find_word(std::string_view text, std::string_view word) {
  std::int64_t depth = 0;
  bool after_word = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const std::size_t end = i + word.size();
    const bool here = depth == 0 && i > 0 && !after_word &&
                      text.substr(i, word.size()) == word &&
                      (end == text.size() || !is_word_part(text[end]));
    if (here) return i;
    after_word = is_word_part(c);
  }
  return kNowhere;
}

std::size_t find_last_word(std::string_view text, std::string_view word) {
  std::size_t found = kNowhere;
  std::size_t from = 0;
  for (;;) {
    const std::size_t next = find_word(text.substr(from), word);
    if (next == kNowhere) return found;
    found = from + next;
    from = found + 1;
    while (from < text.size() && is_word_part(text[from])) ++from;
  }
}

std::vector<Slice> split(const Slice& slice, char separator) {
  std::vector<Slice> parts;
  std::int64_t depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < slice.text.size(); ++i) {
    const char c = slice.text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c != separator || depth != 0) continue;
    parts.push_back(slice.part(begin, i));
    begin = i + 1;
  }
  parts.push_back(slice.part(begin));
  return parts;
}

Slice Slice::part(std::size_t begin, std::size_t end) const {
  end = std::min(end, text.size());
  begin = std::min(begin, end);
  while (begin < end && is_space(text[begin])) ++begin;
  while (end > begin && is_space(text[end - 1])) --end;
  SourceRange range = where;
  range.begin += static_cast<std::uint32_t>(begin);
  range.end = where.begin + static_cast<std::uint32_t>(end);
  return {text.substr(begin, end - begin), range};
}

}  // namespace rung
