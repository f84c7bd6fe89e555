#include "reports/sarif.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "reports/baseline.h"
#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/fingerprint.h"
#include "reports/json_parts.h"
#include "reports/locate.h"
#include "reports/paths.h"
#include "reports/sarif_rules.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

std::string_view level_of(Severity severity) { return to_string(severity); }

/// What is not proved asks for attention; only a violation is an error.
std::string_view level_of(Verdict verdict) {
  return verdict == Verdict::Violated ? "error" : "warning";
}

Json message(std::string_view text) { return {{"text", text}}; }

class SarifWriter {
 public:
  explicit SarifWriter(const Report& report)
      : report_(report), locator_(*report.sources), rules_(report) {}

  Json run() {
    for (const FileReport& file : report_.files) add_file(file);
    Json driver = {{"name", "rungproof"},
                   {"version", report_.version},
                   {"semanticVersion", report_.version},
                   {"rules", rules_.take()}};
    return {{"tool", {{"driver", std::move(driver)}}},
            {"automationDetails",
             {{"id", fmt::format("rungproof/{}/", report_.command)}}},
            {"columnKind", "unicodeCodePoints"},
            {"invocations", Json::array({invocation()})},
            {"results", std::move(results_)}};
  }

 private:
  void add_file(const FileReport& file) {
    // In the order of the source, so that a waiver changes no fingerprint.
    for (const Diagnostic& finding : all_findings(file)) {
      add_finding(file, finding);
    }
    std::optional<Cones> cones;
    for (const ObligationResult& result : file.results) {
      if (result.verdict == Verdict::Proved) continue;
      if (!cones && file.program) cones.emplace(*file.program);
      add_result(file, result, cones);
    }
    for (const SelfCheckFailure& failure : file.failures) {
      notify("error", failure.obligation + ": " + failure.what, &file);
    }
    for (const std::string& note : file.notes) notify("note", note, &file);
  }

  void add_finding(const FileReport& file, const Diagnostic& finding) {
    Json result =
        start(finding.code, rules_.index_of(finding),
              level_of(finding.severity), finding.message, file, finding.where);
    Json related = Json::array();
    for (const Label& label : finding.labels) {
      Json location = place(file, label.where);
      location["message"] = message(label.text);
      related.push_back(std::move(location));
    }
    if (!related.empty()) result["relatedLocations"] = std::move(related);
    if (finding.waiver) result["suppressions"] = suppressions(*finding.waiver);
    const bool known =
        finding.waiver && finding.waiver->kind == Waiver::Kind::Baseline;
    if (known) result["baselineState"] = "unchanged";
    results_.push_back(std::move(result));
  }

  /// A result that were left out would be closed and opened anew by a reader.
  static Json suppressions(const Waiver& waiver) {
    const bool in_source = waiver.kind == Waiver::Kind::InSource;
    return Json::array({{{"kind", in_source ? "inSource" : "external"},
                         {"status", "accepted"},
                         {"justification", waiver.reason}}});
  }

  void add_result(const FileReport& file, const ObligationResult& result,
                  const std::optional<Cones>& cones) {
    const Obligation& obligation = result.obligation;
    const std::string rule = verdict_rule_id(result.verdict);
    const std::string text = fmt::format(
        "{}: {}: {}", obligation.name, obligation.text,
        cones ? explain(file, result, *cones) : verdict_phrase(result));
    Json json = start(rule, rules_.index_of(result.verdict),
                      level_of(result.verdict), text, file, obligation.where);
    if (cones && result.trace && !result.trace->steps.empty()) {
      json["codeFlows"] = Json::array({code_flow(file, result, *cones)});
    }
    json["properties"] = {{"property", obligation.name},
                          {"verdict", to_string(result.verdict)},
                          {"engine", result.engine}};
    results_.push_back(std::move(json));
  }

  Json start(std::string_view rule, std::size_t index, std::string_view level,
             std::string_view text, const FileReport& file,
             const SourceRange& where) {
    std::string_view line;
    if (where.has_value()) {
      const SourceFile& source = (*report_.sources)[where.file];
      line = source.line(locator_.of(where).begin.line);
    }
    Json json = {{"ruleId", rule},
                 {"ruleIndex", index},
                 {"kind", "fail"},
                 {"level", level},
                 {"message", message(text)},
                 {"locations", Json::array({place(file, where)})},
                 {"partialFingerprints",
                  {{"primaryLocationLineHash",
                    fingerprints_.next(rule, path_of(file, where), line)}}}};
    if (file.compared) json["baselineState"] = "new";
    return json;
  }

