// The man page, docs/cli.md and the shells' completions name every command and
// option that the program has, and no other.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace rung::test {
namespace {

using Names = std::set<std::string>;

std::string output_of(const std::string& arguments) {
  const std::string command = std::string(RUNG_PROGRAM) + " " + arguments;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t read = 1; pipe != nullptr && read > 0;) {
    read = std::fread(buffer.data(), 1, buffer.size(), pipe);
    text.append(buffer.data(), read);
  }
  if (pipe != nullptr) ::pclose(pipe);
  return text;
}

std::string read_text(const std::string& path) {
  std::ifstream file(std::string(RUNG_ROOT) + "/" + path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Names all_of(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  Names found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end;
       ++at) {
    found.insert((*at)[1]);
  }
  return found;
}

/// The lines behind "Subcommands:".
Names commands() {
  const std::string help = output_of("--help");
  const std::size_t begin = help.find("Subcommands:");
  if (begin == std::string::npos) return {};
  return all_of(help.substr(begin), "\n  ([a-z]+) ");
}

/// An option stands at its line's beginning, behind its short form.
Names options() {
  Names all;
  std::string help = output_of("--help");
  for (const std::string& command : commands()) {
    help += output_of(command + " --help");
  }
  return all_of(help, "\n  (?:-[a-z],)?--([a-z-]+)");
}

std::string without_backslashes(std::string text) {
  std::erase(text, '\\');
  return text;
}

struct Page {
  const char* path;
  const char* option;   // how it spells an option, a pattern
  const char* command;  // and a command
};
constexpr Page kPages[] = {
    {"docs/cli.md", "--([a-z][a-z-]+)", "\n\\| `([a-z]+)"},
    {"docs/rungproof.1", "--([a-z][a-z-]+)", "\n.BI? ([a-z]+) \" (?:FILE|A)"},
    {"app/completions/rungproof.bash", "[ \"]--([a-z][a-z-]+)", ""},
    {"app/completions/_rungproof", "--([a-z][a-z-]+)\\[?", "\n    '([a-z]+):"},
    {"app/completions/rungproof.fish", "complete .* -l ([a-z-]+)",
     " -a ([a-z]+) -d"},
};

TEST(Manual, NamesEveryOptionAndNoOther) {
  const Names wanted = options();
  ASSERT_GT(wanted.size(), 20U);
  for (const Page& page : kPages) {
    Names named =
        all_of(without_backslashes(read_text(page.path)), page.option);
    named.insert("help");  // where a page leaves it out
    EXPECT_EQ(named, wanted) << page.path;
  }
}

TEST(Manual, NamesEveryCommandAndNoOther) {
  Names wanted = commands();
  ASSERT_GT(wanted.size(), 5U);
  for (const Page& page : kPages) {
    if (*page.command == '\0') continue;
    Names named = all_of(read_text(page.path), page.command);
    if (std::string(page.path).ends_with(".1")) {
      named.insert(
          {"rule", "monitor", "config", "lsp"});  // which take no program
    }
    EXPECT_EQ(named, wanted) << page.path;
  }
}

std::string completed(const std::string& words, int at) {
  const std::string script = "source " RUNG_ROOT
                             "/app/completions/rungproof.bash; COMP_WORDS=(" +
                             words + "); COMP_CWORD=" + std::to_string(at) +
                             "; _rungproof; echo ${COMPREPLY[*]}";
  const std::string command = "bash -c '" + script + "'";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::array<char, 512> buffer{};
  std::string text;
  if (pipe != nullptr &&
      std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    text = buffer.data();
  }
  if (pipe != nullptr) ::pclose(pipe);
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

TEST(Manual, BashCompletes) {
  std::string names;
  for (const std::string& name : commands()) {
    EXPECT_EQ(completed("rungproof " + name, 1), name);
  }
  EXPECT_EQ(completed("rungproof check --form", 2), "--format");
  EXPECT_EQ(completed("rungproof check --format s", 3), "sarif");
  EXPECT_EQ(completed("rungproof render --format s", 3), "svg");
  EXPECT_EQ(completed("rungproof lower --bin", 2), "--binary");
  EXPECT_EQ(completed("rungproof check --bin", 2), "");
  EXPECT_EQ(completed("rungproof upload --cl", 2), "--clear-outputs");
  EXPECT_EQ(completed("rungproof monitor --baud 96", 3), "9600");
}

}  // namespace
}  // namespace rung::test
