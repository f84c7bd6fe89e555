// Structured text and instruction lists of others, beside the repository and
// no part of it: what is read, why the rest is refused, and pairs that mean the
// same.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "frontend/recognise.h"
#include "smt/equivalence.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = RUNG_SOURCE_DIR "/../shared/corpus";

std::string text_of(const fs::path& path) {
  const std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// `text` with each `from` replaced; the test fails where there is none.
std::string replaced(std::string text, const std::string& from,
                     const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;
       at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

struct Read {
  Read(std::string text, std::string_view language, std::string_view pou = {},
       std::string_view semantics = "iec")
      : file(sources.add("text", std::move(text))) {
    ReadOptions options;
    options.pou = pou;
    options.semantics = find_semantics(semantics);
    const Ast ast = find_language(language)->read(sources, file, options, list);
    if (!list.has_errors()) program = build_program(ast, {}, list);
  }
  std::string problems() const {
    std::string result;
    for (const Diagnostic& item : list.items()) {
      if (item.severity == Severity::Error) result += item.message + "\n";
    }
    return result;
  }

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Program program;
};

std::vector<fs::path> texts_under(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".st") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The reason without what is particular to the file.
std::string reason_of(const std::string& problem) {
  for (const std::string_view reason :
       {"`WHILE` is not supported", "a scan that enters it never ends",
        "programs: name one of the units",
        "the type `HMI_BOOL` of this variable",
        "the type `VAR_EXTERNAL` of this variable", "`__TRY` is not supported",
        "REAL is not supported",
        "expected PROGRAM, FUNCTION_BLOCK, FUNCTION or CONFIGURATION"}) {
    if (problem.find(reason) != std::string::npos) return std::string(reason);
  }
  return problem;
}

TEST(IecCorpus, StructuredTextIsReadOrRefusedForAReason) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  std::map<std::string, int> counts;
  for (const fs::path& path : texts_under(kCorpus / "plcopen_ld")) {
    const std::string text = text_of(path);
    EXPECT_EQ(recognise(text).name, "st") << path;
    for (const std::string_view preset :
         {"iec", "openplc", "beremiz-py2", "esbmc"}) {
      const Read read(text, "st", {}, preset);
      ++counts[read.problems().empty() ? "read" : reason_of(read.problems())];
    }
  }
  for (auto& [reason, count] : counts) {
    EXPECT_EQ(count % 4, 0) << reason;
    count /= 4;
  }
  const std::map<std::string, int> expected = {
      {"read", 29},
      // Loops without a bound: the bombs of the data set, and what they
      // replace.
      {"a scan that enters it never ends", 24},
      {"`WHILE` is not supported", 6},
      // Three programs a file: each is read below.
      {"programs: name one of the units", 21},
      // Debug lines of C, of which `(void *)` ends the comment.
      {"expected PROGRAM, FUNCTION_BLOCK, FUNCTION or CONFIGURATION", 3},
      // A sequential function chart behind blocks of a web interface.
      {"the type `HMI_BOOL` of this variable", 2},
      {"the type `VAR_EXTERNAL` of this variable", 1},
  };
  EXPECT_EQ(counts, expected);
}

TEST(IecCorpus, EveryProgramOfTheWaterPlantIsRead) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  std::map<std::string, int> counts;
  for (const fs::path& path : texts_under(kCorpus / "plcopen_ld/swat")) {
    for (const std::string_view pou : {"PLC1", "PLC2", "PLC3"}) {
      const Read read(text_of(path), "st", pou, "openplc");
      const std::string key = read.problems().empty()
                                  ? std::string("read")
                                  : reason_of(read.problems());
      ++counts[key];
    }
  }
  const std::map<std::string, int> expected = {
      {"read", 47},
      {"a scan that enters it never ends", 7},
      {"`__TRY` is not supported", 8},
      {"REAL is not supported", 1},
      {"expected PROGRAM, FUNCTION_BLOCK, FUNCTION or CONFIGURATION", 9},
  };
  EXPECT_EQ(counts, expected);
}

// --- Annex F of the standard, in both languages ------------------------------

void expect_equivalent(const Read& list, const Read& text) {
  ASSERT_EQ(list.problems(), "");
  ASSERT_EQ(text.problems(), "");
  const EquivalenceResult result =
      check_equivalence(list.program, text.program, {});
  EXPECT_EQ(result.verdict, EquivalenceVerdict::Equivalent)
      << result.reason << " " << result.differs;
}

TEST(IecCorpus, WeighIsTheSameInBothLanguages) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  const fs::path folder = kCorpus / "il_iec/annexf";
  const std::string list = text_of(folder / "weigh_il.txt");
  EXPECT_EQ(recognise(list).name, "il-iec");
  expect_equivalent(Read(list, "il-iec"),
                    Read(text_of(folder / "weigh_st.txt"), "st"));
}

