#include "reports/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/simulator.h"
#include "frontend/script/reader.h"
#include "reports/cone.h"
#include "reports/equivalence.h"
#include "reports/json.h"

namespace rung {
namespace {

Report report_of(const std::vector<Verdict>& verdicts,
                 const std::vector<Diagnostic>& findings = {}) {
  Report report;
  FileReport file;
  for (const Verdict verdict : verdicts) {
    ObligationResult result;
    result.verdict = verdict;
    file.results.push_back(result);
  }
  file.findings = findings;
  report.files.push_back(file);
  return report;
}

Diagnostic finding(std::string_view code, Severity severity) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.severity = severity;
  return diagnostic;
}

TEST(ExitStatus, IsZeroOnlyWhenAllIsProved) {
  EXPECT_EQ(exit_status(report_of({})), 0);
  EXPECT_EQ(exit_status(report_of({Verdict::Proved})), 0);
  for (const Verdict verdict :
       {Verdict::Bounded, Verdict::Vacuous, Verdict::Unknown}) {
    EXPECT_EQ(exit_status(report_of({Verdict::Proved, verdict})), 3);
  }
  EXPECT_EQ(exit_status(report_of({Verdict::Unknown, Verdict::Violated})), 1);
}

TEST(ExitStatus, CountsFindingsFromTheThreshold) {
  Report report = report_of({}, {finding("RP101", Severity::Warning)});
  EXPECT_EQ(exit_status(report), 1);
  report.fail_on = Severity::Error;
  EXPECT_EQ(exit_status(report), 0);
  report = report_of({}, {finding("RP310", Severity::Note)});
  EXPECT_EQ(exit_status(report), 0);
  report.fail_on = Severity::Note;
  EXPECT_EQ(exit_status(report), 1);
  report = report_of({}, {finding("RP101", Severity::Error)});
  report.fail_on = Severity::Error;
  EXPECT_EQ(exit_status(report), 1);
}

TEST(ExitStatus, InputErrorsAndFailedChecksComeFirst) {
  Report report =
      report_of({Verdict::Violated}, {finding("RP003", Severity::Error)});
  EXPECT_EQ(exit_status(report), 2);
  report.files[0].failures.push_back({"stop", "both sides"});
  EXPECT_EQ(exit_status(report), 4);
  // A note of a reader is no input error.
  EXPECT_EQ(exit_status(report_of({}, {finding("RP013", Severity::Note)})), 0);
}

Program read(SourceSet& sources, const std::string& text) {
  DiagnosticList errors;
  const FileId file = sources.add("m.rung", text);
  Program program =
      build_program(read_script(sources, file, "", errors), {}, errors);
  EXPECT_FALSE(errors.has_errors());
  return program;
}

std::string names(const Program& program, const std::vector<CellId>& cells) {
  std::string out;
  for (const CellId id : cells) out += program.cells[id].name + " ";
  return out;
}

TEST(Cones, FollowRungsAndSharedElements) {
  SourceSet sources;
  const Program program = read(sources,
                               "Q0 = T(0, 5, I0);\n"
                               "M0 = T(0, 5, I1);\n"
                               "Q1 = M1;\n"
                               "M1 = I2 || Q1;\n"
                               "Q2 = I3;\n");
  const Cones cones(program);
  const auto of = [&](const std::string& formula) {
    return names(program, cones.of({{formula}}));
  };
  EXPECT_EQ(of("Q0 -> true"), "Q0 I0 I1 ");
  EXPECT_EQ(of("T(0).q"), "I0 I1 ");
  EXPECT_EQ(of("!Q1"), "Q1 M1 I2 ");
  EXPECT_EQ(of("prev(Q2)"), "Q2 I3 ");
  EXPECT_EQ(of("nothing"), "");
  EXPECT_EQ(cones.drivers(cones.named({{"Q1 && Q0"}})).size(), 2U);
}

/// Two programs that differ at the end of the second scan.
EquivalenceReport different(SourceSet& sources) {
  EquivalenceReport report;
  report.sources = &sources;
  report.a.path = "a.rung";
  report.b.path = "b.rung";
  auto a = std::make_shared<Program>(read(sources, "Q0 = I0;\n"));
  auto b = std::make_shared<Program>(read(sources, "Q0 = I0 && I1;\n"));
  report.a.file = a->file;
  report.b.file = b->file;
  report.a.program = a;
  report.b.program = b;
  report.verdict = "different";
  report.outputs = {"Q0"};
  report.scans = 1;
  const Stimulus one = {{find_cell(*a, "I0")}, {{10, 1, {1}}}};
  const Stimulus two = {{find_cell(*b, "I0"), find_cell(*b, "I1")},
                        {{10, 1, {1, 0}}}};
  report.trace_a = simulate(*a, one);
  report.trace_b = simulate(*b, two);
  return report;
}

TEST(Equivalence, TextShowsBothSides) {
  SourceSet sources;
  const EquivalenceReport report = different(sources);
  EXPECT_EQ(exit_status(report), 1);
  EXPECT_EQ(write_text(report, {}),
            "different: a.rung and b.rung\n"
            "  = at the end of scan 1: a.Q0 = 1, b.Q0 = 0\n"
            "\n"
            "   scan   time |  a.I0  b.I1  a.Q0  b.Q0\n"
            "  start        |     -     -     0     0\n"
            "      1  10 ms |    1*     0    1*     0\n"
            "\n"
            "compared 1 output\n");
}

TEST(Equivalence, JsonHasTheSignalsOfBoth) {
  SourceSet sources;
  const auto json =
      nlohmann::ordered_json::parse(write_json(different(sources)));
  EXPECT_EQ(json.begin().key(), "schema");
  EXPECT_EQ(json["schema"], "rungproof.equiv/1");
  EXPECT_EQ(json["verdict"], "different");
  EXPECT_EQ(json["trace"]["steps"][0]["values"]["a.Q0"], 1);
  EXPECT_EQ(json["trace"]["steps"][0]["values"]["b.Q0"], 0);
}

TEST(Equivalence, OtherFormatsHaveOneObligation) {
  SourceSet sources;
  const Report report = as_report(different(sources));
  EXPECT_EQ(exit_status(report), 1);
  const auto json = nlohmann::ordered_json::parse(write_json(report));
  EXPECT_EQ(json["summary"]["violated"], 1);
}

TEST(Equivalence, ExitStatusIsThatOfTheVerdict) {
  EquivalenceReport report;
  report.verdict = "equivalent";
  EXPECT_EQ(exit_status(report), 0);
  report.verdict = "bounded";
  EXPECT_EQ(exit_status(report), 3);
  report.verdict = "unknown";
  EXPECT_EQ(exit_status(report), 3);
  report.verdict = "equivalent";
  report.failures.push_back({"equivalent", "both sides"});
  EXPECT_EQ(exit_status(report), 4);
}

}  // namespace
}  // namespace rung
