#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ast.h"
#include "frontend/error_limit.h"

namespace rung::ascii {

/// Where a character stands: a line of the file and a column, from 0.
struct Place {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// A name or a number in the drawing.
struct Text {
  std::string_view text;
  std::uint32_t begin = 0;  // columns
  std::uint32_t end = 0;
  bool used = false;  // an element has it as an operand
};

struct Label {
  std::string_view name;
  std::uint32_t row = 0;  // what stands below it is labelled
};

/// A file as lines of characters: comments and pragmas are blanks in them.
class Drawing {
 public:
  /// Comments, and property lines among them, go into `ast`. Errors: RP007,
  /// RP087, RP051.
  Drawing(std::string_view text, Ast& ast, ErrorLimit& errors);

  std::uint32_t rows() const {
    return static_cast<std::uint32_t>(lines_.size());
  }
  std::uint32_t columns(std::uint32_t row) const {
    return static_cast<std::uint32_t>(lines_[row].length);
  }
  /// A blank outside of the drawing.
  char at(std::uint32_t row, std::uint32_t column) const;
  SourceRange range(std::uint32_t row, std::uint32_t begin,
                    std::uint32_t end) const;
  std::string_view text(std::uint32_t row, std::uint32_t begin,
                        std::uint32_t end) const;

  /// Takes characters, and the texts there, out of the drawing.
  void blank(std::uint32_t row, std::uint32_t begin, std::uint32_t end);

  /// The texts of a row, from left to right; those that were taken out are
  /// empty.
  std::vector<Text>& texts(std::uint32_t row) { return texts_[row]; }
  /// The first one that ends behind the column.
  std::size_t first_text(std::uint32_t row, std::uint32_t column) const;
  const std::vector<Label>& labels() const { return labels_; }

 private:
  struct Line {
    std::size_t begin = 0;
    std::size_t length = 0;
  };

  void blank_comments(std::string_view text, Ast& ast, ErrorLimit& errors);
  std::size_t comment(std::string_view text, std::size_t at,
                      std::string_view close, Ast& ast, ErrorLimit& errors);
  std::size_t pragma(std::string_view text, std::size_t at, ErrorLimit& errors);
  void split(ErrorLimit& errors);
  bool label(std::uint32_t row);
  bool is_sign(std::uint32_t row, std::uint32_t column) const;
  void find_texts(std::uint32_t row, ErrorLimit& errors);
  SourceRange at_bytes(std::size_t begin, std::size_t end) const;

  std::string_view source_;
  std::string blanked_;  // as long as the file
  FileId file_;
  std::vector<Line> lines_;
  std::vector<std::vector<Text>> texts_;  // by row
  std::vector<Label> labels_;
};

/// Letters, digits, `_`, `.` and `%`: what names and numbers are made of.
bool is_text(char c);

}  // namespace rung::ascii
