#include <fmt/format.h>

#include "app/lsp/features.h"
#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/report.h"

namespace rung::lsp {
namespace {

constexpr int kUnnecessary = 1;  // DiagnosticTag

int severity_number(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return 1;
    case Severity::Warning:
      return 2;
    case Severity::Note:
      break;
  }
  return 3;
}

/// Rules that find what has no effect: editors draw that faded.
constexpr std::string_view kFaded[] = {
    "overwritten-value", "redundant-branch", "redundant-contact",
    "self-assignment",   "unused-allow",     "written-never-read"};

bool is_faded(std::string_view rule) {
  for (const std::string_view name : kFaded) {
    if (name == rule) return true;
  }
  return false;
}

Json to_json(const View& view, const Diagnostic& finding) {
  std::string message = finding.message;
  if (!finding.help.empty()) message += "\n" + finding.help;
  Json json = {{"range", range_of(view, finding.where)},
               {"severity", severity_number(finding.severity)},
               {"code", finding.code},
               {"source", "rungproof"},
               {"message", std::move(message)}};
  if (!finding.rule.empty()) {
    json["data"] = {{"rule", finding.rule}};
    if (is_faded(finding.rule)) json["tags"] = Json::array({kUnnecessary});
  }
  for (const Label& label : finding.labels) {
    json["relatedInformation"].push_back(
        {{"location", location_of(view, label.where)},
         {"message", label.text}});
  }
  return json;
}

Json violation(const View& view, const ObligationResult& result) {
  const Cones cones(*view.snapshot.program());
  return {{"range", range_of(view, result.obligation.where)},
          {"severity", severity_number(Severity::Error)},
          {"code", "property-violated"},
          {"source", "rungproof"},
          {"message",
           fmt::format("{} is violated: {}", result.obligation.name,
                       explain(view.snapshot.loaded.report, result, cones))}};
}

}  // namespace

Json diagnostics_of(const View& view) {
  Json all = Json::array();
  for (const Diagnostic& error : view.snapshot.loaded.report.findings) {
    all.push_back(to_json(view, error));
  }
  if (view.snapshot.program() == nullptr) return all;
  for (const Diagnostic& finding : view.findings) {
    all.push_back(to_json(view, finding));
  }
  for (const ObligationResult& result : view.results) {
    if (result.verdict == Verdict::Violated) {
      all.push_back(violation(view, result));
    }
  }
  return all;
}

}  // namespace rung::lsp
