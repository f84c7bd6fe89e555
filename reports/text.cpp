#include "reports/text.h"

#include <fmt/format.h>

#include <optional>

#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/explanation.h"
#include "reports/frame.h"
#include "reports/proof_words.h"
#include "reports/rung_values.h"
#include "reports/scan_table.h"
#include "reports/summary_line.h"
#include "reports/unicode.h"

namespace rung {
namespace {

std::string frame_of(const SourceSet& sources, const Diagnostic& diagnostic,
                     const Painter& paint, Locator& locator) {
  std::vector<Mark> marks = {{diagnostic.where, {}, true}};
  for (const Label& label : diagnostic.labels) {
    marks.push_back({label.where, label.text, false});
  }
  return draw_frame(sources, marks, ink_of(diagnostic.severity), paint,
                    locator);
}

std::string diagnostic_text(const SourceSet& sources,
                            const Diagnostic& diagnostic, const Painter& paint,
                            Locator& locator) {
  const Ink ink = ink_of(diagnostic.severity);
  std::string head =
      fmt::format("{}[{}]", to_string(diagnostic.severity), diagnostic.code);
  std::string out = paint(ink, head) + ": " +
                    paint(Ink::Strong, printable(diagnostic.message)) + "\n";
  if (diagnostic.where.has_value()) {
    out += frame_of(sources, diagnostic, paint, locator);
  }
  const auto remark = [&](std::string_view word, std::string_view text) {
    out += "  " + paint(Ink::Frame, "=") + fmt::format(" {}: ", word) +
           printable(text) + "\n";
  };
  if (!diagnostic.help.empty()) remark("help", diagnostic.help);
  if (!diagnostic.rule.empty()) {
    out += "  " + paint(Ink::Frame, "=") +
           " rule: " + std::string(diagnostic.rule) + "\n";
  }
  return out;
}

class TextWriter {
 public:
  TextWriter(const Report& report, const TextOptions& options)
      : report_(report),
        detail_(options.detail),
        paint_(options.colour),
        locator_(*report.sources) {}

  std::string write() {
    for (const FileReport& file : report_.files) write_file(file);
    if (detail_ != TextOptions::Detail::Quiet) {
      write_notes();
      out_ += rule_counts(report_);
      out_ += summary_line(report_, paint_) + "\n";
    }
    return std::move(out_);
  }

 private:
  using Detail = TextOptions::Detail;

  /// The same file is there once for each preset of semantics, in a row.
  bool is_swept(const FileReport& file) const {
    const FileReport* const first = report_.files.data();
    const FileReport* const last = first + report_.files.size() - 1;
    return (&file != first && (&file)[-1].file == file.file) ||
           (&file != last && (&file)[1].file == file.file);
  }

  void write_file(const FileReport& file) {
    if (is_swept(file)) {
      out_ += paint_(Ink::Strong,
                     fmt::format("{} under `{}` semantics",
                                 printable(file.path), file.semantics)) +
              "\n";
    }
    for (const Diagnostic& finding : file.findings) {
      out_ += diagnostic_text(*report_.sources, finding, paint_, locator_);
      out_ += '\n';
    }
    if (detail_ == Detail::Verbose) write_waived(file);
    if (file.program) cones_.emplace(*file.program);
    for (const ObligationResult& result : file.results) {
      write_result(file, result);
    }
    cones_.reset();
    for (const SelfCheckFailure& failure : file.failures) {
      out_ += paint_(Ink::Error, "self-check failed") + ": " +
              printable(failure.obligation) + ": " + failure.what + "\n\n";
    }
  }

  void write_waived(const FileReport& file) {
    for (const Diagnostic& finding : file.waived) {
      const bool in_source = finding.waiver->kind == Waiver::Kind::InSource;
      out_ +=
          place_of(finding.where) +
          fmt::format(
              "{}: {} {}: {}\n", in_source ? "allowed" : "in the baseline",
              finding.code, rule_name(finding),
              printable(in_source ? finding.waiver->reason : finding.message));
    }
  }

  void write_result(const FileReport& file, const ObligationResult& result) {
    if (result.verdict == Verdict::Violated) {
      write_violation(file, result);
    } else if (result.verdict != Verdict::Proved) {
      out_ += place_of(result.obligation.where) +
              paint_(Ink::Warning, to_string(result.verdict)) + ": " +
              printable(title_of(result.obligation)) + " (" +
              printable(why_undecided(result)) + ")\n";
    } else if (detail_ == Detail::Verbose || is_told(file, result)) {
      out_ += place_of(result.obligation.where) + paint_(Ink::Good, "proved") +
              ": " + printable(title_of(result.obligation));
      if (detail_ != Detail::Verbose) out_ += '\n';
    }
    if (detail_ == Detail::Verbose) {
      write_evidence(result);
      write_witness(file, result);
    }
    if (result.verdict == Verdict::Proved) write_proof(file, result);
  }

  /// A written property whose proof is to be put in words.
  static bool is_told(const FileReport& file, const ObligationResult& result) {
    return file.explained && result.certificate && !result.obligation.built_in;
  }

  std::string place_of(const SourceRange& where) {
    if (!where.has_value()) return {};
    const LineColumn at = locator_.of(where).begin;
    return printable((*report_.sources)[where.file].path()) +
           fmt::format(":{}:{}: ", at.line, at.column);
  }

