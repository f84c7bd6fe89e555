// Sketches of others, beside the repository and no part of it: each is read or
// refused for the right reason, and what their manifest says of them is proved.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "confirm.h"
#include "frontend/plclib/reader.h"
#include "frontend/recognise.h"
#include "smt/equivalence.h"
#include "smt/verify.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RUNG_SOURCE_DIR "/../shared/corpus/plclib";

struct Sketch {
  explicit Sketch(const fs::path& path, bool stable = false) {
    const std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    const FileId file = sources.add(path.string(), text.str());
    ast = read_plclib(sources, file, {.stable_inputs = stable}, list);
    recognised = recognise(sources[file].text()).name == "plclib";
    if (!list.has_errors()) program = build_program(ast, {}, list);
  }
  std::string first_error() const {
    for (const Diagnostic& item : list.items()) {
      if (item.severity == Severity::Error) return item.message;
    }
    return {};
  }
  std::string verdict(const std::string& property) {
    const FileId props = sources.add("props", property);
    const std::string_view line = sources[props].text();
    const AstAnnotation extra = {
        line, {props, 0, static_cast<std::uint32_t>(line.size())}};
    const PropertySet set = read_properties(program, {extra}, sources, list);
    if (list.has_errors()) return first_error();
    const VerifyReport report = verify(program, set, {});
    if (!report.failures.empty()) return report.failures.front().what;
    const std::string doubt = unconfirmed(program, set, report);
    if (!doubt.empty()) return doubt;
    for (const ObligationResult& result : report.results) {
      if (!result.obligation.built_in) {
        return std::string(to_string(result.verdict));
      }
    }
    return {};
  }

  SourceSet sources;
  DiagnosticList list;
  Ast ast;
  Program program;
  bool recognised = false;
};

// All others are read.
const std::map<std::string, std::string> kRefused = {
    {"CustomIO/CustomIO_IO.ino", "this sketch has no function `setup`"},
    {"FunctionBlock/Average.ino",
     "`average` has parameters: that is not supported"},
    {"InputOutput/ServoDualDebug.ino",
     "`#include <Servo.h>` is not supported: what it declares is not known"},
    {"Keypad/LedVariable.ino",
     "`#include <Keypad.h>` is not supported: what it declares is not known"},
    {"StructuredText/For.ino",
     "this `for` makes 1024 turns: more than 256 are not supported"},
    {"StructuredText/While.ino", "`while` is not supported in a function"},
    {"TimeDelays/TimerRolloverTest_DelayOff_DelayOff.ino",
     "`timer0_millis` is the clock of millis(): its wrap is not modelled"},
    {"TimeDelays/TimerRolloverTest_DelayOn_DelayOn.ino",
     "`timer0_millis` is the clock of millis(): its wrap is not modelled"},
    {"TimeDelays/TimerRolloverTest_FixedPulse_FixedPulse.ino",
     "`timer0_millis` is the clock of millis(): its wrap is not modelled"},
};

TEST(PlclibCorpus, IsReadWholeOrRefused) {
  if (!fs::exists(kRoot)) GTEST_SKIP() << "no " << kRoot;
  int read = 0;
  int refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = fs::relative(entry.path(), kRoot).generic_string();
    Sketch sketch(entry.path());
    const auto expected = kRefused.find(name);
    EXPECT_EQ(sketch.first_error(),
              expected == kRefused.end() ? "" : expected->second)
        << name;
    EXPECT_TRUE(sketch.recognised) << name;
    ++(sketch.first_error().empty() ? read : refused);
    if (sketch.first_error().empty()) {
      EXPECT_EQ(sketch.verdict("reach true"), "proved") << name;
    }
  }
  EXPECT_EQ(read, 35);
  EXPECT_EQ(refused, 9);
}

struct Claim {
  std::string_view file;
  std::string_view property;
  std::string_view verdict;
  bool stable = false;
};

TEST(PlclibCorpus, DoesWhatItsManifestSays) {
  if (!fs::exists(kRoot)) GTEST_SKIP() << "no " << kRoot;
  const std::vector<Claim> claims = {
      {"Interlocks/RadioButtons2Way.ino", "never Y0 && Y1", "proved"},
      {"Interlocks/RadioButtons3Way.ino", "interlock Y0, Y1", "proved"},
      // The second button wins at the scan's end.
      {"Interlocks/RadioButtons2Way.ino", "always X0 -> Y0", "violated"},
      {"Interlocks/RadioButtons2Way.ino", "always X1 -> Y1", "proved"},
      {"Latch/LatchCommand.ino", "always Y1 == !Y0", "proved"},
      {"Logic/AndOrXorNot.ino", "always Y0 == (X0 && X1)", "proved"},
      // Each read is a sample of its own.
      {"Logic/AndOrXorNot.ino", "always Y1 == (X0 || X1)", "violated"},
      {"Logic/AndOrXorNot.ino", "always Y1 == (X0 || X1)", "proved", true},
      {"Logic/AndOrXorNot.ino", "always Y2 == (X0 ^ X1)", "proved", true},
      {"Stack/AndBlock.ino", "always Y0 == ((X0 || X1) && (X2 || X3))",
       "proved"},
      {"Stack/OrBlock.ino", "always Y0 == (X0 && X1 || X2 && X3)", "proved"},
      {"TimeDelays/DelayOn.ino", "always Y0 -> TIMER0.elapsed >= 2000",
       "proved"},
      {"Counters/CountUpDownDebug.ino", "never Y0 && Y1", "proved"},
      {"Counters/CountUpDownDebug.ino", "always Y1 == (ctr.count == 10)",
       "proved"},
      {"Applications/SingleTrafficLight.ino", "never Y0 && Y2", "proved"},
      {"AnalogCompare/LessThan.ino", "always Y0 == X0 < X1", "proved"},
      {"StructuredText/If.ino", "always !X0 -> Y0 == prev(Y0)", "proved"},
      {"Waveforms/PulsedOutputVariables.ino", "always Y0 -> X0", "proved"},
  };
  for (const Claim& claim : claims) {
    Sketch sketch(kRoot / claim.file, claim.stable);
    EXPECT_EQ(sketch.verdict(std::string(claim.property)), claim.verdict)
        << claim.file << ": " << claim.property;
  }
}

TEST(PlclibCorpus, LatchesAreEquivalent) {
  if (!fs::exists(kRoot)) GTEST_SKIP() << "no " << kRoot;
  const Sketch command(kRoot / "Latch/LatchCommand.ino");
  const Sketch components(kRoot / "Latch/LatchDiscreteComponents.ino");
  const Sketch calls(kRoot / "Latch/SetResetCommands.ino");
  EquivalenceOptions options;
  EXPECT_EQ(
      check_equivalence(command.program, components.program, options).verdict,
      EquivalenceVerdict::Equivalent);
  options.rungs = {"Y0"};
  EXPECT_EQ(check_equivalence(command.program, calls.program, options).verdict,
            EquivalenceVerdict::Equivalent);
}

}  // namespace
}  // namespace rung
