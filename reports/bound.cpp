#include "reports/bound.h"

#include <fmt/format.h>

#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/json_parts.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = SpanBound::Kind;
using Reach = ResponseBounds::Reach;

std::string in_words(std::int64_t value, SpanUnit unit) {
  return unit == SpanUnit::Scans
             ? quantity(static_cast<std::size_t>(value), "scan")
             : duration(value);
}

/// "1.05 s", "at least 1.05 s", "1 to 21 scans".
std::string value_of(const SpanBound& bound, SpanUnit unit) {
  if (bound.kind == Kind::Exact) return in_words(bound.at_least, unit);
  if (!bound.at_most) return "at least " + in_words(bound.at_least, unit);
  if (bound.at_least == 0) return "at most " + in_words(*bound.at_most, unit);
  return fmt::format("{} to {}", in_words(bound.at_least, unit),
                     in_words(*bound.at_most, unit));
}

class BoundText {
 public:
  BoundText(const BoundReport& report, const TextOptions& options)
      : report_(report),
        options_(options),
        paint_(options.colour),
        cones_(*report.file.program) {}

  std::string write() {
    const ResponseQuestion& question = report_.question;
    if (options_.detail != TextOptions::Detail::Quiet) {
      out_ += fmt::format("{}: from {} to {}\n\n", printable(report_.file.path),
                          quoted(question.cause), quoted(question.response));
    }
    if (report_.bounds.cause == Reach::Yes) {
      write_side("at worst", report_.bounds.worst, true);
      write_side("at best", report_.bounds.best, false);
    } else {
      write_no_cause();
    }
    for (const SelfCheckFailure& failure : report_.bounds.failures) {
      out_ +=
          paint_(Ink::Error, "self-check failed") + ": " + failure.what + "\n";
    }
    if (options_.detail != TextOptions::Detail::Quiet) write_notes();
    return std::move(out_);
  }

 private:
  static std::string quoted(const std::string& formula) {
    return "`" + printable(formula) + "`";
  }

  void write_no_cause() {
    const bool never = report_.bounds.cause == Reach::No;
    out_ += paint_(Ink::Warning, never ? "vacuous" : "unknown") + ": " +
            quoted(report_.question.cause) +
            (never ? " can never be true"
                   : ": whether it can be true was not decided");
    if (!report_.bounds.reason.empty()) {
      out_ += " (" + report_.bounds.reason + ")";
    }
    out_ += '\n';
  }

  void write_side(std::string_view name, const SpanBound (&sides)[2],
                  bool is_worst) {
    const SpanBound& time = sides[0];
    if (time.kind == Kind::Unbounded) {
      write_unbounded(name, time, is_worst);
    } else {
      const Ink ink = time.kind == Kind::Exact ? Ink::Good : Ink::Warning;
      out_ += paint_(Ink::Strong, std::string(name)) + ": " +
              paint_(ink, value_of(time, SpanUnit::Milliseconds)) + ", " +
              value_of(sides[1], SpanUnit::Scans);
      if (!time.reason.empty()) out_ += " (" + time.reason + ")";
      out_ += '\n';
    }
    if (options_.detail == TextOptions::Detail::Verbose) write_proof(time);
    if (options_.detail != TextOptions::Detail::Quiet) write_trace(time);
  }

  void write_unbounded(std::string_view name, const SpanBound& time,
                       bool is_worst) {
    const bool proved = time.certificate.has_value();
    out_ += paint_(Ink::Strong, std::string(name)) + ": " +
            paint_(Ink::Error, is_worst ? "unbounded" : "never");
    if (proved) {
      out_ += fmt::format(": {} never comes behind {}",
                          quoted(report_.question.response),
                          quoted(report_.question.cause));
    } else {
      out_ += fmt::format(": {} need not come: from the end of this run on {}",
                          quoted(report_.question.response), time.reason);
    }
    out_ += '\n';
  }

  void write_proof(const SpanBound& bound) {
    if (!bound.certificate) return;
    out_ += "    by " + bound.engine;
    for (const std::string& checker : bound.certificate->checked_by) {
      out_ += ", checked by " + checker;
    }
    for (const std::string& lemma : bound.certificate->lemmas) {
      out_ += "\n    invariant: " + printable(lemma);
    }
    out_ += '\n';
  }

  void write_trace(const SpanBound& bound) {
    if (!bound.trace || bound.trace->steps.empty()) return;
    const std::vector<std::string> formulas = {report_.question.cause,
                                               report_.question.response};
    const Program& program = *report_.file.program;
    const std::vector<CellId> shown = relevant_signals(
        program, *bound.trace, cones_.of(formulas), cones_.named(formulas));
    out_ += "\n" +
            draw_scan_table({program, *bound.trace, shown, "  "}, paint_) +
            "\n";
  }