  void write_violation(const FileReport& file, const ObligationResult& result) {
    out_ += paint_(Ink::Error, "violated") + ": " +
            paint_(Ink::Strong, printable(title_of(result.obligation))) + "\n";
    if (result.obligation.where.has_value()) {
      out_ +=
          draw_frame(*report_.sources, {{result.obligation.where, {}, true}},
                     Ink::Error, paint_, locator_);
    }
    const bool readable = file.program && cones_;
    out_ += "  " + paint_(Ink::Frame, "=") + " " +
            (readable ? printable(explain(file, result, *cones_))
                      : std::string("violated")) +
            "\n\n";
    if (!readable || !result.trace || result.trace->steps.empty()) return;
    write_trace(file, result);
    write_replay(file, result);
    if (const Explanation* why = explanation_of(file, result.obligation)) {
      out_ += explanation_text(file, *why, paint_, locator_);
    }
  }

  /// What the property speaks of, as it was on the board.
  void write_replay(const FileReport& file, const ObligationResult& result) {
    const BoardReplay* const replay = replay_of(file, result.obligation);
    if (replay == nullptr) return;
    out_ += "  " + paint_(Ink::Frame, "=") + " ";
    if (!replay->reason.empty()) {
      out_ += paint_(Ink::Warning, "not replayed on " + replay->board) + ": " +
              printable(replay->reason) + "\n\n";
      return;
    }
    std::string seen;
    const std::vector<std::int64_t>& values = result.trace->steps.back().values;
    for (const CellId id :
         cones_->named(formulas_of(file, result.obligation))) {
      const Cell& cell = file.program->cells[id];
      const std::int64_t value = values[id.index()];
      seen += seen.empty() ? "" : ", ";
      seen += cell.type == Type::Word
                  ? fmt::format("{} is {}", cell.name, value)
                  : fmt::format("{} is {}", cell.name, value != 0);
    }
    out_ += paint_(Ink::Good, "replayed on " + replay->board) + ": " +
            printable(seen) + (seen.empty() ? "the same cells" : "") +
            fmt::format(" at scan {}\n\n", replay->scan);
  }

  /// The lemmas of a proof as sentences.
  void write_proof(const FileReport& file, const ObligationResult& result) {
    if (!is_told(file, result)) return;
    if (result.certificate->lemmas.empty()) {
      out_ += result.obligation.goal == Goal::Respond
                  ? "    no lemma is needed beside its monitors\n"
                  : "    no lemma is needed: any scan alone shows it\n";
    }
    for (const std::string& lemma : result.certificate->lemmas) {
      out_ += "    " + printable(in_words(lemma)) + "\n";
    }
  }

  void write_trace(const FileReport& file, const ObligationResult& result) {
    const auto& formulas = formulas_of(file, result.obligation);
    const std::vector<CellId> named = cones_->named(formulas);
    const std::vector<CellId> shown = relevant_signals(
        *file.program, *result.trace, cones_->of(formulas), named);
    out_ +=
        draw_scan_table({*file.program, *result.trace, shown, "  "}, paint_);
    const std::string rungs =
        draw_rung_values({*report_.sources, *file.program, *result.trace,
                          cones_->drivers(named)},
                         paint_, locator_);
    if (!rungs.empty()) out_ += "\n" + rungs;
    out_ += '\n';
  }

  /// The run that gets where a written `reach` asks for.
  void write_witness(const FileReport& file, const ObligationResult& result) {
    const bool shown = result.verdict == Verdict::Proved && result.trace &&
                       !result.trace->steps.empty() &&
                       !result.obligation.built_in && cones_;
    if (!shown) return;
    out_ += '\n';
    write_trace(file, result);
  }

  /// A way back is refuted by what holds ever after.
  static std::string_view label_of(const ObligationResult& result) {
    const bool trap = result.obligation.goal == Goal::Recover &&
                      result.verdict == Verdict::Violated;
    return trap ? "\n    from there on: " : "\n    invariant: ";
  }

  void write_evidence(const ObligationResult& result) {
    out_ += result.verdict == Verdict::Proved ? "\n    by " : "    by ";
    out_ += fmt::format("{}, {:.1f} ms", result.engine, result.milliseconds);
    if (result.scans > 0) out_ += ", " + quantity(result.scans, "scan");
    if (result.certificate) {
      for (const std::string& checker : result.certificate->checked_by) {
        out_ += ", checked by " + checker;
      }
      for (const std::string& lemma : result.certificate->lemmas) {
        out_ += label_of(result);
        out_ += printable(lemma);
      }
      for (const std::string& way : result.certificate->ways) {
        out_ += "\n    way: " + printable(way);
      }
      if (!result.certificate->smtlib_path.empty()) {
        out_ +=
            "\n    certificate: " + printable(result.certificate->smtlib_path);
      }
    }
    out_ += '\n';
  }

  void write_notes() {
    for (const FileReport& file : report_.files) {
      for (const std::string& note : file.notes) {
        out_ += paint_(Ink::Note, "note") + ": " + printable(file.path) + ": " +
                printable(note) + "\n";
      }
    }
    if (report_.proved && !report_.self_check) {
      out_ += paint_(Ink::Note, "note") +
              ": self-checks are off: no trace was replayed and no "
              "certificate re-checked\n";
    }
  }

  const Report& report_;
  Detail detail_;
  Painter paint_;
  Locator locator_;
  std::optional<Cones> cones_;
  std::string out_;
};

}  // namespace

std::string write_text(const Report& report, const TextOptions& options) {
  return TextWriter(report, options).write();
}

std::string write_diagnostic(const SourceSet& sources,
                             const Diagnostic& diagnostic, bool colour) {
  const Painter paint(colour);
  Locator locator(sources);
  return diagnostic_text(sources, diagnostic, paint, locator);
}

}  // namespace rung
