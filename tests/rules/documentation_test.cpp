#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/rule.h"
#include "lint.h"

namespace rung::testing {
namespace {

/// The indented lines that follow the line `label`, without their indent.
std::string block_after(std::string_view doc, std::string_view label) {
  std::size_t at = doc.find("\n" + std::string(label) + "\n");
  if (at == std::string_view::npos) return {};
  std::istringstream lines(std::string(doc.substr(at + label.size() + 2)));
  std::string block;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    ")) {
      block += line.substr(4) + "\n";
    } else if (!line.empty() && !block.empty()) {
      break;
    }
  }
  return block;
}

std::string rule_name(const ::testing::TestParamInfo<const Rule*>& info) {
  std::string name(info.param->name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Documentation : public ::testing::TestWithParam<const Rule*> {};

TEST_P(Documentation, HasTheFourHeadingsInOrder) {
  const std::string_view doc = GetParam()->doc;
  std::size_t last = 0;
  for (const char* heading : {"\n## Finds\n", "\n## Why it matters\n",
                              "\n## Example\n", "\n## Limits\n"}) {
    const std::size_t at = doc.find(heading);
    ASSERT_NE(at, std::string_view::npos) << heading;
    EXPECT_GE(at, last) << heading;
    last = at;
  }
}

TEST_P(Documentation, TheBadExampleHasTheFinding) {
  const std::string bad = block_after(GetParam()->doc, "Bad:");
  ASSERT_FALSE(bad.empty());
  Linted linted;
  lint(bad, linted);
  EXPECT_TRUE(has_finding(linted, GetParam()->name)) << to_text(linted);
}

/// Is it of a pack that has to be asked for? An example shows one thing.
bool is_asked_for(const Diagnostic& finding) {
  const Rule* const rule = find_rule(finding.rule);
  return rule != nullptr && rule->pack != Pack::Default;
}

/// Nothing of a warning's rank at all: an example to follow is right.
TEST_P(Documentation, TheGoodExampleHasNoWarning) {
  const std::string good = block_after(GetParam()->doc, "Good:");
  ASSERT_FALSE(good.empty());
  Linted linted;
  lint(good, linted);
  EXPECT_FALSE(has_finding(linted, GetParam()->name)) << to_text(linted);
  for (const Diagnostic& finding : linted.findings) {
    EXPECT_TRUE(finding.severity == Severity::Note || is_asked_for(finding))
        << to_text(linted);
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, Documentation,
                         ::testing::ValuesIn(all_rules().begin(),
                                             all_rules().end()),
                         rule_name);

/// The first sentence under "## Finds", on one line.
std::string summary(std::string_view doc) {
  constexpr std::string_view kHeading = "## Finds\n";
  const std::size_t begin = doc.find(kHeading) + kHeading.size();
  std::string text(doc.substr(begin, doc.find("\n\n", begin) - begin));
  std::replace(text.begin(), text.end(), '\n', ' ');
  // A table's columns are told apart by bars.
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos;
       at += 2) {
    text.replace(at, 1, "\\|");
  }
  const std::size_t end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

std::string table() {
  std::string text =
      "| code | name | severity | decided by | pack | finds |\n"
      "|---|---|---|---|---|---|\n";
  for (const Rule* rule : all_rules()) {
    text += "| " + std::string(rule->code) + " | `" + std::string(rule->name) +
            "` | " + std::string(to_string(rule->severity)) + " | " +
            (rule->decision == Decision::Solver ? "solver" : "syntax") + " | " +
            std::string(to_string(rule->pack)) + " | " + summary(rule->doc) +
            " |\n";
  }
  return text;
}

constexpr std::string_view kBegin = "<!-- rules: begin -->\n";
constexpr std::string_view kEnd = "<!-- rules: end -->\n";

TEST(RulesPage, HasTheTableOfTheRegistry) {
  const std::string path = std::string(RUNG_ROOT) + "/docs/rules/README.md";
  std::stringstream read;
  read << std::ifstream(path).rdbuf();
  const std::string page = read.str();
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::size_t first = begin + kBegin.size();
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(path) << page.substr(0, first) << table() << page.substr(end);
    return;
  }
  EXPECT_EQ(page.substr(first, end - first), table())
      << "RUNG_UPDATE=1 rewrites the table";
}

TEST(Registry, IsSortedAndCodesAndNamesAreUnique) {
  const std::span<const Rule* const> rules = all_rules();
  EXPECT_GE(rules.size(), 40U);
  for (std::size_t i = 1; i < rules.size(); ++i) {
    EXPECT_LT(rules[i - 1]->code, rules[i]->code);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_NE(rules[i]->name, rules[k]->name);
    }
  }
  EXPECT_EQ(find_rule("RP101"), find_rule("double-coil"));
  EXPECT_EQ(find_rule("RP1"), nullptr);
}

/// The cells of a table's row, trimmed; of a line that is no row, none.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  if (!line.starts_with("| ")) return cells;
  std::istringstream parts(line.substr(1));
  for (std::string cell; std::getline(parts, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    cells.push_back(
        begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// What stands between backticks.
std::set<std::string> quoted_in(const std::string& text) {
  std::set<std::string> found;
  std::istringstream parts(text);
  bool inside = false;
  for (std::string part; std::getline(parts, part, '`'); inside = !inside) {
    if (inside) found.insert(part);
  }
  return found;
}

/// docs/rules/mapping.md, read.
struct Mapping {
  std::set<std::string> theirs;  // topics, and ids of other tools
  std::set<std::string> ours;    // of the table
  std::set<std::string> alone;
  std::vector<std::string> unexplained;  // no rule and no reason
};

Mapping read_mapping() {
  Mapping mapping;
  std::ifstream page(std::string(RUNG_ROOT) + "/docs/rules/mapping.md");
  for (std::string line; std::getline(page, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 5 && cells[0] != "topic") {
      mapping.theirs.insert(cells[0]);
      mapping.theirs.merge(quoted_in(cells[2]));
      mapping.ours.merge(quoted_in(cells[3]));
      if (cells[3].empty() && cells[4].empty()) {
        mapping.unexplained.push_back(cells[0]);
      }
    } else if (cells.size() == 2 && cells[0] != "rule") {
      mapping.alone.merge(quoted_in(cells[0]));
    }
  }
  return mapping;
}

TEST(MappingPage, HasEveryIdOfTheCatalogue) {
  const Mapping mapping = read_mapping();
  std::ifstream list(std::string(RUNG_ROOT) + "/tests/rules/catalogue.txt");
  std::size_t ids = 0;
  for (std::string id; std::getline(list, id); ++ids) {
    EXPECT_TRUE(mapping.theirs.contains(id)) << id;
  }
  EXPECT_GT(ids, 200U);
  EXPECT_EQ(ids, mapping.theirs.size());
  EXPECT_TRUE(mapping.unexplained.empty()) << mapping.unexplained.front();
}

TEST(MappingPage, NamesEveryRuleOfOursAndNoOther) {
  const Mapping mapping = read_mapping();
  for (const std::set<std::string>* names : {&mapping.ours, &mapping.alone}) {
    for (const std::string& name : *names) {
      EXPECT_NE(find_rule(name), nullptr) << name;
    }
  }
  for (const Rule* rule : all_rules()) {
    const std::string name(rule->name);
    EXPECT_NE(mapping.ours.contains(name), mapping.alone.contains(name))
        << name;
  }
}

}  // namespace
}  // namespace rung::testing
