#include "reports/json.h"

#include <optional>

#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/explanation.h"
#include "reports/json_parts.h"
#include "reports/locate.h"
#include "reports/proof_words.h"

namespace rung {
namespace {

/// A trace names every cell of a program up to this many, and beyond it those
/// that its property depends on: a plant has thousands of traces.
constexpr std::size_t kMaxCellsInTrace = 64;

Json position(const LineColumn& at) {
  return {{"line", at.line}, {"column", at.column}};
}

class JsonWriter {
 public:
  explicit JsonWriter(const Report& report)
      : report_(report), locator_(*report.sources) {}

  Json tool() const {
    Json solvers = Json::object();
    for (const auto& [name, version] : report_.solvers) {
      solvers[name] = version;
    }
    return {{"name", "rungproof"},
            {"version", report_.version},
            {"solvers", std::move(solvers)}};
  }

  static Json file(const FileReport& file) {
    Json inputs = Json::array();
    Json outputs = Json::array();
    if (file.program) {
      for (const Cell& cell : file.program->cells) {
        if (cell.role == CellRole::Input) inputs.push_back(cell.name);
        if (cell.role == CellRole::Output) outputs.push_back(cell.name);
      }
    }
    const std::size_t rungs = file.program ? file.program->rungs.size() : 0;
    Json scan = nullptr;
    if (file.program) {
      scan = {file.program->scan.min_ms, file.program->scan.max_ms};
    }
    return {{"path", file.path},           {"language", file.language},
            {"dialect", file.dialect},     {"semantics", file.semantics},
            {"scan_ms", std::move(scan)},  {"rungs", rungs},
            {"inputs", std::move(inputs)}, {"outputs", std::move(outputs)},
            {"notes", file.notes}};
  }

  Json finding(const FileReport& file, const Diagnostic& diagnostic) {
    Json labels = Json::array();
    for (const Label& label : diagnostic.labels) {
      labels.push_back({{"file", path_of(file, label.where)},
                        {"range", range(label.where)},
                        {"message", label.text}});
    }
    Json json = {{"code", diagnostic.code},
                 {"rule", rule_name(diagnostic)},
                 {"severity", to_string(diagnostic.severity)},
                 {"file", path_of(file, diagnostic.where)},
                 {"range", range(diagnostic.where)},
                 {"message", diagnostic.message},
                 {"labels", std::move(labels)},
                 {"help", nullptr}};
    if (!diagnostic.help.empty()) json["help"] = diagnostic.help;
    if (const auto& waiver = diagnostic.waiver) {
      const bool in_source = waiver->kind == Waiver::Kind::InSource;
      json["waiver"] = {{"kind", in_source ? "in-source" : "baseline"},
                        {"reason", waiver->reason}};
    }
    return json;
  }

  Json property(const FileReport& file, const ObligationResult& result,
                const Cones* cones) {
    const Obligation& obligation = result.obligation;
    Json json = {{"name", obligation.name},
                 {"kind", obligation.kind},
                 {"text", obligation.text},
                 {"file", path_of(file, obligation.where)},
                 {"line", nullptr},
                 {"verdict", to_string(result.verdict)},
                 {"engine", result.engine},
                 {"scans", result.scans},
                 {"milliseconds", rounded_ms(result.milliseconds)},
                 {"reason", nullptr},
                 {"certificate", nullptr},
                 {"trace", nullptr},
                 {"goal", to_string(obligation.goal)},
                 {"built_in", obligation.built_in}};
    if (obligation.where.has_value()) {
      json["line"] = locator_.of(obligation.where).begin.line;
    }
    if (!result.reason.empty()) json["reason"] = result.reason;
    if (result.certificate) json["certificate"] = json_of(*result.certificate);
    if (file.explained) json["explanation"] = explanation(file, result);
    if (const BoardReplay* replay = replay_of(file, obligation)) {
      const bool executed = replay->reason.empty();
      json["replay"] = {{"board", replay->board},
                        {"replayed", executed},
                        {"scan", nullptr},
                        {"reason", nullptr}};
      if (executed) json["replay"]["scan"] = replay->scan;
      if (!executed) json["replay"]["reason"] = replay->reason;
    }
    if (result.trace && file.program) {
      json["trace"] =
          json_of(*file.program, *result.trace, signals(file, result, cones));
    }
    return json;
  }

