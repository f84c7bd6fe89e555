// Reports as they are recorded. A golden file holds a program, what the
// analysis is to have found in it, and the report in one or more formats:
//
//     finding CODE RULE SEVERITY /TEXT/ MESSAGE     TEXT: where, first match
//     label /TEXT/ MESSAGE                          of the last finding
//     help MESSAGE
//     allowed REASON / baselined                    the last finding is waived
//     violated NAME ENGINE STEP; STEP ...           a STEP: 100 x3 I0=1 I1=0
//     proved NAME ENGINE LEMMA; LEMMA ...           of reach: steps
//     bounded NAME ENGINE SCANS
//     unknown NAME ENGINE REASON                    vacuous alike
//     note TEXT / failure NAME WHAT / self-check off / fail-on SEVERITY
//     command lint
//     path PATH
//     --- source            (or `--- escaped`: \t \r \n \\ \xHH are bytes)
//     --- text, verbose, quiet, colour, json, jsonl, sarif, junit, github,
//         gitlab, html (without style and script)
//
// Traces are real runs of the program: the simulator computes their values.

#include <gtest/gtest.h>

#include <charconv>
#include <deque>
#include <sstream>

#include "analysis/simulator.h"
#include "frontend/script/reader.h"
#include "reports/github.h"
#include "reports/gitlab.h"
#include "reports/html/page.h"
#include "reports/json.h"
#include "reports/junit.h"
#include "reports/sarif.h"
#include "reports/text.h"
#include "tests/reports/page_check.h"
#include "tests/reports/sections.h"

namespace rung::test {
namespace {

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      if (text[i] != '\n') out += text[i];
      continue;
    }
    switch (text[++i]) {
      case 't':
        out += '\t';
        break;
      case 'r':
        out += '\r';
        break;
      case 'n':
        out += '\n';
        break;
      case 'x': {
        unsigned byte = 0;
        std::from_chars(&text[i + 1], &text[i + 3], byte, 16);
        out += static_cast<char>(byte);
        i += 2;
        break;
      }
      default:
        out += text[i];
    }
  }
  return out;
}

/// Words of a directive, and what is left of its line.
class Line {
 public:
  explicit Line(std::string text) : text_(std::move(text)) {}

  std::string word() {
    const std::size_t end = std::min(text_.find(' '), text_.size());
    std::string out = text_.substr(0, end);
    text_.erase(0, std::min(end + 1, text_.size()));
    return out;
  }
  /// `/TEXT/`
  std::string needle() {
    const std::size_t end = text_.find('/', 1);
    std::string out = text_.substr(1, end - 1);
    text_.erase(0, std::min(end + 2, text_.size()));
    return out;
  }
  const std::string& rest() const { return text_; }

 private:
  std::string text_;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    part.erase(0, std::min(part.find_first_not_of(' '), part.size()));
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

class Scene {
 public:
  explicit Scene(const GoldenFile& golden) {
    const std::string* source = golden.find("source");
    const std::string* escaped = golden.find("escaped");
    const std::string text = source != nullptr ? *source : unescaped(*escaped);
    std::string path = "motor.rung";
    for (const std::string& line : lines_of(golden.head)) {
      if (line.starts_with("path ")) path = unescaped(line.substr(5));
    }
    file_.file = sources_.add(path, text);
    file_.path = path;
    build();
    for (const std::string& line : lines_of(golden.head)) {
      if (!line.starts_with("#")) apply(Line(line));
    }
    finish();
  }

  const Report& report() const { return report_; }

 private:
  void build() {
    DiagnosticList errors;
    const Ast ast = read_script(sources_, file_.file, "", errors);
    auto program = std::make_shared<Program>(build_program(ast, {}, errors));
    file_.properties = read_properties(*program, {}, sources_, errors);
    file_.language = "script";
    file_.dialect = ast.dialect;
    file_.semantics = ast.dialect;
    if (errors.has_errors()) {
      read_errors_ = errors.items().front().message;
      return;
    }
    program_ = program;
    file_.program = program;
    TransitionSystem ts = build_transition_system(*program);
    obligations_ = make_obligations(*program, file_.properties, ts);
  }

