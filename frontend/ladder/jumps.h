#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "frontend/statements.h"

namespace rung::ladder {

/// Jumps to places further down, as guards of what they lead over. Every jump
/// is a bit, which is looked at once: where it arrives.
class Jumps {
 public:
  explicit Jumps(StatementWriter& out) : out_(&out) {}

  /// Where `power` is true, what follows has no effect up to the label.
  void jump(std::string_view label, const Expression& power, SourceRange where);
  /// The label is reached. Where no jump is under way, the guard is again
  /// what it was before the first one.
  void arrive(std::string_view label, SourceRange where);

 private:
  StatementWriter* out_;
  std::string_view before_;  // the guard
  std::map<std::string_view, std::vector<std::string_view>> taken_;
};

}  // namespace rung::ladder
