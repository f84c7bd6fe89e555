// Statement lists of others, beside the repository and no part of it: each is
// read whole and its checks hold, or it is refused for a reason that is right.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/simulator.h"
#include "confirm.h"
#include "frontend/stl/reader.h"
#include "smt/verify.h"

namespace rung {
namespace {

const std::string kRoot = RUNG_SOURCE_DIR "/../shared/corpus/stl_siemens/";

std::string text_of(const std::string& name) {
  const std::ifstream in(kRoot + name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Listing {
  explicit Listing(const std::string& text)
      : file(sources.add("list.awl", text)),
        ast(read_stl(sources, file, list)) {
    if (!list.has_errors()) program = build_program(ast, {}, list);
  }

  SourceSet sources;
  DiagnosticList list;
  FileId file;
  Ast ast;
  Program program;
};

/// How many checks there are, and in how many scans one of them is broken.
struct Checks {
  std::size_t count = 0;
  std::size_t broken = 0;
};

Checks simulated(const Program& program) {
  Checks checks;
  Simulator simulator(program);
  for (int scan = 0; scan < 3; ++scan) {
    simulator.scan(10);
    checks.count = 0;
    for (const CellId id : ids_of(program.cells)) {
      const std::string& name = program.cells[id].name;
      if (!name.starts_with("assert.") && !name.starts_with("digits.")) {
        continue;
      }
      ++checks.count;
      if (simulator.value(id) == 0) ++checks.broken;
    }
  }
  return checks;
}

/// What a refused list needs and the reader does not have, by what the
/// reader's errors say: Addresses that are computed, other Blocks, Data blocks,
/// the Images of inputs, Loops, Parameters, Real numbers, System functions, a
/// Timer in two ways, not UTF-8, Words, XML (docs/languages/stl.md).
struct Class {
  char letter;
  std::vector<std::string_view> parts;  // of the message
};
// The first that fits.
const std::vector<Class> kClasses = {
    {'U', {"is not UTF-8"}},
    {'X', {"this is XML"}},
    {'S', {"SFC", "SFB", "`__"}},
    {'A', {"AR1", "AR2", "`P#", "[L", "[M", "`TAR", "`LAR"}},
    {'D',
     {"`DATA_BLOCK`", "`FUNCTION_BLOCK`", "`TYPE`", "`DB", "`DI", "`AUF`",
      "`#DB", "`TDB`"}},
    {'D', {"`CALL` has"}},
    {'A', {"operands, and here"}},
    {'P',
     {"`VAR_", "a function with a value", "is called nowhere", "a call of",
      "is a symbol", "counters only"}},
    {'B', {"OB ", "above `BEGIN`", "two blocks", "expected a block"}},
    {'R',
     {"R` is no inst", "`TRUNC`", "`RND", "`SQR", "`SIN", "`COS", "`TAN",
      "`ASIN", "`ACOS", "`ATAN", "`LN`", "`EXP`", "`ABS`"}},
    {'L', {"`LOOP`", "`SPL`"}},
    {'T', {"this timer is started"}},
    {'I', {"`PE", "`PA", "`E", "the image of inputs"}},
    {'W',
     {"is no instruction", "an accumulator has", "status word", "`STW`", "`DW#",
      "is no bit", "cannot be loaded", "byte or word", "no timer", "local data",
      "`T0`"}},
};

std::string classes_of(const std::vector<std::string>& errors) {
  std::set<char> letters;
  for (const std::string& error : errors) {
    char letter = '?';
    for (const Class& one : kClasses) {
      const bool fits = std::any_of(
          one.parts.begin(), one.parts.end(), [&](std::string_view part) {
            return error.find(part) != std::string::npos;
          });
      if (fits && letter == '?') letter = one.letter;
    }
    letters.insert(letter);
  }
  return {letters.begin(), letters.end()};
}

struct Row {
  std::string_view file;
  int checks;               // -1: refused
  std::string_view reason;  // a part of one of its errors
  std::string_view classes;
};

const std::vector<Row> kRows = {
    {"tc000_base__headers.awl", -1, "`VAR_INPUT` is not supported", "BDP"},
    {"tc000_base__latin1.awl", -1, "is not UTF-8", "U"},
    {"tc000_base__minimal.awl", 0, "", ""},
    {"tc100_instructions__insn_ARITH_D.awl", -1, "`/D` is no", "W"},
    {"tc100_instructions__insn_ARITH_PL.awl", -1, "`+` is no", "W"},
    {"tc100_instructions__insn_BCD.awl", -1, "`DTB` is no", "W"},
    {"tc100_instructions__insn_BOOL.awl", 549, "", ""},
    {"tc100_instructions__insn_CMP.awl", -1, "`==R` is no", "RW"},
    {"tc100_instructions__insn_JUMP.awl", -1, "`LOOP` is no", "LW"},
    {"tc100_instructions__insn_MISC.awl", -1, "`LAR1` is no", "ADISW"},
    {"tc100_instructions__insn_SA.awl", -1, "this timer is started in two",
     "DT"},
    {"tc100_instructions__insn_SHIFT.awl", -1, "`SSI` is no", "W"},
    {"tc100_instructions__insn_TAK.awl", 4, "", ""},
    {"tc100_instructions__insn_WORD.awl", -1, "`UW` is no", "W"},
    {"tc100_instructions__insn_Z.awl", -1, "`DATA_BLOCK` is not", "D"},
    {"tc150_startup__ob_startup_info.awl", -1, "`VAR_INPUT` is", "APSW"},
    {"tc150_startup__startup_OB100.awl", -1, "`__FEATURE` is no", "S"},
    {"tc200_datatypes__DB.awl", -1, "`DATA_BLOCK` is not", "DPSW"},
    {"tc200_datatypes__anypointer.awl", -1, "`DATA_BLOCK` is", "DP"},
    {"tc200_datatypes__pointer.awl", -1, "`LAR1` is no", "ADPSW"},
    {"tc200_datatypes__struct.awl", -1, "`DATA_BLOCK` is not", "ADP"},
    {"tc300_cpu__big-blocknum.awl", -1, "`DATA_BLOCK` is not", "DP"},
    {"tc400_convenience__convenience_de.awl", -1, "`AUF` is no", "ADIW"},
    {"tc500_systemblocks__sfb__basic.awl", -1, "`DATA_BLOCK` is", "D"},
    {"tc500_systemblocks__sfb__sfb2.awl", -1, "`DATA_BLOCK` is", "D"},
    {"tc500_systemblocks__sfb__sfb3.awl", -1, "`DATA_BLOCK` is", "DSW"},
    {"tc500_systemblocks__sfb__sfb5.awl", -1, "`DATA_BLOCK` is", "DSW"},
    {"tc500_systemblocks__sfc__sfc47.awl", -1, "a call of `SFC47(", "SW"},
    {"tc500_systemblocks__sfc__sfc64.awl", -1, "a call of `SFC64(", "SW"},
    {"tc550_library__iec__fc12_ge_dt.awl", -1, "`DATA_BLOCK` is", "ADP"},
    {"tc550_library__iec__fc4_delete.awl", -1, "`VAR_INPUT` is", "BDP"},
    {"tc550_library__iec__fc9_eq_dt.awl", -1, "`DATA_BLOCK` is", "ADPW"},
    {"tc600_fup__fup-compare.awlpro", -1, "this is XML", "X"},
    {"tc600_fup__fup-inlineawl.awlpro", -1, "this is XML", "X"},
    {"tc700_hardware__pyprofibus__pyprofibus.awl", -1, "`XOW` is", "W"},
    {"tc900_bugs__float-int-conversion.awl", -1, "`TRUNC` is no", "RW"},
    {"tc900_bugs__parameter-spacing.awl", -1, "a call of `SFC47(", "DS"},
    {"tc900_bugs__symbolic-timer-counter.awl", -1, "`VAR_INPUT` is", "P"},
    {"tc999_projects__acme-003.awl", -1, "`VAR_INPUT` is not", "BDP"},
    {"tc999_projects__bnt_modell.awl", -1, "is not UTF-8", "U"},
    {"tc999_projects__bnt_modell.awlpro", -1, "this is XML", "X"},
    {"tc999_projects__garagecounter.awl", 1, "", ""},
    {"tc999_projects__overflow.awl", -1, "`UD` is no", "W"},
    {"tc999_projects__pufferspeicher.awlpro", -1, "this is XML", "X"},
    {"tc999_projects__ringbuffer.awl", -1, "`FUNCTION_BLOCK` is", "DIP"},
    {"tc999_projects__ringbuffer.awlpro", -1, "this is XML", "X"},
    {"tc999_projects__shiftregister.awl", -1, "`RRD` is no", "W"},
    {"tc999_projects__stoerungsanzeige.awlpro", -1, "this is XML", "X"},
    {"tc999_projects__taktgenerator.awlpro", -1, "this is XML", "X"},
    {"tc999_projects__trafficlights_1.awl", -1, "is not UTF-8", "U"},
    {"tc999_projects__trafficlights_2.awl", -1, "is not UTF-8", "U"},
    {"tc999_projects__trafficlights_2.awlpro", -1, "this is XML", "X"},
};

bool has_corpus() { return std::filesystem::exists(kRoot); }

TEST(SiemensCorpus, IsReadWholeOrRefusedWithTheReason) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  int read = 0;
  std::map<char, int> counts;  // of files, by what they need
  for (const Row& row : kRows) {
    const Listing listing(text_of(std::string(row.file)));
    std::string errors;
    std::vector<std::string> messages;
    for (const Diagnostic& item : listing.list.items()) {
      if (item.severity != Severity::Error) continue;
      errors += item.message + "\n";
      messages.push_back(item.message);
    }
    EXPECT_EQ(classes_of(messages), row.classes) << row.file;
    for (const char letter : row.classes) ++counts[letter];
    EXPECT_EQ(errors.empty(), row.checks >= 0) << row.file << "\n" << errors;
    EXPECT_NE(errors.find(row.reason), std::string::npos) << row.file << "\n"
                                                          << errors;
    if (!errors.empty()) continue;
    ++read;
    const Checks checks = simulated(listing.program);
    EXPECT_EQ(checks.count, static_cast<std::size_t>(row.checks)) << row.file;
    EXPECT_EQ(checks.broken, 0U) << row.file;
  }
  EXPECT_EQ(read, 4);
  const std::map<char, int> expected = {
      {'A', 7}, {'B', 3},  {'D', 20}, {'I', 3}, {'L', 1},  {'P', 13},
      {'R', 2}, {'S', 10}, {'T', 1},  {'U', 4}, {'W', 21}, {'X', 8}};
  EXPECT_EQ(counts, expected);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot)) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, kRows.size());
}

