#include "base/diagnostic.h"

#include <algorithm>
#include <tuple>

namespace rung {

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return "note";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      return "error";
  }
  return "";
}

void sort_diagnostics(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& left, const Diagnostic& right) {
                     return std::tie(left.where.file, left.where.begin,
                                     left.where.end, left.code, left.message) <
                            std::tie(right.where.file, right.where.begin,
                                     right.where.end, right.code,
                                     right.message);
                   });
}

}  // namespace rung
