#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

namespace rung {

/// Names for findings that survive when lines are moved or re-indented.
class Fingerprints {
 public:
  /// "e1c2d3...:1": a hash of rule, path and `line` without white space, and
  /// which of the equal ones it is, from 1.
  std::string next(std::string_view rule, std::string_view path,
                   std::string_view line);

 private:
  std::unordered_map<std::string, int> seen_;
};

}  // namespace rung
