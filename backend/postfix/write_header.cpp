#include <fmt/format.h>

#include <cctype>
#include <iterator>

#include "backend/postfix/lower.h"

namespace rung {
namespace {

constexpr std::size_t kBytesALine = 12;

/// With a suffix behind it, no word of C++.
std::string identifier(std::string_view name) {
  std::string made;
  for (const char byte : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(byte)) != 0 &&
                       static_cast<unsigned char>(byte) < 0x80;
    made += plain ? byte : '_';
  }
  if (made.empty() || std::isdigit(static_cast<unsigned char>(made[0])) != 0) {
    made.insert(0, "p");
  }
  return made;
}

std::string array_lines(std::string_view bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    text += at % kBytesALine == 0 ? "\n    " : " ";
    fmt::format_to(std::back_inserter(text), "0x{:02x},",
                   static_cast<unsigned char>(bytes[at]));
  }
  return text;
}

}  // namespace

std::string postfix_header(std::string_view bytes, std::uint32_t memory_words,
                           std::string_view name) {
  const std::string prefix = identifier(name);
  return fmt::format(
      "// Made by `rungproof lower --to postfix --header`: not to be edited.\n"
      "#pragma once\n"
      "\n"
      "#include <Rungproof.h>\n"
      "\n"
      "/// The memory that it needs, in uint32_t.\n"
      "const size_t {0}_words = {1};\n"
      "\n"
      "const uint8_t {0}_program[{2}] RUNGPROOF_FLASH = {{{3}\n"
      "}};\n",
      prefix, memory_words, bytes.size(), array_lines(bytes));
}

}  // namespace rung
