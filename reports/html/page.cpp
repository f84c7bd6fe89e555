#include "reports/html/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "reports/assets.h"
#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/explanation.h"
#include "reports/frame.h"
#include "reports/html/ladders.h"
#include "reports/html/run.h"
#include "reports/locate.h"
#include "reports/markup.h"
#include "reports/proof_words.h"
#include "reports/rung_values.h"
#include "reports/scan_table.h"
#include "reports/summary_line.h"

namespace rung {
namespace {

// Pages with more runs than this are drawn by the script, to stay small: the
// ladder of the program is in the page once.
constexpr std::size_t kMaxDrawnRuns = 40;
constexpr std::size_t kMaxListed = 200;
constexpr std::size_t kMaxOpen = 50;  // of what is not proved

/// Lines of text for <pre>.
std::string markup_lines(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += markup(text.substr(0, end)) + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

struct Count {
  std::size_t number = 0;
  std::string_view word;
  std::string_view style;  // where the number is not 0
};

class Page {
 public:
  explicit Page(const Report& report)
      : report_(report), locator_(*report.sources) {}

  std::string write() {
    write_head();
    write_overview();
    write_file_table();
    write_not_proved();
    for (std::size_t i = 0; i < report_.files.size(); ++i) write_file(i);
    add("</main>\n<script>{}</script>\n</body>\n</html>\n", kPageScript.text);
    return std::move(out_);
  }

 private:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), text,
                   std::forward<Arguments>(arguments)...);
  }

  void write_head() {
    add("<!DOCTYPE html>\n"
        "<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src "
        "&#39;none&#39;; script-src {}; style-src {} {}\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\"/>\n"
        "<title>rungproof {}: {}</title>\n"
        "<style>{}</style>\n<style>{}</style>\n</head>\n",
        markup(csp_source(kPageScript)), markup(csp_source(kPageStyle)),
        markup(csp_source(kLadderStyle)), report_.command,
        markup(summary_line(report_, Painter(false))), kPageStyle.text,
        kLadderStyle.text);
  }

  void write_overview() {
    const int status = exit_status(report_);
    const std::string line = summary_line(report_, Painter(false));
    add("<body>\n<header>\n<h1>rungproof {}</h1>\n"
        "<p class=\"{}\"><strong>{}</strong></p>\n",
        report_.command,
        status == 0   ? "good"
        : status == 3 ? "warn"
                      : "bad",
        markup(line));
    write_counts(summarise(report_));
    add("<p class=\"soft\">rungproof {}", markup(report_.version));
    for (const auto& [name, version] : report_.solvers) {
      add(", {} {}", markup(name), markup(version));
    }
    add("; exit status {}</p>\n", status);
    if (report_.proved && !report_.self_check) {
      add("<p class=\"warn\">self-checks are off: no trace was replayed and no "
          "certificate re-checked</p>\n");
    }
    add("</header>\n<main>\n");
  }

  void write_counts(const Summary& summary) {
    std::vector<Count> counts;
    if (report_.proved) {
      counts = {{summary.proved, "proved", "good"},
                {summary.violated, "violated", "bad"},
                {summary.bounded, "bounded", "warn"},
                {summary.vacuous, "vacuous", "warn"},
                {summary.unknown, "unknown", "warn"}};
    }
    counts.push_back({summary.findings, "findings", "warn"});
    if (summary.failures > 0) {
      counts.push_back({summary.failures, "failed self-checks", "bad"});
    }
    add("<ul class=\"counts\">\n");
    for (const Count& count : counts) {
      add("<li class=\"{}\"><b>{}</b> {}</li>\n",
          count.number > 0 ? count.style : "soft", count.number, count.word);
    }
    add("</ul>\n");
  }

  void write_file_table() {
    add("<h2 id=\"files\">Files</h2>\n"
        "<div class=\"scroll\" role=\"group\" aria-labelledby=\"files\" "
        "tabindex=\"0\">\n<table>\n<thead><tr><th scope=\"col\">file</th>");
    for (const std::string_view word :
         {"language", "rungs", "proved", "violated", "bounded", "vacuous",
          "unknown", "findings"}) {
      add("<th scope=\"col\">{}</th>", word);
    }
    add("</tr></thead>\n<tbody>\n");
    for (std::size_t i = 0; i < report_.files.size(); ++i) {
      const FileReport& file = report_.files[i];
      const Summary summary = summarise(file);
      add("<tr><th scope=\"row\"><a href=\"#file-{}\">{}</a></th>"
          "<td>{}{}{}</td>",
          i + 1, markup(file.path), file.language,
          file.dialect.empty() ? "" : ", ", file.dialect);
      for (const std::size_t number :
           {summary.rungs, summary.proved, summary.violated, summary.bounded,
            summary.vacuous, summary.unknown, summary.findings}) {
        add("<td>{}</td>", number);
      }
      add("</tr>\n");
    }
    add("</tbody>\n</table>\n</div>\n");
  }