  std::string path_of(const FileReport& file, const SourceRange& where) const {
    const std::string& path =
        where.has_value() ? (*report_.sources)[where.file].path() : file.path;
    return relative_path(path, report_.working_directory);
  }

  Json place(const FileReport& file, const SourceRange& where) {
    const Place at = where.has_value() ? locator_.of(where) : Place{};
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", path_uri(path_of(file, where))}}},
              {"region",
               {{"startLine", at.begin.line},
                {"startColumn", at.begin.column},
                {"endLine", at.end.line},
                {"endColumn", at.end.column}}}}}};
  }

  /// One location a step: the rung whose signal changed, the values after it.
  Json code_flow(const FileReport& file, const ObligationResult& result,
                 const Cones& cones) {
    const auto& formulas = formulas_of(file, result.obligation);
    const std::vector<CellId> signals =
        relevant_signals(*file.program, *result.trace, cones.of(formulas),
                         cones.named(formulas));
    const std::vector<Trace::Step>& steps = result.trace->steps;
    std::size_t first = 0;
    if (flow_steps_ + steps.size() > kMaxFlowSteps) {
      first = steps.size() - 1;
      flows_cut_ = true;
    }
    Json locations = Json::array();
    for (std::size_t i = first; i < steps.size(); ++i) {
      locations.push_back(flow_step(file, result, i, signals, cones));
    }
    flow_steps_ += locations.size();
    return {
        {"message", message("the scans that lead there")},
        {"threadFlows", Json::array({{{"locations", std::move(locations)}}})}};
  }

  Json flow_step(const FileReport& file, const ObligationResult& result,
                 std::size_t index, const std::vector<CellId>& signals,
                 const Cones& cones) {
    const Program& program = *file.program;
    const Trace::Step& step = result.trace->steps[index];
    Json state = Json::object();
    std::string changes;
    SourceRange where = result.obligation.where;
    for (const CellId id : signals) {
      const Cell& cell = program.cells[id];
      const std::int64_t value = step.values[id.index()];
      const std::int64_t before =
          index == 0 ? cell.initial
                     : result.trace->steps[index - 1].values[id.index()];
      state[cell.name] = message(fmt::format("{}", value));
      if (value == before) continue;
      changes += fmt::format("{}{} = {}", changes.empty() ? ": " : ", ",
                             cell.name, value);
      const std::vector<RungId> drivers = cones.drivers({{id}});
      if (!drivers.empty()) where = program.rungs[drivers.back()].where;
    }
    Json location = place(file, where);
    location["message"] = message(heading(step) + changes);
    return {{"location", std::move(location)},
            {"state", std::move(state)},
            {"executionOrder", index + 1}};
  }

  static std::string heading(const Trace::Step& step) {
    if (step.repeat == 1) {
      return fmt::format("scan {}, {}", step.scan, duration(step.dt_ms));
    }
    const auto scans = static_cast<std::int64_t>(step.repeat);
    return fmt::format("scans {} to {}, {}", step.scan - step.repeat + 1,
                       step.scan, duration(scans * step.dt_ms));
  }

  void notify(std::string_view level, const std::string& text,
              const FileReport* file) {
    Json json = {{"level", level}, {"message", message(text)}};
    if (file != nullptr) {
      json["locations"] = Json::array({place(*file, SourceRange{})});
    }
    notifications_.push_back(std::move(json));
  }

  Json invocation() {
    if (flows_cut_) {
      notify("note",
             fmt::format("only the last step of some code flows is here: more "
                         "than {} steps in all",
                         kMaxFlowSteps),
             nullptr);
    }
    if (report_.proved && !report_.self_check) {
      notify("note",
             "self-checks are off: no trace was replayed and no certificate "
             "re-checked",
             nullptr);
    }
    const int status = exit_status(report_);
    return {{"executionSuccessful", status != 2 && status != 4},
            {"exitCode", status},
            {"toolExecutionNotifications", std::move(notifications_)}};
  }

  const Report& report_;
  Locator locator_;
  SarifRules rules_;
  Fingerprints fingerprints_;
  Json results_ = Json::array();
  Json notifications_ = Json::array();
  std::size_t flow_steps_ = 0;
  bool flows_cut_ = false;
};

}  // namespace

std::string write_sarif(const Report& report) {
  SarifWriter writer(report);
  return dump({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
               {"version", "2.1.0"},
               {"runs", Json::array({writer.run()})}});
}

}  // namespace rung
