// A program, written in another language and read again, is proved to be
// itself.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "lowering.h"
#include "tests/agreement/program_generator.h"
#include "tests/setting.h"

namespace rung {
namespace {

/// How many of the example programs are refused, of `kRandom` random ones with
/// words, and of as many without; those that no reader takes are among them.
struct Refused {
  std::size_t corpus = 0;
  std::size_t words = 0;
  std::size_t bits = 0;
};
const std::map<std::string_view, Refused> kRefused = {
    {"il-iec", {1, 31, 14}},
    {"script", {0, 0, 0}},
    {"il-mitsubishi", {16, 94, 81}},
    {"ascii", {15, 94, 77}},
    {"st", {1, 31, 14}},
    {"plcopen", {1, 31, 14}},
    {"plclib", {2, 59, 30}},
    {"ldmicro", {8, 73, 60}},
};
constexpr std::size_t kRandom = 100;

class RoundTrip : public testing::TestWithParam<WrittenLanguage> {
 protected:
  /// 1 when it is refused, 0 when it is written and proved.
  std::size_t refuse_or_prove(ReadProgram& source) {
    // It has no timers where a scan is not fixed.
    if (GetParam().name == "ldmicro") source.program.scan = {10, 10};
    EXPECT_EQ(source.error, "");
    const Lowered lowered = lower(GetParam(), source);
    if (!lowered.written) {
      EXPECT_NE(lowered.refused.find("RP084 "), std::string::npos);
      return 1;
    }
    EXPECT_EQ(validate(GetParam(), source, *lowered.written), "")
        << lowered.written->text;
    return 0;
  }

  std::size_t random(bool words, std::uint64_t first, std::size_t count) {
    std::size_t refused = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
      const auto tape = random_tape(seed, 120);
      Tape choices(tape);
      const GeneratedProgram made =
          generate_program(choices, {.max_rungs = 5, .words = words});
      SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + made.text);
      const auto source = read_program("script", made.dialect, made.text);
      // A word that does not fit, say: the generator knows no types.
      if (!source->error.empty()) {
        ++refused;
        continue;
      }
      refused += refuse_or_prove(*source);
      if (HasFailure()) break;
    }
    return refused;
  }
};

TEST_P(RoundTrip, OfTheCorpus) {
  std::size_t refused = 0;
  for (const auto& [name, text] : corpus()) {
    SCOPED_TRACE(name);
    refused += refuse_or_prove(*read_program("script", "", text, name));
  }
  EXPECT_EQ(refused, kRefused.at(GetParam().name).corpus);
}

// A compiler evaluates the generator's arguments in its own order, so the
// programs are others: the numbers are those of GCC.
TEST_P(RoundTrip, OfRandomPrograms) {
  constexpr std::size_t kSlack = 6;
  const std::size_t programs = setting("RUNG_ROUND_TRIPS", kRandom);
  const Refused& most = kRefused.at(GetParam().name);
  EXPECT_LE(random(true, 1, programs), most.words + kSlack);
  EXPECT_LE(random(false, 1, programs), most.bits + kSlack);
}

// RUNG_LOWER_PROGRAMS=5000 for as many of both kinds.
TEST_P(RoundTrip, OfManyRandomPrograms) {
  const std::size_t programs = setting("RUNG_LOWER_PROGRAMS", 0);
  if (programs == 0) GTEST_SKIP() << "RUNG_LOWER_PROGRAMS is not set";
  std::size_t refused = random(true, 1'000'000, programs);
  refused += random(false, 2'000'000, programs);
  EXPECT_LT(refused, 2 * programs);
  RecordProperty("refused", static_cast<int>(refused));
  printf("%zu of %zu are refused\n", refused, 2 * programs);
}

std::string name_of(const testing::TestParamInfo<WrittenLanguage>& info) {
  std::string name(info.param.name);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Languages, RoundTrip,
                         testing::ValuesIn(written_languages()), name_of);

}  // namespace
}  // namespace rung
