#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/rule.h"
#include "lint.h"

namespace rung::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMarker = "// --- expected\n";

fs::path golden_dir() { return fs::path(RUNG_ROOT) / "tests/rules/golden"; }

/// A program and all findings about it, in one file.
struct Golden {
  std::string source;
  std::string expected;
};

Golden read_golden(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string all = text.str();
  const std::size_t cut = all.find(kMarker);
  if (cut == std::string::npos) return {all, ""};
  return {all.substr(0, cut), all.substr(cut + kMarker.size())};
}

std::vector<fs::path> golden_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(golden_dir())) {
    if (entry.path().extension() == ".rung") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());  // the same order on every machine
  return files;
}

class GoldenTest : public ::testing::TestWithParam<fs::path> {};

TEST_P(GoldenTest, FindingsAreAsRecorded) {
  const Golden golden = read_golden(GetParam());
  Linted linted;
  const std::string actual = to_text(lint(golden.source, linted));
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(GetParam()) << golden.source << kMarker << actual;
    return;
  }
  EXPECT_EQ(golden.expected, actual) << "RUNG_UPDATE=1 rewrites the file";
}

std::string name_of(const ::testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.stem().string();
  for (char& c : name) {
    if (c == '-' || c == '.') c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rules, GoldenTest, ::testing::ValuesIn(golden_files()),
                         name_of);

class EveryRule : public ::testing::TestWithParam<const Rule*> {};

TEST_P(EveryRule, HasAGoldenWithAFindingAndOneWithout) {
  const std::string name(GetParam()->name);
  for (const bool bad : {true, false}) {
    const fs::path path =
        golden_dir() / (name + (bad ? ".bad.rung" : ".good.rung"));
    ASSERT_TRUE(fs::exists(path)) << path;
    Linted linted;
    lint(read_golden(path).source, linted);
    EXPECT_EQ(has_finding(linted, name), bad) << to_text(linted);
  }
}

std::string rule_name(const ::testing::TestParamInfo<const Rule*>& info) {
  std::string name(info.param->name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Goldens, EveryRule,
                         ::testing::ValuesIn(all_rules().begin(),
                                             all_rules().end()),
                         rule_name);

}  // namespace
}  // namespace rung::testing
