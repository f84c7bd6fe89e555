#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace rung::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The codes in a text, each after `before`.
void collect(const std::string& text, const std::string& before,
             std::set<std::string>& codes) {
  const std::string start = before + "RP0";
  for (std::size_t at = text.find(start); at != std::string::npos;
       at = text.find(start, at + 1)) {
    codes.insert(text.substr(at + before.size(), 5));
  }
}

// docs/scripts.md lists exactly the codes that the reader and the builder
// report.
TEST(ScriptCodes, AreDocumented) {
  const fs::path root = RUNG_SOURCE_DIR;
  std::set<std::string> reported;
  for (const char* const folder : {"frontend", "frontend/script", "analysis"}) {
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      const std::string name = entry.path().filename().string();
      const bool ours = folder != std::string("analysis") ||
                        name.starts_with("build_program");
      if (ours && entry.is_regular_file()) {
        collect(text_of(entry.path()), "\"", reported);
      }
    }
  }
  std::set<std::string> documented;
  collect(text_of(root / "docs/scripts.md"), "\n| ", documented);
  EXPECT_GT(reported.size(), 30U);
  EXPECT_EQ(reported, documented);
}

TEST(PlcopenCodes, AreDocumented) {
  const fs::path root = RUNG_SOURCE_DIR;
  std::set<std::string> reported;
  for (const auto& entry : fs::directory_iterator(root / "frontend/plcopen")) {
    collect(text_of(entry.path()), "\"", reported);
  }
  std::set<std::string> documented;
  collect(text_of(root / "docs/languages/plcopen.md"), "\n| ", documented);
  EXPECT_GT(reported.size(), 5U);
  EXPECT_EQ(reported, documented);
}

}  // namespace
}  // namespace rung::test