// The files lack CMD_MONITOR, so here is a block with its pins; the presets of
// its timer are the callers', which give constants.
constexpr std::string_view kMonitor = R"(
FUNCTION_BLOCK CMD_MONITOR
  VAR_INPUT AUTO_CMD, AUTO_MODE, MAN_CMD, MAN_CMD_CHK : BOOL; T_CMD_MAX : TIME;
    FDBK, ACK : BOOL; END_VAR
  VAR_OUTPUT CMD, ALRM : BOOL; END_VAR
  VAR CMD_TMR : TON; ALRM_FF : SR; END_VAR
  CMD := AUTO_CMD AND AUTO_MODE OR MAN_CMD AND NOT MAN_CMD_CHK AND NOT AUTO_MODE;
  CMD_TMR(IN := CMD, PT := T_CMD_MAX);
  ALRM_FF(S1 := CMD_TMR.Q AND NOT FDBK, R := ACK);
  ALRM := ALRM_FF.Q1;
END_FUNCTION_BLOCK
)";

TEST(IecCorpus, ForwardReverseMonitorIsTheSameInBothLanguages) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  const fs::path folder = kCorpus / "il_iec/annexf";
  const auto whole = [&](const std::string& name) {
    // Inputs of the program are no constants; in real use these two are.
    std::string text = text_of(folder / name);
    text = replaced(text, "T_FWD_MAX : TIME ;", "");
    text = replaced(text, "T_REV_MAX : TIME ;", "");
    text = replaced(text, "VAR FWD_MON",
                    "VAR CONSTANT T_FWD_MAX : TIME := T#3s; T_REV_MAX : TIME "
                    ":= T#4s; END_VAR VAR "
                    "FWD_MON");
    return std::string(kMonitor) + text;
  };
  const std::string list = whole("fwd_rev_mon_il.txt");
  EXPECT_NE(Read(list, "il-iec", "FWD_REV_MON")
                .problems()
                .find("a SR has no `Q`: it has S1 R Q1"),
            std::string::npos);
  expect_equivalent(Read(replaced(list, "FWD_REV_FF.Q", "FWD_REV_FF.Q1"),
                         "il-iec", "FWD_REV_MON"),
                    Read(whole("fwd_rev_mon_st.txt"), "st", "FWD_REV_MON"));
}

// --- the rest of the lists ---------------------------------------------------

TEST(IecCorpus, ListsAreRefusedWithTheReason) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"annexf/fwd_rev_mon_il.txt", "the type `CMD_MONITOR` of this variable"},
      {"il_parser/test1.il", "`S` needs a variable"},
      {"matiec_syntax/identifier_as_label.test", "an include is not supported"},
      {"matiec_syntax/identifier_as_variable2.test",
       "an include is not supported"},
      {"verifaps/p180_iec61131.il", "`S8` is not declared"},
      {"verifaps/p223.il", "`C10` is not declared"},
  };
  for (const auto& [name, problem] : files) {
    const Read read(text_of(kCorpus / "il_iec" / name), "il-iec");
    EXPECT_NE(read.problems().find(problem), std::string::npos)
        << name << "\n"
        << read.problems();
  }
}

TEST(IecCorpus, ALabelMayHaveAnyName) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  std::string text =
      text_of(kCorpus / "il_iec/matiec_syntax/identifier_as_label.test");
  text = replaced(text, "{#include \"basic_code.test\" }", "");
  // `R e` has no current result at the begin, and the first jump goes back.
  text = replaced(text, "XXXX: R e\n  JMP XXXX", "XXXX: LD e\n  R e");
  text = replaced(text, "XXXX: R e", "XXXX: LD e\n R e");
  for (const char* name : {"PRIORITY", "SD", "n", "INTERVAL"}) {
    for (const std::string_view pou : {"foo", "bar"}) {
      EXPECT_EQ(Read(replaced(text, "XXXX", name), "il-iec", pou).problems(),
                "")
          << name;
    }
  }
}

TEST(IecCorpus, AVariableMayHaveAnyName) {
  if (!fs::exists(kCorpus)) GTEST_SKIP() << "no " << kCorpus;
  const std::string text = replaced(
      text_of(kCorpus / "il_iec/matiec_syntax/identifier_as_variable2.test"),
      "{#include \"basic_code.test\" }", "");
  const std::vector<std::pair<std::string_view, std::string_view>> units = {
      {"foo_fb", ""},
      {"foo_f1", ""},
      {"bar01", "an input"},  // writes one, as a program it may not
      {"bar91", ""},
      {"bar92", "NOT"},  // `NOT XXXX` has no operand in the standard
      {"bar93", "INT"},
      {"bar96", "there is no current result"},
  };
  for (const char* name : {"PRIORITY", "SD", "D", "INTERVAL"}) {
    const std::string here = replaced(text, "XXXX", name);
    for (const auto& [pou, problem] : units) {
      const std::string problems = Read(here, "il-iec", pou).problems();
      EXPECT_EQ(problems.empty(), problem.empty()) << pou << " " << problems;
    }
  }
}

}  // namespace
}  // namespace rung
