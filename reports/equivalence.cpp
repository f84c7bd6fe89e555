#include "reports/equivalence.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "reports/explain.h"
#include "reports/frame.h"
#include "reports/json_parts.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

bool has_input_errors(const EquivalenceReport& report) {
  const auto any = [](const FileReport& file) {
    return std::any_of(file.findings.begin(), file.findings.end(),
                       is_input_error);
  };
  return any(report.a) || any(report.b);
}

/// Both programs' cells, for tables and traces; it has no rungs.
struct Joined {
  std::shared_ptr<Program> program = std::make_shared<Program>();
  std::optional<Trace> trace;
  std::unordered_map<std::string, CellId> cells;  // by name

  void add_cells(const Program& from, std::string_view prefix) {
    for (Cell cell : from.cells) {
      cell.name = std::string(prefix) + cell.name;
      const std::string name = cell.name;
      cells.emplace(name, program->cells.add(std::move(cell)));
    }
  }
};

Joined join(const EquivalenceReport& report) {
  Joined joined;
  if (!report.a.program || !report.b.program) return joined;
  joined.program->file = report.a.file;
  joined.add_cells(*report.a.program, "a.");
  joined.add_cells(*report.b.program, "b.");
  if (!report.trace_a || !report.trace_b) return joined;
  joined.trace = report.trace_a;
  std::vector<Trace::Step>& steps = joined.trace->steps;
  const std::vector<Trace::Step>& others = report.trace_b->steps;
  steps.resize(std::min(steps.size(), others.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i].values.insert(steps[i].values.end(), others[i].values.begin(),
                           others[i].values.end());
  }
  return joined;
}

/// The name that output `name` of the first program has in the second.
std::string partner(const EquivalenceReport& report, const std::string& name) {
  for (const auto& [a, b] : report.map) {
    if (a == name) return b;
  }
  return name;
}

/// The outputs that differ at the trace's end: "a.Q0 = 1, b.Q0 = 0".
std::string difference(const EquivalenceReport& report, const Joined& joined) {
  std::string out;
  if (!joined.trace || joined.trace->steps.empty()) return out;
  const std::vector<std::int64_t>& values = joined.trace->steps.back().values;
  const auto value_of = [&](const std::string& name) {
    const auto found = joined.cells.find(name);
    return found == joined.cells.end() ? 0 : values[found->second.index()];
  };
  for (const std::string& name : report.outputs) {
    const std::string a = "a." + name;
    const std::string b = "b." + partner(report, name);
    if (value_of(a) == value_of(b)) continue;
    out += fmt::format("{}{} = {}, {} = {}", out.empty() ? "" : "; ", a,
                       value_of(a), b, value_of(b));
  }
  return out;
}

/// Columns of the table: shared inputs once, then what differs or moves.
std::vector<CellId> columns(const EquivalenceReport& report,
                            const Joined& joined) {
  const std::unordered_set<std::string> outputs(report.outputs.begin(),
                                                report.outputs.end());
  std::vector<CellId> cells;
  std::vector<CellId> named;
  for (const CellId id : ids_of(joined.program->cells)) {
    const Cell& cell = joined.program->cells[id];
    const std::string name = cell.name.substr(2);
    const bool is_twin = cell.role == CellRole::Input &&
                         cell.name.starts_with("b.") &&
                         joined.cells.count("a." + name) > 0;
    if (is_twin) continue;
    cells.push_back(id);
    if (outputs.count(name) > 0) named.push_back(id);
  }
  return relevant_signals(*joined.program, *joined.trace, cells, named);
}

Json findings_json(const EquivalenceReport& report) {
  Json findings = Json::array();
  for (const FileReport* file : {&report.a, &report.b}) {
    for (const Diagnostic& finding : file->findings) {
      findings.push_back({{"code", finding.code},
                          {"severity", to_string(finding.severity)},
                          {"file", file->path},
                          {"message", finding.message}});
    }
  }
  return findings;
}

/// One change of the second program that makes them the same; null: none.
Json repair_json(const EquivalenceReport& report) {
  if (report.repair.empty()) return nullptr;
  Locator locator(*report.sources);
  const LineColumn at = locator.of(report.repair_where).begin;
  return {{"file", report.b.path},
          {"line", at.line},
          {"column", at.column},
          {"message", report.repair}};
}

Json json_of(const EquivalenceReport& report) {
  const Joined joined = join(report);
  Json solvers = Json::object();
  for (const auto& [name, version] : report.solvers) solvers[name] = version;
  Json failures = Json::array();
  for (const SelfCheckFailure& failure : report.failures) {
    failures.push_back({{"name", failure.obligation}, {"what", failure.what}});
  }
  Json json = {{"schema", "rungproof.equiv/1"},
               {"verdict", report.verdict},
               {"outputs", report.outputs},
               {"delay", report.delay},
               {"settled", report.settled},
               {"engine", report.engine},
               {"certificate", nullptr},
               {"trace", nullptr},
               {"reason", nullptr},
               {"scans", report.scans},
               {"milliseconds", rounded_ms(report.milliseconds)},
               {"files", {report.a.path, report.b.path}},
               {"tool",
                {{"name", "rungproof"},
                 {"version", report.version},
                 {"solvers", std::move(solvers)}}},
               {"notes", report.notes},
               {"findings", findings_json(report)},
               {"exit_status", exit_status(report)},
               {"self_check", report.self_check},
               {"self_check_failures", std::move(failures)}};
  if (!report.reason.empty()) json["reason"] = report.reason;
  json["repair"] = repair_json(report);
  if (report.certificate) json["certificate"] = json_of(*report.certificate);
  if (joined.trace) {
    std::vector<CellId> all;
    for (const CellId id : ids_of(joined.program->cells)) all.push_back(id);
    json["trace"] = json_of(*joined.program, *joined.trace, all);
  }
  return json;
}