  /// Links to what a reader comes for.
  void write_not_proved() {
    std::size_t count = 0;
    std::string items;
    for (std::size_t i = 0; i < report_.files.size(); ++i) {
      const FileReport& file = report_.files[i];
      for (std::size_t j = 0; j < file.results.size(); ++j) {
        const ObligationResult& result = file.results[j];
        if (result.verdict == Verdict::Proved || ++count > kMaxListed) continue;
        items += fmt::format(
            "<li><span class=\"verdict {0}\">{0}</span> "
            "<a href=\"#file-{1}-obligation-{2}\">{3}</a></li>\n",
            to_string(result.verdict), i + 1, j + 1,
            markup(result.obligation.name));
      }
    }
    if (count == 0) return;
    add("<h2>Not proved</h2>\n<ul class=\"index\">\n{}</ul>\n", items);
    if (count > kMaxListed) {
      add("<p>{} more below.</p>\n", count - kMaxListed);
    }
  }

  void write_file(std::size_t index) {
    const FileReport& file = report_.files[index];
    file_id_ = fmt::format("file-{}", index + 1);
    add("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n",
        file_id_, markup(file.path));
    for (const SelfCheckFailure& failure : file.failures) {
      add("<p class=\"bad\"><strong>self-check failed</strong>: {}: {}</p>\n",
          markup(failure.obligation), markup(failure.what));
    }
    if (!file.findings.empty()) {
      add("<h3>Findings</h3>\n");
    } else if (report_.linted) {
      add("<p>No findings.</p>\n");
    }
    for (const Diagnostic& finding : file.findings) write_finding(finding);
    used_rungs_.clear();
    if (file.run_of) {
      FileReport as_run = file;
      as_run.program = file.run_of;
      write_obligations(as_run);
      write_program(*file.run_of);
    } else {
      write_obligations(file);
      // Of `equiv` the first file's has the rungs of both.
      if (file.program && !report_.files.front().run_of) {
        write_program(*file.program);
      }
    }
    for (const std::string& note : file.notes) {
      add("<p>note: {}</p>\n", markup(note));
    }
    add("</section>\n");
  }

  void write_program(const Program& program) {
    std::sort(used_rungs_.begin(), used_rungs_.end());
    used_rungs_.erase(std::unique(used_rungs_.begin(), used_rungs_.end()),
                      used_rungs_.end());
    out_ += write_ladder(*report_.sources, program, file_id_, used_rungs_,
                         locator_);
  }

  void write_obligations(const FileReport& file) {
    if (file.results.empty()) return;
    add("<h3>Obligations</h3>\n");
    if (file.program) cones_.emplace(*file.program);
    for (std::size_t i = 0; i < file.results.size(); ++i) {
      write_obligation(file, i);
    }
    cones_.reset();
  }

  void write_finding(const Diagnostic& finding) {
    add("<article>\n<h4><span class=\"{0}\">{0}</span> {1} {2}</h4>\n"
        "<p>{3}</p>\n",
        to_string(finding.severity), finding.code, rule_name(finding),
        markup(finding.message));
    if (finding.where.has_value()) write_frame(finding);
    if (!finding.help.empty()) add("<p>help: {}</p>\n", markup(finding.help));
    add("</article>\n");
  }

  void write_frame(const Diagnostic& finding) {
    std::vector<Mark> marks = {{finding.where, {}, true}};
    for (const Label& label : finding.labels) {
      marks.push_back({label.where, label.text, false});
    }
    add("<pre tabindex=\"0\">{}</pre>\n",
        markup_lines(draw_frame(*report_.sources, marks, Ink::Frame,
                                Painter(false), locator_)));
  }

  void write_obligation(const FileReport& file, std::size_t index) {
    const ObligationResult& result = file.results[index];
    const bool has_run = result.trace && !result.trace->steps.empty();
    add("<details class=\"{0}{5}\" id=\"{1}-obligation-{2}\"{3}>\n"
        "<summary><span class=\"verdict {0}\">{0}</span> "
        "<code>{4}</code></summary>\n",
        to_string(result.verdict), file_id_, index + 1,
        result.verdict != Verdict::Proved && ++open_ <= kMaxOpen
            ? " open=\"open\""
            : "",
        markup(title_of(result.obligation)), has_run ? " has-run" : "");
    add("<p>{}</p>\n", markup(sentence(file, result)));
    write_run(file, result);
    write_explanation(file, result);
    write_evidence(result);
    add("</details>\n");
  }

