// Programs of others that say what is true of them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "analysis/program.h"
#include "analysis/property.h"
#include "confirm.h"
#include "frontend/recognise.h"
#include "smt/verify.h"

namespace rung {
namespace {

/// Verdicts of the properties that the file itself has, in their order.
std::string verdicts_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  SourceSet sources;
  DiagnosticList found;
  const FileId file = sources.add(path, text);
  Program program =
      build_program(recognise(text).read(sources, file, {}, found), {}, found);
  if (found.has_errors()) return found.items().front().message;
  const PropertySet properties = read_properties(program, {}, sources, found);
  if (found.has_errors()) return found.items().front().message;
  std::string verdicts;
  const VerifyReport report = verify(program, properties, {});
  const std::string doubt = unconfirmed(program, properties, report);
  if (!doubt.empty()) return doubt;
  for (const ObligationResult& result : report.results) {
    if (result.obligation.built_in) continue;
    verdicts +=
        (verdicts.empty() ? "" : " ") + std::string(to_string(result.verdict));
  }
  return verdicts;
}

// l5x2c checks them with CBMC: the first is safe, in the second one a rearm in
// the scan of a fault starts the belt again.
TEST(SharedVerdicts, BeltConveyors) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/l5x/l5x2c/";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  EXPECT_EQ(verdicts_of(root + "belt_conveyor.L5X"), "proved proved proved");
  EXPECT_EQ(verdicts_of(root + "belt_conveyor_wrong_rearm.L5X"),
            "violated violated violated violated violated violated");
}

}  // namespace
}  // namespace rung