std::string headline(const EquivalenceReport& report, const Painter& paint) {
  const Ink ink = report.verdict == "equivalent"  ? Ink::Good
                  : report.verdict == "different" ? Ink::Error
                                                  : Ink::Warning;
  return paint(ink, report.verdict) + ": " + printable(report.a.path) +
         " and " + printable(report.b.path);
}

}  // namespace

int exit_status(const EquivalenceReport& report) {
  if (!report.failures.empty()) return 4;
  if (has_input_errors(report)) return 2;
  if (report.verdict == "different") return 1;
  return report.verdict == "equivalent" ? 0 : 3;
}

std::string write_text(const EquivalenceReport& report,
                       const TextOptions& options) {
  const Painter paint(options.colour);
  std::string out;
  for (const FileReport* file : {&report.a, &report.b}) {
    for (const Diagnostic& finding : file->findings) {
      out += write_diagnostic(*report.sources, finding, options.colour) + "\n";
    }
  }
  for (const SelfCheckFailure& failure : report.failures) {
    out += paint(Ink::Error, "self-check failed") + ": " +
           printable(failure.obligation) + ": " + failure.what + "\n";
  }
  if (has_input_errors(report)) return out;
  const bool quiet = options.detail == TextOptions::Detail::Quiet;
  if (quiet && report.verdict == "equivalent") return out;
  out += headline(report, paint);
  if (!report.reason.empty()) out += " (" + printable(report.reason) + ")";
  out += '\n';
  const Joined joined = join(report);
  if (joined.trace && !joined.trace->steps.empty()) {
    out += fmt::format("  = at the end of scan {}: {}\n\n",
                       joined.trace->steps.back().scan,
                       difference(report, joined));
    out += draw_scan_table(
        {*joined.program, *joined.trace, columns(report, joined), "  "}, paint);
    out += '\n';
  }
  if (!report.repair.empty()) {
    Locator locator(*report.sources);
    out += "  = " + report.repair + ":\n" +
           draw_frame(*report.sources, {{report.repair_where, {}, true}},
                      Ink::Note, paint, locator) +
           "\n";
  }
  if (quiet) return out;
  for (const FileReport* file : {&report.a, &report.b}) {
    for (const std::string& note : file->notes) {
      out += paint(Ink::Note, "note") + ": " + printable(file->path) + ": " +
             printable(note) + "\n";
    }
  }
  for (const std::string& note : report.notes) {
    out += paint(Ink::Note, "note") + ": " + printable(note) + "\n";
  }
  out += "compared " + quantity(report.outputs.size(), "output");
  if (!report.engine.empty()) out += ", by " + report.engine;
  out += '\n';
  return out;
}

std::string write_json(const EquivalenceReport& report) {
  return dump(json_of(report));
}

std::string write_jsonl(const EquivalenceReport& report) {
  return dump_line(json_of(report));
}

Report as_report(const EquivalenceReport& report) {
  Report out;
  out.sources = report.sources;
  out.command = "equiv";
  out.version = report.version;
  out.solvers = report.solvers;
  out.working_directory = report.working_directory;
  out.self_check = report.self_check;
  out.linted = false;
  out.files = {report.a, report.b};
  if (has_input_errors(report)) return out;
  Joined joined = join(report);
  ObligationResult result;
  result.obligation.name = "equivalent";
  result.obligation.kind = "equivalence";
  result.obligation.text =
      fmt::format("{} and {} are the same on {}", report.a.path, report.b.path,
                  quantity(report.outputs.size(), "output"));
  result.obligation.where = {report.a.file, 0, 0};
  result.verdict = report.verdict == "equivalent"  ? Verdict::Proved
                   : report.verdict == "different" ? Verdict::Violated
                   : report.verdict == "bounded"   ? Verdict::Bounded
                                                   : Verdict::Unknown;
  result.engine = report.engine;
  result.scans = report.scans;
  result.milliseconds = report.milliseconds;
  result.reason = report.reason;
  result.certificate = report.certificate;
  result.trace = joined.trace;
  Property property;
  property.form = Property::Form::Interlock;  // no clause of its own
  property.name = result.obligation.name;
  for (const std::string& name : report.outputs) {
    property.formulas.push_back("a." + name);
    property.formulas.push_back("b." + partner(report, name));
  }
  FileReport& file = out.files.front();
  file.program = joined.program;
  file.properties.properties = {std::move(property)};
  file.results.push_back(std::move(result));
  file.failures = report.failures;
  file.notes.insert(file.notes.end(), report.notes.begin(), report.notes.end());
  return out;
}

}  // namespace rung
