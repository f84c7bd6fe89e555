// What lint says of the programs of others: docs/rules/corpus.md.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "analysis/rule.h"
#include "frontend/recognise.h"
#include "smt/oracle.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

const fs::path kShared = RUNG_SOURCE_DIR "/../shared/corpus";
const fs::path kPage = RUNG_SOURCE_DIR "/docs/rules/corpus.md";
constexpr std::string_view kBegin = "<!-- findings: begin -->\n";
constexpr std::string_view kEnd = "<!-- findings: end -->\n";

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

using Counts = std::map<std::string, std::size_t>;  // by language

struct Table {
  Counts programs;
  std::map<std::string, Counts> findings;  // by code
};

/// Lints one text, if it is read.
void add(const fs::path& path, Table& table) {
  SourceSet sources;
  DiagnosticList found;
  const std::string text = text_of(path);
  const FileId file = sources.add(path.string(), text);
  const Language& language = recognise(text);
  if (!language.supported() || path.extension() == ".yaml") return;
  const Ast ast = language.read(sources, file, {}, found);
  if (found.has_errors()) return;
  Program program = build_program(ast, {}, found);
  if (found.has_errors()) return;
  const PropertySet properties = read_properties(program, {}, sources, found);
  if (found.has_errors()) return;
  TransitionSystem ts = build_transition_system(program);
  PropertySet assumptions;
  assumptions.assumptions = properties.assumptions;
  make_obligations(program, assumptions, ts);
  SolverOracle oracle(program, ts);
  DiagnosticList findings;
  run_rules({sources, program, properties, ts, &oracle}, findings);
  const std::string name(language.name);
  ++table.programs[name];
  for (const Diagnostic& finding : findings.items()) {
    ++table.findings[std::string(finding.code)][name];
    if (std::getenv("RUNG_LIST") == nullptr) continue;
    const LineColumn at =
        sources[finding.where.file].position(finding.where.begin);
    std::printf("%s %s %s:%u: %s | %s\n", finding.code.data(),
                finding.rule.data(), path.c_str(), at.line,
                finding.message.c_str(), finding.help.c_str());
  }
}

std::string to_text(const Table& table) {
  std::string text = "| code | rule |";
  std::string rule = "|---|---|";
  std::string first = "| | programs |";
  for (const auto& [name, count] : table.programs) {
    text += " " + name + " |";
    rule += "---|";
    first += " " + std::to_string(count) + " |";
  }
  text += "\n" + rule + "\n" + first + "\n";
  for (const Rule* one : all_rules()) {
    const auto counts = table.findings.find(std::string(one->code));
    if (counts == table.findings.end()) continue;
    text +=
        "| " + std::string(one->code) + " | `" + std::string(one->name) + "` |";
    for (const auto& [name, programs] : table.programs) {
      const auto count = counts->second.find(name);
      text += count == counts->second.end()
                  ? " |"
                  : " " + std::to_string(count->second) + " |";
    }
    text += "\n";
  }
  return text;
}

TEST(SharedFiles, HaveTheFindingsOfThePage) {
  if (!fs::exists(kShared)) GTEST_SKIP() << "no " << kShared;
  std::set<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(kShared)) {
    if (entry.is_regular_file()) paths.insert(entry.path());
  }
  Table table;
  for (const fs::path& path : paths) {
    if (path.parent_path() != kShared) add(path, table);
  }
  const std::string page = text_of(kPage);
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::size_t from = begin + kBegin.size();
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(kPage) << page.substr(0, from) << to_text(table)
                         << page.substr(end);
    return;
  }
  EXPECT_EQ(page.substr(from, end - from), to_text(table))
      << "RUNG_UPDATE=1 rewrites the table";
}

}  // namespace
}  // namespace rung
