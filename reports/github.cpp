#include "reports/github.h"

#include <fmt/format.h>

#include <optional>

#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/locate.h"
#include "reports/paths.h"
#include "reports/scan_table.h"
#include "reports/summary_line.h"
#include "reports/unicode.h"

namespace rung {
namespace {

/// `%`, CR and LF in messages; `:` and `,` too in property values.
std::string escaped(std::string_view text, bool is_property) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    const bool special = c == '%' || c == '\r' || c == '\n' ||
                         (is_property && (c == ':' || c == ','));
    if (special) {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out;
}

class GithubWriter {
 public:
  explicit GithubWriter(const Report& report)
      : report_(report), locator_(*report.sources) {}

  std::string write() {
    for (const FileReport& file : report_.files) write_file(file);
    if (report_.proved && !report_.self_check) {
      out_ += "::notice title=rungproof::self-checks are off\n";
    }
    out_ += "::notice title=rungproof::" +
            escaped(summary_line(report_, Painter(false)), false) + "\n";
    return std::move(out_);
  }

 private:
  void write_file(const FileReport& file) {
    for (const Diagnostic& finding : file.findings) {
      std::string message = finding.message;
      if (!finding.help.empty()) message += "\nhelp: " + finding.help;
      annotate(command_of(finding.severity), file, finding.where,
               fmt::format("{} {}", finding.code, rule_name(finding)), message);
    }
    std::optional<Cones> cones;
    for (const ObligationResult& result : file.results) {
      if (result.verdict == Verdict::Proved) continue;
      if (!cones && file.program) cones.emplace(*file.program);
      write_result(file, result, cones);
    }
    for (const SelfCheckFailure& failure : file.failures) {
      annotate("error", file, {}, "self-check failed: " + failure.obligation,
               failure.what);
    }
    for (const std::string& note : file.notes) {
      annotate("notice", file, {}, "rungproof", note);
    }
  }

  void write_result(const FileReport& file, const ObligationResult& result,
                    const std::optional<Cones>& cones) {
    const Obligation& obligation = result.obligation;
    std::string message =
        obligation.text + "\n" +
        (cones ? explain(file, result, *cones) : verdict_phrase(result));
    if (cones && result.trace) {
      const auto& formulas = formulas_of(file, obligation);
      const auto shown =
          relevant_signals(*file.program, *result.trace, cones->of(formulas),
                           cones->named(formulas));
      message +=
          "\n" + draw_scan_table({*file.program, *result.trace, shown, ""},
                                 Painter(false));
    }
    annotate(result.verdict == Verdict::Violated ? "error" : "warning", file,
             obligation.where,
             fmt::format("{}: {}", to_string(result.verdict), obligation.name),
             message);
  }

  static std::string_view command_of(Severity severity) {
    return severity == Severity::Note ? "notice" : to_string(severity);
  }

  void annotate(std::string_view command, const FileReport& file,
                const SourceRange& where, std::string_view title,
                std::string_view message) {
    const std::string& path =
        where.has_value() ? (*report_.sources)[where.file].path() : file.path;
    const Place at = where.has_value() ? locator_.of(where) : Place{};
    out_ += fmt::format(
        "::{} file={},line={},endLine={},", command,
        escaped(relative_path(path, report_.working_directory), true),
        at.begin.line, at.end.line);
    // Columns of two lines are refused by the runner.
    if (at.begin.line == at.end.line) {
      out_ +=
          fmt::format("col={},endColumn={},", at.begin.column, at.end.column);
    }
    out_ += fmt::format("title={}::{}\n", escaped(title, true),
                        escaped(message, false));
  }

  const Report& report_;
  Locator locator_;
  std::string out_;
};

}  // namespace

std::string write_github(const Report& report) {
  return GithubWriter(report).write();
}

}  // namespace rung
