#include "frontend/ldmicro/lines.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>

namespace rung::ldmicro {
namespace {

constexpr std::string_view kBlanks = " \t\f\r";

}  // namespace

Word part_of(const Word& line, std::size_t begin, std::size_t end) {
  while (begin < end && kBlanks.find(line.text[begin]) != kBlanks.npos) {
    ++begin;
  }
  while (end > begin && kBlanks.find(line.text[end - 1]) != kBlanks.npos) {
    --end;
  }
  const auto from = line.where.begin + static_cast<std::uint32_t>(begin);
  return {
      line.text.substr(begin, end - begin),
      {line.where.file, from, from + static_cast<std::uint32_t>(end - begin)}};
}

Lines::Lines(std::string_view text, FileId file) {
  const auto size = static_cast<std::uint32_t>(text.size());
  const Word whole = {text, {file, 0, size}};
  end_ = {file, size, size};
  std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  while (at < text.size()) {
    const std::size_t end =
        std::min(text.find_first_of("\r\n", at), text.size());
    const Word line = part_of(whole, at, end);
    if (!line.text.empty()) lines_.push_back(line);
    at = end + 1;
  }
}

std::vector<Word> words_of(const Word& line) {
  std::vector<Word> words;
  const std::string_view text = line.text;
  for (std::size_t at = 0; at < text.size();) {
    if (kBlanks.find(text[at]) != kBlanks.npos) {
      ++at;
      continue;
    }
    const bool letter =
        text.substr(at).size() >= 3 && text[at] == '\'' && text[at + 2] == '\'';
    const std::size_t end =
        letter ? at + 3
               : std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(part_of(line, at, end));
    at = end;
  }
  return words;
}

std::optional<std::int64_t> number_of(std::string_view text) {
  if (text.size() == 3 && text.front() == '\'' && text.back() == '\'') {
    return static_cast<unsigned char>(text[1]);
  }
  const bool negative = text.starts_with("-");
  if (negative) text.remove_prefix(1);
  int base = 10;
  if (text.size() > 2 && text[0] == '0') {
    const char letter = text[1];
    if (letter == 'x' || letter == 'X') base = 16;
    if (letter == 'b' || letter == 'B') base = 2;
    if (letter == 'o' || letter == 'O') base = 8;
  }
  if (base != 10) text.remove_prefix(2);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value, base);
  if (text.starts_with("-") || problem != std::errc() || stop != end) {
    return std::nullopt;
  }
  return negative ? -value : value;
}

}  // namespace rung::ldmicro