  /// Of a violation why it comes to it, of a proof its lemmas as sentences.
  Json explanation(const FileReport& file, const ObligationResult& result) {
    if (result.verdict == Verdict::Proved && result.certificate) {
      Json words = Json::array();
      for (const std::string& lemma : result.certificate->lemmas) {
        words.push_back(in_words(lemma));
      }
      return {{"proof", std::move(words)}};
    }
    const Explanation* why = explanation_of(file, result.obligation);
    if (why == nullptr) return nullptr;
    const Program& program = *file.program;
    Json inputs = Json::array();
    for (const Explanation::InputChange& change : why->needed) {
      inputs.push_back({{"scan", change.scan},
                        {"name", program.cells[change.cell].name},
                        {"value", change.value}});
    }
    Json chain = Json::array();
    for (const Explanation::Step& step : why->chain) {
      Json contacts = Json::array();
      for (const Explanation::Contact& contact : step.contacts) {
        contacts.push_back({{"name", contact.name}, {"value", contact.value}});
      }
      chain.push_back({{"scan", step.scan},
                       {"name", program.cells[step.cell].name},
                       {"value", step.value},
                       {"kept", step.kept},
                       {"line", line_of(program, step.rung)},
                       {"contacts", std::move(contacts)}});
    }
    Json json = {{"inputs", std::move(inputs)},
                 {"chain", std::move(chain)},
                 {"blamed_line", line_of(program, why->blamed)},
                 {"repair", nullptr}};
    if (why->repair) {
      json["repair"] = {{"line", line_of(program, why->repair->rung)},
                        {"edit", why->repair->edit}};
    }
    return json;
  }

  Json line_of(const Program& program, RungId rung) {
    if (!rung.has_value() || !program.rungs[rung].where.has_value()) {
      return nullptr;
    }
    return locator_.of(program.rungs[rung].where).begin.line;
  }

  static Json failure(const FileReport& file, const SelfCheckFailure& failure) {
    return {{"file", file.path},
            {"name", failure.obligation},
            {"what", failure.what}};
  }

  Json summary() const {
    const Summary summary = summarise(report_);
    return {{"files", summary.files},
            {"rungs", summary.rungs},
            {"obligations", summary.obligations},
            {"proved", summary.proved},
            {"violated", summary.violated},
            {"bounded", summary.bounded},
            {"vacuous", summary.vacuous},
            {"unknown", summary.unknown},
            {"findings", summary.findings},
            {"allowed", summary.allowed},
            {"baselined", summary.baselined},
            {"input_errors", summary.input_errors},
            {"self_check_failures", summary.failures}};
  }

  /// Calls `visit(event, json)` for all that the files gave.
  template <class Visit>
  void each(Visit visit) {
    for (const FileReport& one : report_.files) {
      visit("file", file(one));
      for (const Diagnostic& diagnostic : one.findings) {
        visit("finding", finding(one, diagnostic));
      }
      for (const Diagnostic& diagnostic : one.waived) {
        visit("waived", finding(one, diagnostic));
      }
      std::optional<Cones> cones;
      if (one.program && one.program->cells.size() > kMaxCellsInTrace) {
        cones.emplace(*one.program);
      }
      for (const ObligationResult& result : one.results) {
        visit("property", property(one, result, cones ? &*cones : nullptr));
      }
      for (const SelfCheckFailure& failed : one.failures) {
        visit("self-check-failure", failure(one, failed));
      }
    }
  }

 private:
  static std::vector<CellId> signals(const FileReport& file,
                                     const ObligationResult& result,
                                     const Cones* cones) {
    if (cones != nullptr) {
      return cones->of(formulas_of(file, result.obligation));
    }
    std::vector<CellId> all;
    for (const CellId id : ids_of(file.program->cells)) all.push_back(id);
    return all;
  }

  std::string path_of(const FileReport& file, const SourceRange& where) const {
    return where.has_value() ? (*report_.sources)[where.file].path()
                             : file.path;
  }

  Json range(const SourceRange& where) {
    const Place place = where.has_value() ? locator_.of(where) : Place{};
    return {{"start", position(place.begin)}, {"end", position(place.end)}};
  }

  const Report& report_;
  Locator locator_;
};

}  // namespace

std::string write_json(const Report& report) {
  JsonWriter writer(report);
  Json files = Json::array();
  Json findings = Json::array();
  Json waived = Json::array();
  Json properties = Json::array();
  Json failures = Json::array();
  writer.each([&](std::string_view event, Json json) {
    Json& list = event == "file"       ? files
                 : event == "finding"  ? findings
                 : event == "waived"   ? waived
                 : event == "property" ? properties
                                       : failures;
    list.push_back(std::move(json));
  });
  return dump({{"schema", "rungproof.result/1"},
               {"tool", writer.tool()},
               {"files", std::move(files)},
               {"findings", std::move(findings)},
               {"properties", std::move(properties)},
               {"summary", writer.summary()},
               {"command", report.command},
               {"exit_status", exit_status(report)},
               {"self_check", report.self_check},
               {"self_check_failures", std::move(failures)},
               {"waived", std::move(waived)}});
}

std::string write_jsonl(const Report& report) {
  JsonWriter writer(report);
  std::string out = dump_line({{"schema", "rungproof.events/1"},
                               {"event", "start"},
                               {"command", report.command},
                               {"tool", writer.tool()}});
  writer.each([&](std::string_view event, const Json& json) {
    Json line = {{"event", event}};
    line.update(json);
    out += dump_line(line);
  });
  Json last = {{"event", "summary"}};
  last.update(writer.summary());
  last["exit_status"] = exit_status(report);
  out += dump_line(last);
  return out;
}

}  // namespace rung
