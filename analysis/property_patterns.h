#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "analysis/property.h"

namespace rung {

/// A requirement pattern of PLCverif in our forms: `%1` is its first parameter.
struct PropertyPattern {
  std::string_view id;
  Property::Form form;
  std::size_t arity;
  std::string_view first;
  std::string_view second;
};
inline constexpr std::array<PropertyPattern, 11> kPropertyPatterns = {{
    {"pattern-implication", Property::Form::Always, 2, "(%1) -> (%2)", {}},
    {"pattern-invariant", Property::Form::Always, 1, "%1", {}},
    {"pattern-forbidden", Property::Form::Never, 1, "%1", {}},
    {"pattern-statechange-duringcycle",
     Property::Form::Always,
     2,
     "begin(%1) -> (%2)",
     {}},
    {"pattern-statechange-betweencycles",
     Property::Form::Always,
     3,
     "prev(%1) && (%2) -> (%3)",
     {}},
    {"pattern-reachability", Property::Form::Reach, 1, "%1", {}},
    {"pattern-repeatability", Property::Form::Recoverable, 1, "%1", {}},
    {"pattern-leadsto", Property::Form::OnlyAfter, 2, "%1", "%2"},
    {"pattern-leadsto-trigger", Property::Form::OnlyAfter, 3, "%1",
     "prev(%2) && (%3)"},
    {"pattern-leadsto-earlier", Property::Form::OnlyAfter, 2, "%1",
     "begin(%2)"},
    {"pattern-timed-trigger", Property::Form::For, 3, "%1", "%3"},
}};

}  // namespace rung
