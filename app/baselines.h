#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session.h"
#include "reports/baseline.h"
#include "reports/report.h"

namespace rung {

/// The baselines that the inputs of a session are compared with: by --baseline
/// or by the configuration of each. Each is read once.
class Baselines {
 public:
  /// One file, and what became of it.
  struct Used {
    std::string path;       // to open, and to show
    std::string directory;  // absolute: where its paths start
    Baseline baseline;
    bool exists = false;
    std::vector<std::size_t> inputs;
    std::vector<BaselineEntry> met;
  };

  /// Reads all. `may_miss`: one that is not there is empty.
  /// Errors: error(), of one that cannot be read or is none.
  Baselines(const Session& session, bool may_miss);

  const std::optional<std::string>& error() const { return error_; }
  std::vector<Used>& used() { return used_; }

  /// Waives what is known.
  void compare(Report& report);

  /// Also notes in the report what is stale.
  void apply(Report& report);

  /// Entries whose finding is gone: of files that were read, and of those that
  /// are not there any more. What a rule would say that is off is not known.
  std::vector<BaselineEntry> stale(const Used& used,
                                   const Report& report) const;

  /// The path of an input as the baseline has it.
  std::string path_in(const Used& used, std::size_t input) const;

 private:
  void read(Used& used, bool may_miss);

  const Session& session_;
  std::vector<Used> used_;
  std::optional<std::string> error_;
};

}  // namespace rung
