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
#include "analysis/property.h"
#include "confirm.h"
#include "frontend/recognise.h"
#include "smt/verify.h"

namespace rung {
namespace {

// The example programs, and those of the documents, give the verdicts that
// they announce: every written property has an `expect` line, and a built-in
// one that has none is proved.

struct Example {
  std::string name;  // file, or "docs/properties.md:LINE"
  std::string text;
};

std::ostream& operator<<(std::ostream& out, const Example& example) {
  return out << example.name;
}

std::string read_file(const std::filesystem::path& path) {
  const std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<Example> corpus_files() {
  const std::filesystem::path root = RUNG_SOURCE_DIR "/corpus";
  std::vector<Example> examples;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    examples.push_back(
        {std::filesystem::relative(entry.path(), root).generic_string(),
         read_file(entry.path())});
  }
  std::sort(examples.begin(), examples.end(),
            [](const Example& a, const Example& b) { return a.name < b.name; });
  return examples;
}

/// The blocks of a page that are fenced by ```rung or by ``` and the name of a
/// language.
void add_documented(const std::string& page, std::vector<Example>& examples) {
  std::istringstream lines(read_file(RUNG_SOURCE_DIR "/" + page));
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line == "```rung" ||
        (line.starts_with("```") && find_language(line.substr(3)) != nullptr)) {
      inside = true;
      examples.push_back({page + ":" + std::to_string(number), {}});
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      examples.back().text += line + "\n";
    }
  }
}

/// Of these pages and those of the languages.
std::vector<Example> documented() {
  std::vector<Example> examples;
  add_documented("docs/properties.md", examples);
  add_documented("docs/bound.md", examples);
  add_documented("docs/engines.md", examples);
  std::vector<std::string> pages;
  for (const auto& entry :
       std::filesystem::directory_iterator(RUNG_SOURCE_DIR "/docs/languages")) {
    pages.push_back("docs/languages/" + entry.path().filename().string());
  }
  std::sort(pages.begin(), pages.end());
  for (const std::string& page : pages) add_documented(page, examples);
  return examples;
}

/// Expected and actual verdicts by obligation, as lines to compare.
struct Outcome {
  std::string expected;
  std::string actual;
  std::string errors;
};

std::string line_of(const std::string& name, const std::string& verdict) {
  return name + " " + verdict + "\n";
}

Outcome outcome_of(const Example& example) {
  Outcome outcome;
  SourceSet sources;
  DiagnosticList found;
  const FileId file = sources.add(example.name, example.text);
  const std::string_view named = declared_language(example.text);
  const Language* const language =
      named.empty() ? &recognise(example.text) : find_language(named);
  if (language == nullptr || !language->supported()) {
    outcome.errors = "no reader for it\n";
    return outcome;
  }
  const Ast ast = language->read(sources, file, {}, found);
  Program program = build_program(ast, {}, found);
  PropertySet properties;
  if (!found.has_errors()) {
    properties = read_properties(program, {}, sources, found);
  }
  for (const Diagnostic& item : found.items()) {
    if (item.severity != Severity::Error) continue;
    const LineColumn at = sources[file].position(item.where.begin);
    outcome.errors += std::to_string(at.line) + ":" +
                      std::to_string(at.column) + " " + item.message + "\n";
  }
  if (!outcome.errors.empty()) return outcome;
  std::map<std::string, std::string> wanted;
  for (const Expectation& line : properties.expectations) {
    wanted[line.obligation] = line.verdict;
  }
  const VerifyReport report = verify(program, properties, {});
  for (const ObligationResult& result : report.results) {
    const std::string& name = result.obligation.name;
    const auto expectation = wanted.find(name);
    const bool silent = expectation == wanted.end();
    const std::string verdict =
        silent ? (result.obligation.built_in ? "proved" : "(no expect line)")
               : expectation->second;
    const std::string actual(to_string(result.verdict));
    outcome.expected += line_of(name, verdict);
    outcome.actual += line_of(name, actual);
    if (verdict != actual) outcome.errors += name + ": " + result.reason + "\n";
  }
  outcome.errors += unconfirmed(program, properties, report);
  for (const SelfCheckFailure& failure : report.failures) {
    outcome.errors += failure.obligation + ": " + failure.what + "\n";
  }
  return outcome;
}

std::string case_name(const testing::TestParamInfo<Example>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                 (c >= '0' && c <= '9'));
      },
      '_');
  return name;
}

class Corpus : public testing::TestWithParam<Example> {};

TEST_P(Corpus, GivesTheVerdictsThatItAnnounces) {
  const Outcome outcome = outcome_of(GetParam());
  EXPECT_EQ(outcome.expected, outcome.actual);
  EXPECT_EQ(outcome.errors, "");
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, testing::ValuesIn(corpus_files()),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Documents, Corpus, testing::ValuesIn(documented()),
                         case_name);

TEST(CorpusFiles, SayWhatTheyAre) {
  for (const Example& example : corpus_files()) {
    if (example.name.ends_with(".rung")) {
      EXPECT_EQ(example.text.substr(0, 2), "//") << example.name;
    }
    EXPECT_NE(example.text.find("@ expect "), std::string::npos)
        << example.name << " has no property of its own";
  }
}

TEST(CorpusFiles, AreThirtyAndMore) {
  std::size_t papers = 0;
  for (const Example& example : corpus_files()) {
    if (!example.name.starts_with("papers/")) continue;
    ++papers;
    EXPECT_NE(example.text.find(" Source:"), std::string::npos) << example.name;
  }
  EXPECT_GE(papers, 4U);
  EXPECT_GE(corpus_files().size() - papers, 30U);
}

}  // namespace
}  // namespace rung