/// What stands in front of the part that needs a data block.
TEST(SiemensCorpus, CountersDoWhatTheirTestSays) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  std::string text = text_of("tc100_instructions__insn_Z.awl");
  text.resize(text.find("// Test counter parameter"));
  const Listing listing(text + "\nEND_ORGANIZATION_BLOCK\n");
  ASSERT_TRUE(listing.list.items().empty())
      << listing.list.items().front().message;
  const Checks checks = simulated(listing.program);
  EXPECT_EQ(checks.count, 43U);
  // The counter is not new in the second scan: there the first edge is none.
  Simulator simulator(listing.program);
  simulator.scan(10);
  for (const CellId id : ids_of(listing.program.cells)) {
    if (!listing.program.cells[id].name.starts_with("assert.")) continue;
    EXPECT_EQ(simulator.value(id), 1) << listing.program.cells[id].name;
  }
}

/// The checks are properties, and are proved.
TEST(SiemensCorpus, ChecksAreProved) {
  if (!has_corpus()) GTEST_SKIP() << "no " << kRoot;
  Listing listing(text_of("tc100_instructions__insn_TAK.awl"));
  const PropertySet set =
      read_properties(listing.program, {}, listing.sources, listing.list);
  ASSERT_FALSE(listing.list.has_errors());
  std::size_t proved = 0;
  const VerifyReport report = verify(listing.program, set, {});
  EXPECT_EQ(unconfirmed(listing.program, set, report), "");
  for (const ObligationResult& result : report.results) {
    const bool check = result.obligation.name.starts_with("assert-");
    if (check && result.verdict == Verdict::Proved) ++proved;
  }
  EXPECT_EQ(proved, 4U);
}

}  // namespace
}  // namespace rung
