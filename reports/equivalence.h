#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/result.h"
#include "reports/report.h"
#include "reports/text.h"

namespace rung {

/// What `equiv A B` found.
struct EquivalenceReport {
  const SourceSet* sources = nullptr;
  std::string_view version;
  std::vector<std::pair<std::string, std::string>> solvers;
  std::string working_directory;
  bool self_check = true;
  FileReport a;  // findings: its input errors
  FileReport b;
  std::string_view verdict = "unknown";  // equivalent, different, bounded
  std::vector<std::string> outputs;      // compared, names of the first
  std::vector<std::pair<std::string, std::string>> map;
  std::string engine;
  std::uint32_t delay = 0;  // scans that the second lags behind
  bool settled = false;     // compared where nothing moves any more
  std::uint64_t scans = 0;  // of the trace
  double milliseconds = 0;
  std::string reason;
  std::vector<std::string> notes;  // what was not compared
  /// One change of the second that makes them the same, where there is one.
  std::string repair;  // "with this contact negated the programs are the same"
  SourceRange repair_where;
  std::optional<Certificate> certificate;
  std::optional<Trace> trace_a;
  std::optional<Trace> trace_b;
  std::vector<SelfCheckFailure> failures;
};

int exit_status(const EquivalenceReport& report);

std::string write_text(const EquivalenceReport& report,
                       const TextOptions& options);

/// Schema rungproof.equiv/1. A trace has the signals of both programs, as
/// a.NAME and b.NAME.
std::string write_json(const EquivalenceReport& report);
std::string write_jsonl(const EquivalenceReport& report);

/// The page of reports/html, with rungs of both programs.
std::string write_html(const EquivalenceReport& report);

/// The same as a report with one obligation, "equivalent", for the formats
/// that have no shape of their own for this.
Report as_report(const EquivalenceReport& report);

}  // namespace rung