  SourceRange find(const std::string& needle) const {
    const std::string_view text = sources_[file_.file].text();
    const std::string bytes = unescaped(needle);
    const std::size_t at = text.find(bytes);
    EXPECT_NE(at, std::string_view::npos) << needle;
    const auto begin = static_cast<std::uint32_t>(at);
    return {file_.file, begin,
            begin + static_cast<std::uint32_t>(bytes.size())};
  }

  std::string_view keep(std::string text) {
    return texts_.emplace_back(std::move(text));
  }

  void apply(Line line) {
    const std::string word = line.word();
    if (word == "finding") {
      Diagnostic finding;
      finding.code = keep(line.word());
      const std::string rule = line.word();
      if (rule != "-") finding.rule = keep(rule);
      const std::string severity = line.word();
      finding.severity = severity == "error"  ? Severity::Error
                         : severity == "note" ? Severity::Note
                                              : Severity::Warning;
      finding.where = find(line.needle());
      finding.message = unescaped(line.rest());
      file_.findings.push_back(std::move(finding));
    } else if (word == "label") {
      const SourceRange where = find(line.needle());
      file_.findings.back().labels.push_back({where, line.rest()});
    } else if (word == "help") {
      file_.findings.back().help = line.rest();
    } else if (word == "allowed" || word == "baselined") {
      Diagnostic finding = file_.findings.back();
      file_.findings.pop_back();
      const bool in_source = word == "allowed";
      finding.waiver = {
          in_source ? Waiver::Kind::InSource : Waiver::Kind::Baseline,
          in_source ? unescaped(line.rest()) : "in the baseline"};
      file_.compared = file_.compared || !in_source;
      file_.waived.push_back(std::move(finding));
    } else if (word == "note") {
      file_.notes.push_back(line.rest());
    } else if (word == "failure") {
      const std::string name = line.word();
      file_.failures.push_back({name, line.rest()});
    } else if (word == "self-check") {
      report_.self_check = false;
    } else if (word == "fail-on") {
      report_.fail_on =
          line.rest() == "error" ? Severity::Error : Severity::Note;
    } else if (word == "command") {
      report_.command = keep(line.rest());
      report_.proved = line.rest() != "lint";
      report_.linted = line.rest() != "prove";
    } else if (!word.empty() && word != "path") {
      result(word, line);
    }
  }

  void result(const std::string& verdict, Line& line) {
    ObligationResult result;
    const std::string name = line.word();
    bool found = false;
    for (const Obligation& obligation : obligations_) {
      if (obligation.name != name) continue;
      result.obligation = obligation;
      found = true;
    }
    ASSERT_TRUE(found) << name << ": " << read_errors_;
    result.engine = line.word();
    result.milliseconds = 1.25;
    if (verdict == "violated") {
      result.verdict = Verdict::Violated;
      set_trace(line.rest(), result);
    } else if (verdict == "proved") {
      result.verdict = Verdict::Proved;
      if (result.obligation.goal == Goal::Reach) {
        set_trace(line.rest(), result);
      } else {
        result.certificate = {split(line.rest(), ';'), {"z3 4.8.12"}, ""};
      }
    } else if (verdict == "bounded") {
      result.verdict = Verdict::Bounded;
      result.scans = std::stoull(line.rest());
    } else {
      result.verdict =
          verdict == "vacuous" ? Verdict::Vacuous : Verdict::Unknown;
      result.reason = line.rest();
    }
    file_.results.push_back(std::move(result));
  }

