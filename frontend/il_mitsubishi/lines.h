#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/token_list.h"

namespace rung::melsec {

struct Word {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A line with an instruction, without its step number.
struct Line {
  static constexpr std::size_t kMost = 4;
  std::array<Word, kMost> words;  // the instruction, then its operands
  std::size_t count = 0;          // words on the line, also those not kept
};

/// The lines that are not empty, split into words. Comments begin with `;` or
/// `//` and go to the line's end; those that begin with `@` are property lines.
struct LineList {
  std::string_view text;
  FileId file;
  std::vector<Line> lines;
  std::vector<AstComment> comments;
  std::vector<AstAnnotation> annotations;

  std::string_view text_of(const Word& word) const {
    return text.substr(word.begin, word.end - word.begin);
  }
  SourceRange range_of(const Word& word) const {
    return {file, word.begin, word.end};
  }
};
LineList split_lines(std::string_view text, FileId file);

}  // namespace rung::melsec
