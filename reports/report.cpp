#include "reports/report.h"

#include <algorithm>

namespace rung {
namespace {

void count(const ObligationResult& result, Summary& summary) {
  ++summary.obligations;
  switch (result.verdict) {
    case Verdict::Proved:
      ++summary.proved;
      return;
    case Verdict::Violated:
      ++summary.violated;
      return;
    case Verdict::Bounded:
      ++summary.bounded;
      return;
    case Verdict::Vacuous:
      ++summary.vacuous;
      return;
    case Verdict::Unknown:
      ++summary.unknown;
      return;
  }
}

void count(const Diagnostic& finding, Severity fail_on, Summary& summary) {
  ++summary.findings;
  if (is_input_error(finding)) {
    ++summary.input_errors;
    return;
  }
  if (finding.severity >= fail_on) ++summary.failing;
  switch (finding.severity) {
    case Severity::Note:
      ++summary.notes;
      return;
    case Severity::Warning:
      ++summary.warnings;
      return;
    case Severity::Error:
      ++summary.errors;
      return;
  }
}

void count(const FileReport& file, Severity fail_on, Summary& summary) {
  ++summary.files;
  if (file.program) {
    ++summary.read;
    summary.rungs += file.program->rungs.size();
  }
  for (const ObligationResult& result : file.results) count(result, summary);
  for (const Diagnostic& finding : file.findings) {
    count(finding, fail_on, summary);
  }
  for (const Diagnostic& finding : file.waived) {
    const bool in_source = finding.waiver->kind == Waiver::Kind::InSource;
    ++(in_source ? summary.allowed : summary.baselined);
  }
  summary.failures += file.failures.size();
  for (const BoardReplay& replay : file.replays) {
    if (!replay.reason.empty()) ++summary.not_replayed;
  }
}

}  // namespace

Summary summarise(const Report& report) {
  Summary summary;
  for (const FileReport& file : report.files) {
    count(file, fail_on_of(report, file), summary);
  }
  return summary;
}

Summary summarise(const FileReport& file, Severity fail_on) {
  Summary summary;
  count(file, fail_on, summary);
  return summary;
}

Severity fail_on_of(const Report& report, const FileReport& file) {
  return file.fail_on.value_or(report.fail_on);
}

void take_findings(std::vector<Diagnostic> found, FileReport& file) {
  for (Diagnostic& finding : found) {
    (finding.waiver ? file.waived : file.findings)
        .push_back(std::move(finding));
  }
  sort_diagnostics(file.findings);
}

bool is_input_error(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::Error &&
         diagnostic.code.starts_with("RP0");
}

int exit_status(const Report& report) {
  const Summary summary = summarise(report);
  if (summary.failures > 0) return 4;
  if (summary.input_errors > 0 || summary.not_replayed > 0) return 2;
  if (summary.violated > 0 || summary.failing > 0) return 1;
  return summary.bounded + summary.vacuous + summary.unknown > 0 ? 3 : 0;
}

const BoardReplay* replay_of(const FileReport& file,
                             const Obligation& obligation) {
  const auto found = std::find_if(file.replays.begin(), file.replays.end(),
                                  [&](const BoardReplay& replay) {
                                    return replay.obligation == obligation.name;
                                  });
  return found == file.replays.end() ? nullptr : &*found;
}

std::string_view rule_name(const Diagnostic& diagnostic) {
  return diagnostic.rule.empty() ? std::string_view("input") : diagnostic.rule;
}

}  // namespace rung
