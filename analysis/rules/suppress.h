#pragma once

#include <string_view>
#include <vector>

#include "analysis/rule.h"

namespace rung {

/// One `//@ allow NAME_OR_CODE, ...: reason` line.
struct Allow {
  std::vector<std::string_view> rules;
  std::string_view reason;
  SourceRange where;
};

/// Is the annotation (its text without `//@`) a suppression?
bool is_allow(std::string_view annotation);
Allow parse_allow(const AstAnnotation& annotation);

/// Gives a waiver to the findings that an `allow` line with a reason covers:
/// those on its line and, where it has a line of its own, on the next line
/// and in the next rung. Adds a
/// finding for every line that covers none, if the rules that it names are on.
std::vector<Diagnostic> suppress(const RuleContext& context,
                                 std::vector<Diagnostic> findings);

}  // namespace rung
