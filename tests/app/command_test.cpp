// The real program on small scripts. A case file holds a shell command, the
// exit status, the files it finds in its directory, and what it prints:
//
//     $ rungproof check motor.rung
//     exit 0
//     --- file motor.rung
//     --- stdout       (stderr: only where the case has such a section)
//     --- written x.json     (a file that the command leaves)
//
// Times, versions, engines, lemmas and ways are left out of the comparison.
//
// refused.txt has a command line a row that must end in exit status 2, and what
// it must say; refused inputs are in bad.txt in the same way.

#include <gtest/gtest.h>

#include <regex>

#include "tests/app/sandbox.h"
#include "tests/reports/sections.h"

namespace rung::test {
namespace {

/// What may differ from run to run, or from engine to engine.
std::string steady(std::string text) {
  static const std::vector<std::pair<std::regex, std::string>> kVariable = {
      {std::regex(R"re(("milliseconds": ?)[0-9.e+-]+)re"), "$1T"},
      {std::regex(R"re(("(z3|cadical|cvc5)": ?)"[^"]*")re"), "$1\"V\""},
      {std::regex(R"re(("engine": ?)"[^"]*")re"), "$1\"E\""},
      {std::regex(R"re(("lemmas": ?)\[[^\]]*\])re"), "$1L"},
      {std::regex(R"re(("checked_by": ?)\[[^\]]*\])re"), "$1C"},
      {std::regex(R"re( time="[0-9.]+")re"), " time=\"T\""},
      {std::regex(R"((\n    by )[^\n]*)"), "$1E, T ms"},
      {std::regex(R"re(("ways": ?)\[[^\]]*\])re"), "$1W"},
      {std::regex(R"(\n    (invariant|way): [^\n]*)"), ""},
      {std::regex(R"((, by )[^\n]*)"), "$1E"},
      {std::regex(R"((z3|cadical) [0-9a-z.]+)"), "$1 V"},
  };
  for (const auto& [pattern, text_instead] : kVariable) {
    text = std::regex_replace(text, pattern, text_instead);
  }
  return text;
}

class CommandCase : public testing::TestWithParam<std::string> {};

TEST_P(CommandCase, DoesAsRecorded) {
  GoldenFile golden = read_golden(GetParam());
  const Sandbox sandbox;
  std::string command;
  int expected = -1;
  for (const std::string& line : lines_of(golden.head)) {
    if (line.starts_with("$ ")) command = line.substr(2);
    if (line.starts_with("exit ")) expected = std::stoi(line.substr(5));
  }
  for (const auto& [name, text] : golden.sections) {
    if (name.starts_with("file ")) {
      write_text(sandbox.path() / name.substr(5), text);
    }
  }
  EXPECT_EQ(sandbox.run(command), expected) << sandbox.out() << sandbox.err();
  for (auto& [name, text] : golden.sections) {
    std::string actual;
    if (name == "stdout") {
      actual = steady(sandbox.out());
    } else if (name == "stderr") {
      actual = steady(sandbox.err());
    } else if (name.starts_with("written ")) {
      actual = steady(read_text(sandbox.path() / name.substr(8)));
    } else {
      continue;
    }
    if (!is_update()) {
      EXPECT_EQ(text, actual) << name << ": RUNG_UPDATE=1 rewrites the file";
    }
    text = actual;
  }
  if (golden.find("stderr") == nullptr) {
    EXPECT_EQ(sandbox.err(), "");
  }
  if (is_update()) write_golden(GetParam(), golden);
}

INSTANTIATE_TEST_SUITE_P(
    All, CommandCase,
    testing::ValuesIn(golden_paths(RUNG_APP_TESTS "/cases", ".case")),
    [](const auto& param) { return test_name(param.param); });

/// A row of refused.txt: the command line, `=>`, what must be said.
struct Refusal {
  std::string command;
  std::string said;
};

std::vector<Refusal> refusals() {
  std::vector<Refusal> rows;
  for (const std::string& line :
       lines_of(read_text(RUNG_APP_TESTS "/refused.txt"))) {
    const std::size_t arrow = line.find(" => ");
    if (line.empty() || line[0] == '#' || arrow == std::string::npos) continue;
    rows.push_back({line.substr(0, arrow), line.substr(arrow + 4)});
  }
  return rows;
}

TEST(Refused, EachCommandLineEndsInStatusTwoAndSaysWhy) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "good.rung", "Q0 = I0;\n");
  write_text(sandbox.path() / "other.rung", "QW0 = IW0;\n");
  write_text(sandbox.path() / "settles.rung",
             "//@ calm: settles within 2 scans\n"
             "//@ stop: always Q0 -> I0\nQ0 = I0;\n");
  write_text(sandbox.path() / "bad.rung", "Q0 = (I0;\n");
  write_text(sandbox.path() / "yun.rung", "pin3 = pin4;\n");
  write_text(sandbox.path() / "rungs.clp", "_FILES_CLASSICLADDER\n");
  write_text(sandbox.path() / "bytes.rung", std::string("\x7f"
                                                        "ELF\x02\0\xff",
                                                        7));
  write_text(sandbox.path() / "wrong.props", "always I7\n");
  write_text(sandbox.path() / "wrong.csv", "I9\n1\n");
  fs::create_directories(sandbox.path() / "empty");
  write_text(sandbox.path() / "cut.bin", "\x9eRPF\x01");
  const std::vector<Refusal> rows = refusals();
  EXPECT_GT(rows.size(), 60U);
  for (const Refusal& row : rows) {
    SCOPED_TRACE(row.command);
    EXPECT_EQ(sandbox.run(row.command), 2) << sandbox.out();
    const std::string all = sandbox.out() + sandbox.err();
    EXPECT_NE(all.find(row.said), std::string::npos) << all;
  }
}

TEST(ExitStatus, IsTheSameInEveryFormat) {
  const Sandbox sandbox;
  const fs::path dir = sandbox.path();
  write_text(dir / "0.rung", "//@ never Q0 && I1\nQ0 = (I0 || Q0) && !I1;\n");
  write_text(dir / "1.rung", "//@ always Q0\nQ0 = (I0 || Q0) && !I1;\n");
  write_text(dir / "2.rung", "Q0 = ;\n");
  write_text(dir / "3.rung",
             "//@ assume !I0\n//@ always I0 -> Q0\nQ0 = (I0 || Q0) && !I1;\n");
  for (const std::string format : {"text", "json", "jsonl", "sarif", "junit",
                                   "github", "gitlab", "html"}) {
    for (const std::string status : {"0", "1", "2", "3"}) {
      SCOPED_TRACE(format + " " + status);
      const std::string selection = status == "3" ? " --property always@2" : "";
      EXPECT_EQ(sandbox.run("rungproof prove " + status + ".rung" + selection +
                            " --format " + format),
                std::stoi(status))
          << sandbox.out() << sandbox.err();
      EXPECT_NE(sandbox.out(), "");
    }
    EXPECT_EQ(sandbox.run("rungproof prove 1.rung --inject wrong-trace "
                          "--format " +
                          format),
              4);
  }
}

/// Times apart, a report says nothing of how many worked on it.
TEST(Jobs, LeaveEveryReportAsItIs) {
  const Sandbox sandbox;
  for (int i = 0; i < 12; ++i) {
    const std::string number = std::to_string(i % 9);
    write_text(sandbox.path() / ("p" + std::to_string(i) + ".rung"),
               "//@ never Q0 && M" + number + "\nM" + number + " = I" + number +
                   " || Q0;\nQ0 = (I1 || Q0) && !I2;\nQ1 = Q1 || I3;\n");
  }
  std::string reports[2];
  for (const int jobs : {1, 5}) {
    std::string formats;
    for (const std::string format :
         {"json", "jsonl", "sarif", "junit", "github", "gitlab", "html"}) {
      formats += " --format " + format + ":" + format;
    }
    EXPECT_EQ(sandbox.run("rungproof check . --jobs " + std::to_string(jobs) +
                          formats),
              1);
    std::string& all = reports[jobs == 1 ? 0 : 1];
    all = sandbox.out();
    for (const char* format :
         {"json", "jsonl", "sarif", "junit", "github", "gitlab", "html"}) {
      all += read_text(sandbox.path() / format);
    }
  }
  EXPECT_GT(reports[0].size(), 10'000U);
  for (std::string& report : reports) {
    static const std::regex kTime("[0-9.]+ ms");  // of the page
    report = std::regex_replace(steady(report), kTime, "T ms");
  }
  EXPECT_TRUE(reports[0] == reports[1]);
}

TEST(Lower, LeavesNoFileBehindWhenItRefuses) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "bad.rung", "Q0 = ;\n");
  EXPECT_EQ(sandbox.run("rungproof lower bad.rung --to postfix -o out.pf"), 2);
  EXPECT_FALSE(fs::exists(sandbox.path() / "out.pf"));
}

TEST(Output, LeavesNoTemporaryFiles) {
  const Sandbox sandbox;
  write_text(sandbox.path() / "a.rung", "Q0 = I0;\n");
  EXPECT_EQ(sandbox.run("rungproof check a.rung --format json:a.json "
                        "--format sarif:a.sarif"),
            0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(sandbox.path())) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{".stderr", ".stdout", "a.json",
                                             "a.rung", "a.sarif"}));
}

}  // namespace
}  // namespace rung::test
