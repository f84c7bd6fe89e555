#include "frontend/encoding.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace rung {
namespace {

std::uint8_t byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

bool is_continuation(std::string_view text, std::size_t at) {
  return (byte_at(text, at) & 0xc0U) == 0x80U;
}

/// Length of the UTF-8 sequence at `at`; 0 when there is none. Overlong forms,
/// surrogates and code points above U+10FFFF are refused (RFC 3629).
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const std::uint8_t lead = byte_at(text, at);
  const std::uint8_t second = byte_at(text, at + 1);
  if (lead < 0x80) return 1;
  if (lead < 0xc2 || lead > 0xf4 || !is_continuation(text, at + 1)) return 0;
  if (lead < 0xe0) return 2;
  if (!is_continuation(text, at + 2)) return 0;
  if (lead < 0xf0) {
    if (lead == 0xe0 && second < 0xa0) return 0;
    if (lead == 0xed && second > 0x9f) return 0;
    return 3;
  }
  if (!is_continuation(text, at + 3)) return 0;
  if (lead == 0xf0 && second < 0x90) return 0;
  if (lead == 0xf4 && second > 0x8f) return 0;
  return 4;
}

bool is_control(char c) {
  const auto byte = static_cast<std::uint8_t>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f') ||
         byte == 0x7f;
}

std::string hexadecimal(std::uint8_t byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return {'0', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
}

Diagnostic not_text(FileId file, std::size_t at, std::string message) {
  const auto begin = static_cast<std::uint32_t>(at);
  return {.code = "RP001",
          .severity = Severity::Error,
          .where = {file, begin, begin + 1},
          .message = std::move(message),
          .labels = {}};
}

}  // namespace

std::optional<Diagnostic> check_text(const SourceSet& sources, FileId file) {
  const std::string_view text = sources[file].text();
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    return not_text(file, 0, "the file is UTF-16 text: save it as UTF-8");
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text, at);
    if (length == 0) {
      return not_text(file, at,
                      "the byte " + hexadecimal(byte_at(text, at)) +
                          " is not UTF-8: save the file as UTF-8");
    }
    if (length == 1 && is_control(text[at])) {
      return not_text(file, at,
                      "the byte " + hexadecimal(byte_at(text, at)) +
                          " is not text: is this a script?");
    }
    at += length;
  }
  return std::nullopt;
}

}  // namespace rung
