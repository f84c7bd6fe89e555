#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "reports/report.h"

namespace rung {

/// A finding that was there when a baseline was written.
struct BaselineEntry {
  std::string file;  // relative to the baseline's directory
  std::string code;
  std::string rule;         // its name then: for who reads the file
  std::string fingerprint;  // code, file, the line without blanks, a counter
  std::string message;      // for who reads the file

  /// What it is told by; rule and message may change with the program.
  std::tuple<const std::string&, const std::string&, const std::string&> key()
      const {
    return {file, code, fingerprint};
  }
};

/// Findings that are known and do not count. Sorted by key, each key once.
struct Baseline {
  std::vector<BaselineEntry> entries;

  const BaselineEntry* find(const BaselineEntry& like) const;
};

/// Sorts and drops what is there twice.
Baseline make_baseline(std::vector<BaselineEntry> entries);

/// The file `rungproof-baseline.json` (docs/schemas/baseline.json): a finding a
/// line, so that a review sees what a change adds.
std::string write_baseline(const Baseline& baseline);

/// The baseline in `text`, or what is wrong with it: another schema, another
/// type, a key that is missing or unknown.
std::variant<Baseline, std::string> read_baseline(std::string_view text);

/// What a baseline has to say about the findings of a file, whose path is
/// `path` seen from the baseline: an entry each, in the order of
/// all_findings(). Of input errors, which no baseline may hold, one without a
/// fingerprint.
std::vector<BaselineEntry> entries_of(const SourceSet& sources,
                                      const FileReport& file,
                                      const std::string& path);

/// Findings and waived ones, sorted.
std::vector<Diagnostic> all_findings(const FileReport& file);

/// Waives what `baseline` has and the source does not allow; the keys of the
/// entries that were met, whoever waived them, are added to `met`.
void compare_with(const Baseline& baseline, const SourceSet& sources,
                  const std::string& path, FileReport& file,
                  std::vector<BaselineEntry>& met);

}  // namespace rung
