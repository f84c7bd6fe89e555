#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace rung {
namespace {

namespace fs = std::filesystem;

/// The table of ARCHITECTURE.md: what the files of a folder may include.
const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> table = {
      {"base", {}},
      {"frontend", {"base"}},
      {"analysis", {"base", "frontend"}},
      {"smt", {"base", "frontend", "analysis"}},
      {"backend", {"base", "analysis"}},
      {"boards", {"base", "analysis", "backend"}},
      {"reports", {"base", "analysis"}},
      {"runtime", {}},
      {"app",
       {"base", "frontend", "analysis", "smt", "backend", "boards", "reports",
        "runtime"}},
      {"check", {"base", "analysis", "app"}},
  };
  return table;
}

/// The folder that an #include line reaches, or an empty string.
std::string included_folder(const std::string& line) {
  const std::size_t quote = line.find('"');
  if (line.rfind("#include", 0) != 0 || quote == std::string::npos) return "";
  const std::size_t slash = line.find('/', quote);
  if (slash == std::string::npos) return "";
  return line.substr(quote + 1, slash - quote - 1);
}

std::vector<std::string> wrong_arrows(const std::string& folder,
                                      const fs::path& file) {
  std::vector<std::string> wrong;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::string target = included_folder(line);
    if (target.empty() || target == folder) continue;
    if (allowed().count(target) == 0 && target != "tests") continue;
    if (allowed().at(folder).count(target) == 0) wrong.push_back(line);
  }
  return wrong;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

TEST(Layers, EveryIncludeIsAnArrowOfTheTable) {
  std::size_t files = 0;
  for (const auto& [folder, targets] : allowed()) {
    const fs::path root = fs::path(RUNG_ROOT) / folder;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (!is_source(entry.path())) continue;
      ++files;
      for (const std::string& line : wrong_arrows(folder, entry.path())) {
        ADD_FAILURE() << entry.path() << " may not have: " << line;
      }
    }
  }
  EXPECT_GT(files, 20U) << "the folders were not found";
}

/// The second opinion on proofs must be one: nothing of the encoding, of the
/// engines or of the simulator, only what readers make.
TEST(Layers, TheCheckerSharesTheReadersOnly) {
  const std::set<std::string> shared = {
      "analysis/formula.h",   // property lines, parsed
      "analysis/program.h",   // what a reader makes
      "analysis/property.h",  // property lines, read
      "analysis/property_line.h",
      "app/inputs.h",
      "app/load.h",
      "app/options.h",
      "app/version.h",
      "base/diagnostic.h",
      "base/process.h",
  };
  for (const auto& entry :
       fs::directory_iterator(fs::path(RUNG_ROOT) / "check")) {
    if (!is_source(entry.path())) continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      const std::string folder = included_folder(line);
      if (folder.empty() || folder == "check" || folder == "fmt") continue;
      if (folder == "CLI" || folder == "nlohmann") continue;
      const std::size_t quote = line.find('"');
      const std::string path =
          line.substr(quote + 1, line.rfind('"') - quote - 1);
      EXPECT_EQ(shared.count(path), 1U) << entry.path() << ": " << line;
    }
  }
}

/// The formulas of element_kinds() are the engines' encoding.
TEST(Layers, TheCheckerReadsNoStepTexts) {
  for (const auto& entry :
       fs::directory_iterator(fs::path(RUNG_ROOT) / "check")) {
    if (!is_source(entry.path())) continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      for (const char* const field :
           {"operation->updates", "operation->result", "instance.kind->states",
            "instance.kind->done", "instance.kind->value"}) {
        EXPECT_EQ(line.find(field), std::string::npos)
            << entry.path() << ": " << line;
      }
    }
  }
}

TEST(Layers, OnlySmtSeesASolver) {
  for (const auto& [folder, targets] : allowed()) {
    if (folder == "smt") continue;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RUNG_ROOT) / folder)) {
      if (!is_source(entry.path())) continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const bool solver = line.find("<z3") != std::string::npos ||
                            line.find("<cadical") != std::string::npos;
        EXPECT_FALSE(solver) << entry.path() << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace rung