  void write_notes() {
    for (const std::string& note : report_.file.notes) {
      out_ += paint_(Ink::Note, "note") + ": " + printable(note) + "\n";
    }
    if (!report_.self_check) {
      out_ += paint_(Ink::Note, "note") +
              ": self-checks are off: no certificate was re-checked\n";
    }
  }

  const BoundReport& report_;
  TextOptions options_;
  Painter paint_;
  Cones cones_;
  std::string out_;
};

std::string_view word_of(Kind kind, bool is_worst) {
  switch (kind) {
    case Kind::Exact:
      return "exact";
    case Kind::Unbounded:
      return is_worst ? "unbounded" : "never";
    case Kind::Between:
      return "between";
  }
  return "";
}

class BoundJson {
 public:
  explicit BoundJson(const BoundReport& report) : report_(report) {
    for (const CellId id : ids_of(report.file.program->cells)) {
      all_.push_back(id);
    }
  }

  Json document() const {
    Json solvers = Json::object();
    for (const auto& [name, version] : report_.solvers) solvers[name] = version;
    const FileReport& file = report_.file;
    const ScanInterval& scan = file.program->scan;
    Json json = {{"schema", "rungproof.bound/1"},
                 {"tool",
                  {{"name", "rungproof"},
                   {"version", report_.version},
                   {"solvers", std::move(solvers)}}},
                 {"file", file.path},
                 {"language", file.language},
                 {"semantics", file.semantics},
                 {"scan", {{"min_ms", scan.min_ms}, {"max_ms", scan.max_ms}}},
                 {"cause", report_.question.cause},
                 {"response", report_.question.response},
                 {"cause_reachable", cause()},
                 {"reason", text_or_null(report_.bounds.reason)},
                 {"self_check", report_.self_check},
                 {"milliseconds", rounded_ms(report_.milliseconds)}};
    const bool known = report_.bounds.cause == Reach::Yes;
    json["worst"] = known ? sides(report_.bounds.worst, true) : Json();
    json["best"] = known ? sides(report_.bounds.best, false) : Json();
    Json failures = Json::array();
    for (const SelfCheckFailure& failure : report_.bounds.failures) {
      failures.push_back(failure.what);
    }
    json["failures"] = std::move(failures);
    return json;
  }

 private:
  Json cause() const {
    switch (report_.bounds.cause) {
      case Reach::Yes:
        return true;
      case Reach::No:
        return false;
      case Reach::Unknown:
        return nullptr;
    }
    return nullptr;
  }

  static Json text_or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
  }

  Json sides(const SpanBound (&bounds)[2], bool is_worst) const {
    return {{"ms", side(bounds[0], is_worst)},
            {"scans", side(bounds[1], is_worst)}};
  }

  Json side(const SpanBound& bound, bool is_worst) const {
    const bool exact = bound.kind == Kind::Exact;
    const bool finite = bound.kind != Kind::Unbounded;
    Json json = {
        {"verdict", word_of(bound.kind, is_worst)},
        {"value", exact ? Json(bound.at_least) : Json()},
        {"at_least", finite || is_worst ? Json(bound.at_least) : Json()},
        {"at_most", bound.at_most ? Json(*bound.at_most) : Json()},
        {"engine", text_or_null(bound.engine)},
        {"reason", text_or_null(bound.reason)},
        {"certificate",
         bound.certificate ? json_of(*bound.certificate) : Json()},
        {"trace", nullptr}};
    if (bound.trace) {
      json["trace"] = json_of(*report_.file.program, *bound.trace, all_);
    }
    return json;
  }

  const BoundReport& report_;
  std::vector<CellId> all_;
};

}  // namespace

int exit_status(const BoundReport& report) {
  const ResponseBounds& bounds = report.bounds;
  if (!bounds.failures.empty()) return 4;
  if (bounds.cause != Reach::Yes) return 3;
  const SpanBound& worst = bounds.worst[0];
  const SpanBound& best = bounds.best[0];
  if (worst.kind == Kind::Unbounded) return 1;
  return worst.kind == Kind::Exact && best.kind == Kind::Exact ? 0 : 3;
}

std::string write_text(const BoundReport& report, const TextOptions& options) {
  return BoundText(report, options).write();
}

std::string write_json(const BoundReport& report) {
  return dump(BoundJson(report).document());
}

}  // namespace rung
