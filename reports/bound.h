#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/response.h"
#include "reports/report.h"
#include "reports/text.h"

namespace rung {

/// What `bound FILE "P -> Q"` shows.
struct BoundReport {
  const SourceSet* sources = nullptr;
  std::string_view version;
  std::vector<std::pair<std::string, std::string>> solvers;
  FileReport file;  // its program was read
  ResponseQuestion question;
  ResponseBounds bounds;
  double milliseconds = 0;
  bool self_check = true;
};

/// 4: a self-check failed. 1: Q need not come. 3: a time is not exact, or P can
/// never be true. 0: the longest and the shortest time are exact.
int exit_status(const BoundReport& report);

std::string write_text(const BoundReport& report, const TextOptions& options);

/// Schema rungproof.bound/1.
std::string write_json(const BoundReport& report);

}  // namespace rung