  /// `100 x3 I0=1 I1=0; ...`: inputs keep their value from step to step.
  void set_trace(const std::string& text, ObligationResult& result) {
    if (text.empty()) return;
    Stimulus stimulus;
    std::vector<std::int64_t> inputs;
    for (const CellId id : ids_of(program_->cells)) {
      if (program_->cells[id].role != CellRole::Input) continue;
      stimulus.inputs.push_back(id);
      inputs.push_back(0);
    }
    for (const std::string& step : split(text, ';')) {
      StimulusStep out;
      for (const std::string& part : split(step, ' ')) {
        const std::size_t equals = part.find('=');
        if (part[0] == 'x') {
          out.repeat = std::stoull(part.substr(1));
        } else if (equals == std::string::npos) {
          out.dt_ms = std::stoll(part);
        } else {
          for (std::size_t i = 0; i < inputs.size(); ++i) {
            const Cell& cell = program_->cells[stimulus.inputs[i]];
            if (cell.name == part.substr(0, equals)) {
              inputs[i] = std::stoll(part.substr(equals + 1));
            }
          }
        }
      }
      out.inputs = inputs;
      stimulus.steps.push_back(std::move(out));
    }
    result.trace = simulate(*program_, stimulus);
    result.scans = result.trace->steps.back().scan;
  }

  void finish() {
    report_.sources = &sources_;
    if (report_.command.empty()) report_.command = "check";
    report_.version = "0.0.0";
    report_.solvers = {{"z3", "4.8.12"}};
    report_.working_directory = "/home/user";
    report_.files.push_back(file_);
  }

  SourceSet sources_;
  std::deque<std::string> texts_;
  std::shared_ptr<Program> program_;
  std::vector<Obligation> obligations_;
  FileReport file_;
  Report report_;
  std::string read_errors_;
};

void erase_between(const std::string& begin, const std::string& end,
                   std::string& page) {
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    const std::size_t to = page.find(end, at);
    if (to != std::string::npos) page.erase(at, to - at);
  }
}

/// Style and script are the same on every page: a golden file has what differs.
std::string without_assets(std::string page) {
  erase_between("<style>", "</style>", page);
  erase_between("<script>", "</script>", page);
  erase_between("&#39;sha256-", "&#39;", page);
  return page;
}

std::string render(const Report& report, const std::string& format) {
  using Detail = TextOptions::Detail;
  if (format == "text") return write_text(report, {Detail::Normal, false});
  if (format == "verbose") return write_text(report, {Detail::Verbose, false});
  if (format == "quiet") return write_text(report, {Detail::Quiet, false});
  if (format == "json") return write_json(report);
  if (format == "jsonl") return write_jsonl(report);
  if (format == "sarif") return write_sarif(report);
  if (format == "junit") return write_junit(report);
  if (format == "github") return write_github(report);
  if (format == "gitlab") return write_gitlab(report);
  if (format == "html") return without_assets(write_html(report));
  if (format == "exit") return std::to_string(exit_status(report)) + "\n";
  return "";
}

class ReportGolden : public testing::TestWithParam<std::string> {};

TEST_P(ReportGolden, IsAsRecorded) {
  GoldenFile golden = read_golden(GetParam());
  const Scene scene(golden);
  bool has_output = false;
  for (const auto& [format, expected] : golden.sections) {
    if (format == "source" || format == "escaped") continue;
    const std::string actual = render(scene.report(), format);
    ASSERT_FALSE(actual.empty() && format != "quiet") << format;
    has_output = true;
    if (!is_update()) {
      EXPECT_EQ(expected, actual) << "RUNG_UPDATE=1 rewrites the file";
    }
  }
  EXPECT_TRUE(has_output);
  if (!is_update()) return;
  for (auto& [format, text] : golden.sections) {
    if (format == "source" || format == "escaped") continue;
    text = render(scene.report(), format);
  }
  write_golden(GetParam(), golden);
}

TEST_P(ReportGolden, IsAPageThatLoadsNothing) {
  const Scene scene(read_golden(GetParam()));
  const std::string page = write_html(scene.report());
  EXPECT_EQ(problems_of(page), "") << page;
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n"));
  EXPECT_NE(page.find("content=\"default-src &#39;none&#39;"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All, ReportGolden,
    testing::ValuesIn(golden_paths(RUNG_GOLDEN_DIR, ".report")),
    [](const auto& param) { return test_name(param.param); });

}  // namespace
}  // namespace rung::test
