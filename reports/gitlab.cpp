#include "reports/gitlab.h"

#include <optional>

#include "reports/baseline.h"
#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/fingerprint.h"
#include "reports/json_parts.h"
#include "reports/locate.h"
#include "reports/paths.h"
#include "reports/sarif_rules.h"
#include "reports/unicode.h"

namespace rung {
namespace {

std::string_view severity_of(const Diagnostic& finding) {
  if (is_input_error(finding)) return "blocker";
  switch (finding.severity) {
    case Severity::Note:
      return "info";
    case Severity::Warning:
      return "minor";
    case Severity::Error:
      return "major";
  }
  return "major";
}

class GitlabWriter {
 public:
  explicit GitlabWriter(const Report& report)
      : report_(report), locator_(*report.sources) {}

  Json write() {
    for (const FileReport& file : report_.files) add_file(file);
    return std::move(issues_);
  }

 private:
  void add_file(const FileReport& file) {
    for (const Diagnostic& finding : all_findings(file)) {
      Json issue = start(file, finding.where, finding.code, finding.message,
                         severity_of(finding));
      if (!finding.waiver) issues_.push_back(std::move(issue));
    }
    std::optional<Cones> cones;
    for (const ObligationResult& result : file.results) {
      if (result.verdict == Verdict::Proved) continue;
      if (!cones && file.program) cones.emplace(*file.program);
      const std::string said =
          cones ? explain(file, result, *cones) : verdict_phrase(result);
      issues_.push_back(
          start(file, result.obligation.where, verdict_rule_id(result.verdict),
                result.obligation.name + ": " + said,
                result.verdict == Verdict::Violated ? "critical" : "major"));
    }
    for (const SelfCheckFailure& failure : file.failures) {
      issues_.push_back(start(file, {}, "self-check",
                              failure.obligation + ": " + failure.what,
                              "blocker"));
    }
  }

  Json start(const FileReport& file, const SourceRange& where,
             std::string_view rule, std::string_view description,
             std::string_view severity) {
    const std::string& whole =
        where.has_value() ? (*report_.sources)[where.file].path() : file.path;
    const std::string path = relative_path(whole, report_.working_directory);
    const Place at = where.has_value() ? locator_.of(where) : Place{};
    std::string_view line;
    if (where.has_value()) {
      line = (*report_.sources)[where.file].line(at.begin.line);
    }
    return {{"description", valid_utf8(description)},
            {"check_name", rule},
            {"fingerprint", fingerprints_.next(rule, path, line)},
            {"severity", severity},
            {"location",
             {{"path", valid_utf8(path)},
              {"lines", {{"begin", at.begin.line}, {"end", at.end.line}}}}}};
  }

  const Report& report_;
  Locator locator_;
  Fingerprints fingerprints_;
  Json issues_ = Json::array();
};

}  // namespace

std::string write_gitlab(const Report& report) {
  return dump(GitlabWriter(report).write());
}

}  // namespace rung