  std::string sentence(const FileReport& file,
                       const ObligationResult& result) const {
    switch (result.verdict) {
      case Verdict::Proved:
      case Verdict::Violated:
        return file.program && cones_ ? explain(file, result, *cones_)
                                      : std::string(to_string(result.verdict));
      case Verdict::Bounded:
      case Verdict::Vacuous:
      case Verdict::Unknown:
        break;
    }
    return why_undecided(result);
  }

  /// The run of a violation, or the one that gets where a `reach` asks for.
  void write_run(const FileReport& file, const ObligationResult& result) {
    const bool has_run =
        file.program && cones_ && result.trace && !result.trace->steps.empty();
    if (!has_run) return;
    const auto& formulas = formulas_of(file, result.obligation);
    const std::vector<CellId> named = cones_->named(formulas);
    const std::vector<RungId> drivers = cones_->drivers(named);
    std::vector<CellId> shown = relevant_signals(*file.program, *result.trace,
                                                 cones_->of(formulas), named);
    HtmlRun run = {*report_.sources,
                   *file.program,
                   *result.trace,
                   std::move(shown),
                   drivers,
                   file_id_,
                   file.run_of ? "different here" : end_of(result),
                   result.verdict == Verdict::Violated};
    run.is_drawn = ++runs_ <= kMaxDrawnRuns;
    if (file.run_of) run.differs = named;
    out_ += write_html(run, locator_);
    const std::size_t drawn = std::min(drivers.size(), kMaxRungs);
    used_rungs_.insert(used_rungs_.end(), drivers.begin(),
                       drivers.begin() + static_cast<std::ptrdiff_t>(drawn));
  }

  /// What the run's last scan is. The end of a loop is nothing of its own.
  static std::string_view end_of(const ObligationResult& result) {
    switch (result.obligation.goal) {
      case Goal::Invariant:
        return "violated here";
      case Goal::Reach:
        return "reached here";
      case Goal::Recover:
        return "no way back from here";
      case Goal::Respond:
        break;
    }
    return {};
  }

  std::string place_of(const SourceRange& where) {
    if (!where.has_value()) return {};
    const LineColumn at = locator_.of(where).begin;
    return fmt::format(
        "{}:{}:{}: ", markup((*report_.sources)[where.file].path()), at.line,
        at.column);
  }

  /// A certificate in words.
  void write_proof(const ObligationResult& result) {
    const Certificate& proof = *result.certificate;
    const bool is_proved = result.verdict == Verdict::Proved;
    if (!proof.lemmas.empty()) {
      add("<p>{}</p>\n<ul>\n", is_proved
                                   ? "In every state that a run can reach:"
                                   : "From there on:");
      for (const std::string& lemma : proof.lemmas) {
        add("<li>{} <code class=\"soft\">{}</code></li>\n",
            markup(in_words(lemma)), markup(lemma));
      }
      add("</ul>\n");
    } else if (is_proved && result.obligation.goal == Goal::Invariant) {
      add("<p>No lemma is needed: any scan alone shows it.</p>\n");
    }
    if (proof.ways.empty()) return;
    add("<p>There lead, each line to the goal or to a line above:</p>\n<ul>\n");
    for (const std::string& way : proof.ways) {
      add("<li><code>{}</code></li>\n", markup(way));
    }
    add("</ul>\n");
  }

  void write_explanation(const FileReport& file,
                         const ObligationResult& result) {
    const Explanation* const why = explanation_of(file, result.obligation);
    if (why == nullptr || !file.program) return;
    add("<pre tabindex=\"0\">{}</pre>\n",
        markup_lines(explanation_text(file, *why, Painter(false), locator_)));
  }

  void write_evidence(const ObligationResult& result) {
    if (result.certificate) write_proof(result);
    add("<p class=\"soft\">{}by {}, {:.1f} ms",
        place_of(result.obligation.where), markup(result.engine),
        result.milliseconds);
    if (result.scans > 0) add(", {}", quantity(result.scans, "scan"));
    if (result.certificate) {
      for (const std::string& checker : result.certificate->checked_by) {
        add(", checked by {}", markup(checker));
      }
      if (!result.certificate->smtlib_path.empty()) {
        add(", certificate {}", markup(result.certificate->smtlib_path));
      }
    }
    add("</p>\n");
  }

  const Report& report_;
  Locator locator_;
  std::string file_id_;
  std::optional<Cones> cones_;
  std::vector<RungId> used_rungs_;  // of the file
  std::size_t runs_ = 0;
  std::size_t open_ = 0;
  std::string out_;
};

}  // namespace

std::string write_html(const Report& report) { return Page(report).write(); }

}  // namespace rung
