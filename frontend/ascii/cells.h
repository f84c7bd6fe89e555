#pragma once

#include <map>
#include <string_view>

#include "frontend/ascii/wires.h"
#include "frontend/statements.h"

namespace rung::ascii {

/// The cells of a drawing, which declares none: a name that no coil writes is
/// an input, one that a coil writes is an output; of an address its letter
/// says it. What comparisons look at is a word, all else a bit.
class Cells {
 public:
  Cells(const Wires& wires, StatementWriter& out, ErrorLimit& errors);

  /// An operand of a comparison: a name, or a number.
  Expression operand(std::string_view text, SourceRange where);

 private:
  struct Use {
    bool word = false;
    bool written = false;
    SourceRange where;
  };

  void survey(const Element& element);
  void mention(std::string_view name, SourceRange where, bool word,
               bool written);
  void check_areas();
  void fail(std::string_view code, std::string_view name, SourceRange where,
            std::string_view why);

  StatementWriter& out_;
  ErrorLimit& errors_;
  std::map<std::string_view, Use> uses_;
  std::vector<std::string_view> order_;  // by first mention
};

}  // namespace rung::ascii
