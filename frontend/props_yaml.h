#pragma once

#include <string>
#include <string_view>

namespace rung {

/// Property lines made of a file of ESBMC-PLC's properties.
struct YamlProperties {
  /// As many lines as the file has: each property stands on the line of its
  /// `expression`, so errors in it have their line.
  std::string lines;
  std::string error;  // with its line; empty: none
};

/// Does a text look like one: a key `properties` first?
bool is_properties_yaml(std::string_view text);

/// Reads the shape that those files have: `properties:`, then entries that
/// begin with `- id:` and have a `kind` and an `expression` or `variables`, one
/// key a line. `invariant` is `always`, `absence` `never`, `reachability`
/// `reach`, and `mutual_exclusion` an `interlock`: no two of the variables.
/// Errors: anything else, `response` among it. Linear.
YamlProperties read_properties_yaml(std::string_view text);

}  // namespace rung
