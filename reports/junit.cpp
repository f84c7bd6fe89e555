#include "reports/junit.h"

#include <fmt/format.h>

#include <optional>

#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/locate.h"
#include "reports/markup.h"
#include "reports/paint.h"
#include "reports/paths.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

/// Text for XML 1.0: it has no way to write most control characters.
std::string xml(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (const std::string_view entity = entity_of(c); !entity.empty()) {
      out += entity;
    } else if (c == '\n' || c == '\r' || c == '\t') {
      out += fmt::format("&#{};", byte);
    } else if (byte < 0x20) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out;
}

struct Case {
  std::string name;
  std::string classname;
  double milliseconds = 0;
  std::string file;
  std::uint32_t line = 1;
  std::string_view element;  // "failure", "error", "skipped", "system-out"
  std::string type;
  std::string message;
  std::string body;
};

struct Suite {
  std::string name;
  std::vector<Case> cases;
};

std::size_t count(const Suite& suite, std::string_view element) {
  std::size_t found = 0;
  for (const Case& one : suite.cases) found += one.element == element ? 1 : 0;
  return found;
}

double time_of(const Suite& suite) {
  double time = 0;
  for (const Case& one : suite.cases) time += one.milliseconds;
  return time;
}

std::string seconds(double milliseconds) {
  return fmt::format("{:.6f}", milliseconds / 1000.0);
}

class SuiteBuilder {
 public:
  SuiteBuilder(const Report& report, const FileReport& file, Locator& locator)
      : report_(report), file_(file), locator_(locator) {
    suite_.name = relative_path(file.path, report.working_directory);
  }

  Suite build() {
    for (const Diagnostic& finding : file_.findings) add_finding(finding);
    for (const Diagnostic& finding : file_.waived) add_waived(finding);
    if (report_.linted && file_.program && file_.findings.empty()) {
      suite_.cases.push_back(start("no findings", "lint", {}));
    }
    std::optional<Cones> cones;
    if (file_.program) cones.emplace(*file_.program);
    for (const ObligationResult& result : file_.results) {
      add_result(result, cones);
    }
    for (const SelfCheckFailure& failure : file_.failures) {
      Case one = start(failure.obligation, "self-check", {});
      one.element = "error";
      one.type = "self-check";
      one.message = failure.what;
      suite_.cases.push_back(std::move(one));
    }
    return std::move(suite_);
  }

 private:
  Case start(std::string name, std::string_view kind,
             const SourceRange& where) {
    Case one;
    one.name = std::move(name);
    one.classname = fmt::format("{}.{}", kind, suite_.name);
    one.file = suite_.name;
    if (where.has_value()) {
      one.line = locator_.of(where).begin.line;
      one.file = relative_path((*report_.sources)[where.file].path(),
                               report_.working_directory);
    }
    return one;
  }

  Case start(const Diagnostic& finding) {
    const bool input = is_input_error(finding);
    Case one = start("", input ? "input" : "lint", finding.where);
    one.name = fmt::format("{} {} line {}", finding.code, rule_name(finding),
                           one.line);
    return one;
  }

  /// What somebody has allowed, with the reason, is not run.
  void add_waived(const Diagnostic& finding) {
    Case one = start(finding);
    const bool in_source = finding.waiver->kind == Waiver::Kind::InSource;
    one.element = "skipped";
    one.type = in_source ? "allowed" : "baseline";
    one.message = finding.message;
    one.body = finding.waiver->reason;
    suite_.cases.push_back(std::move(one));
  }

  void add_finding(const Diagnostic& finding) {
    Case one = start(finding);
    const Severity fail_on = fail_on_of(report_, file_);
    one.element = is_input_error(finding)       ? "error"
                  : finding.severity >= fail_on ? "failure"
                                                : "system-out";
    one.type = std::string(to_string(finding.severity));
    one.message = finding.message;
    one.body = finding.help;
    suite_.cases.push_back(std::move(one));
  }

  void add_result(const ObligationResult& result,
                  const std::optional<Cones>& cones) {
    Case one =
        start(result.obligation.name, "property", result.obligation.where);
    one.milliseconds = result.milliseconds;
    if (result.verdict != Verdict::Proved) {
      one.element = "failure";
      one.type = std::string(to_string(result.verdict));
      one.message =
          result.obligation.text + ": " +
          (cones ? explain(file_, result, *cones) : verdict_phrase(result));
      if (cones && result.trace) {
        const auto& formulas = formulas_of(file_, result.obligation);
        const auto shown =
            relevant_signals(*file_.program, *result.trace, cones->of(formulas),
                             cones->named(formulas));
        one.body = draw_scan_table({*file_.program, *result.trace, shown, ""},
                                   Painter(false));
      }
    }
    suite_.cases.push_back(std::move(one));
  }

  const Report& report_;
  const FileReport& file_;
  Locator& locator_;
  Suite suite_;
};

/// Line ends may stay as they are between tags.
std::string xml_body(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += xml(text.substr(at, end - at));
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

void write_case(const Case& one, std::string& out) {
  out += fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" time=\"{}\" file=\"{}\" "
      "line=\"{}\"",
      xml(one.classname), xml(one.name), seconds(one.milliseconds),
      xml(one.file), one.line);
  if (one.element.empty()) {
    out += "/>\n";
  } else if (one.element == "system-out") {
    out += fmt::format(
        ">\n      <system-out>{}: {}</system-out>\n"
        "    </testcase>\n",
        one.type, xml(one.message));
  } else {
    out += fmt::format(
        ">\n      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n"
        "    </testcase>\n",
        one.element, one.type, xml(one.message), xml_body(one.body));
  }
}

}  // namespace

std::string write_junit(const Report& report) {
  Locator locator(*report.sources);
  std::vector<Suite> suites;
  Suite all;
  for (const FileReport& file : report.files) {
    suites.push_back(SuiteBuilder(report, file, locator).build());
    for (const Case& one : suites.back().cases) all.cases.push_back(one);
  }
  const auto attributes = [](const Suite& suite) {
    return fmt::format(
        "tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{}\"",
        suite.cases.size(), count(suite, "failure"), count(suite, "error"),
        count(suite, "skipped"), seconds(time_of(suite)));
  };
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format("<testsuites name=\"rungproof {}\" {}>\n", report.command,
                     attributes(all));
  for (const Suite& suite : suites) {
    out += fmt::format("  <testsuite name=\"{}\" {}>\n", xml(suite.name),
                       attributes(suite));
    for (const Case& one : suite.cases) write_case(one, out);
    out += "  </testsuite>\n";
  }
  out += "</testsuites>\n";
  return out;
}

}  // namespace rung
