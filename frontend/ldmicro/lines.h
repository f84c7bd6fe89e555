#pragma once

#include <string_view>
#include <vector>

#include "frontend/ldmicro/program_text.h"

namespace rung::ldmicro {

/// The lines of a file, without blanks around them; empty ones are left out.
class Lines {
 public:
  Lines(std::string_view text, FileId file);

  bool at_end() const { return at_ == lines_.size(); }
  const Word& peek() const { return lines_[at_]; }
  const Word& take() { return lines_[at_++]; }
  /// Where the file ends.
  SourceRange end() const { return end_; }

 private:
  std::vector<Word> lines_;
  std::size_t at_ = 0;
  SourceRange end_;
};

/// The words of a line, blank-separated. `'a b'` is one, as `' '` is.
std::vector<Word> words_of(const Word& line);

/// A part of `line`, without blanks around it.
Word part_of(const Word& line, std::size_t begin, std::size_t end);

}  // namespace rung::ldmicro
