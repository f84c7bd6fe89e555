#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/simulator.h"
#include "declared_text.h"

namespace rung::test {
namespace {

struct Row {
  std::string_view drawing;
  std::string_view rungs;
};

TEST(AsciiReader, ReadsDrawings) {
  const std::vector<Row> table = {
      {"|\n", ""},
      {"| a   b\n+-[ ]-( )-\n", "b=a"},
      {"| a   b\n+-[/]-(/)-|\n", "b=(! (! a))"},
      {"| a   b   c\n+-[ ]-(S)-(R)\n",
       "power.1=a | b=(|| power.1 b) | c=(&& (! power.1) c)"},
      {"|   b\n+--( )\n", "b=true"},
      // The second operand stands below.
      {"| a   b\n+-[>]-( )\n| 5\n", "b=(> a 5)"},
      {"| a   b   c\n+-[ ]-[<]-( )\n|    -7\n", "c=(&& a (< b -7))"},
      // Branches: an OR, and power that parts.
      {"| a     c\n+-[ ]-+-( )\n| b   |\n+-[ ]-+\n", "c=(|| a b)"},
      {"| a     b\n+-[ ]-+-( )\n      | c\n      +-( )\n",
       "power.1=a | b=power.1 | c=power.1"},
      {"|    a     b\n+-+-[ ]-+-( )\n  |     |\n  +-----+\n", "b=true"},
      // A wire leads to the right only: what b gives does not reach c.
      {"|  a         d\n+-[ ]-+---+-( )\n|  b  |   |\n+-[ ]-|---+\n      | c\n "
       "   "
       "  +-( )\n",
       "power.1=a | d=(|| power.1 b) | c=power.1"},
      // Top to bottom; b is written before the second row reads it.
      {"|  a   b\n+-[ ]-( )\n|  b   c\n+-[ ]-( )\n", "b=a | c=b"},
      // The contact of the first row is read before the coil below it writes.
      {"|  a     b   c\n+-[ ]-+-[ ]-( )\n|  d  | b\n+-[ ]-+-( )\n",
       "power.1=(|| a d) | c=(&& power.1 b) | b=power.1"},
      // A jump over the rows above its label.
      {"|  a\n+-[ ]-->>on\n|  b   c\n+-[ ]-( )\non:\n|  c   d\n+-[ ]-( )\n",
       "jump.1=a | here.2=(! jump.1) | c=(|| (&& here.2 b) (&& (! here.2) c)) "
       "| d=c"},
      {"(*@ never b *)\n{ LANGUAGE BottomOperandContext }\n{ any \\{ a \\} }\n"
       "//@ reach b\n| a   b\n+-[ ]-( )-\n",
       "b=a"},
      {"| %IX0.0 %QX1\n+-[ ]----( )-\n", "%QX1=%IX0.0"},
      {"|      t\n|      +-----+\n|  a   | TOF |  q\n+-[ ]--|IN  Q|-( )\n|    "
       "2s|PT ET|\n|      +-----+\n",
       "power.1=a | timer.2=(TOF power.1 0 2000) | q=timer.2"},
  };
  for (const Row& row : table) {
    const DeclaredText text("ascii", std::string(row.drawing));
    EXPECT_EQ(text.rungs(), row.rungs) << row.drawing << text.problems();
    EXPECT_FALSE(text.list.has_errors()) << row.drawing << text.problems();
    EXPECT_EQ(recognise(row.drawing).name, "ascii") << row.drawing;
  }
}

struct Refused {
  std::string_view drawing;
  std::string_view problem;
};

TEST(AsciiReader, RefusesWithNameAndPlace) {
  const std::vector<Refused> table = {
      {"| a   b\n+-[?]-( )-\n", "RP087 2:3 the element `[?]` is not supported"},
      {"| a   b\n+-[ ]-(X)-\n", "RP087 2:7"},
      {"| a   b\n+-[P]-( )-\n", "RP087"},
      {"| a   b\n+-[ \n", "RP087 2:3"},
      {"|     b\n+-[ ]-( )-\n", "RP051 2:3 no name stands above"},
      {"+-[ ]-\n", "RP051 1:3 no name"},
      {"| a\n+-[>]-\n", "RP051 2:3 no operand stands below"},
      {"| a b c\n+-[ ]-( )\n", "RP051 1:3 two names stand at one element"},
      {"| a   b   c\n+-[ ]-( )\n", "RP051 1:11 this belongs to no element"},
      {"| a   b\n+-[ ]-( )  [ ]\n", "RP051 2:12 this belongs to no element"},
      {"| a   b\n+-[ ]-( )-x\n", "RP051 2:11 this belongs"},
      {"| a   b\n+[ ]-( )-\n", "RP051"},
      {"| a   b\n+-[ ]-( )-\n#\n", "RP051 3:1 this character has no meaning"},
      {"| \xc3\xa4   b\n+-[ ]-( )-\n", "RP051"},
      {"|\n+->x\n", "RP051 2:3 `>>` and a label"},
      {"|\n+->>\n", "RP051"},
      {"|\n+->>x\n", "RP089 2:5 there is no label `x` further down"},
      {"x:\n|\n+->>x\n", "RP089"},
      {"x:\n|\nx:\n|\n", "RP089 3:1 the label `x` stands further up"},
      {"|\n+->>mian\nmain:\n|\n", "did you mean `main`?"},
      {"| a   b\n+-[ ]-( )-\n   |\n", "RP051 3:4 no wire comes from the left"},
      {"|  a  b\n+-[ ]-+\n      |\n      |\n", "RP051"},
      {"| a\n+-[ ]-+\n      |\n", "RP051 3:7 this wire ends in nothing"},
      {"|\n++--\n", "RP051 2:1 a wire is expected between"},
      {"| a\n+-[ ]-| x\n", "RP051 2:7 a wire ends here"},
      {"| 5   b\n+-[ ]-( )-\n", "RP052 1:3 `5` is no name"},
      {"| %IX0 %IX1\n+-[ ]--( )-\n", "RP052 1:8 `%IX1` is an input"},
      {"| %ZX0 b\n+-[ ]--( )-\n", "RP052"},
      {"| %IX  b\n+-[ ]--( )-\n", "RP052"},
      {"| %IX0..1 b\n+-[ ]----( )-\n", "RP052"},
      {"| a.b  c\n+-[ ]--( )-\n", "RP052"},
      {"| %MX0 %MX1\n+-[ ]--( )-\n| %MW0 b\n+-[>]--( )\n| 5\n",
       "RP052 3:3 `%MW0` may overlap"},
      {"| %MW0 b\n+-[ ]--( )-\n", "RP054 1:3 `%MW0` is a word"},
      {"| %MX0 b\n+-[>]--( )-\n| 5\n", "RP054 1:3 `%MX0` is a bit"},
      {"| a  a   b\n+-[ ]-[>]-( )\n|       5\n", "RP05"},
      {"| a     a   b\n+-[ ]--[>]-( )\n|       5\n",
       "RP054 1:9 `a` is used as a bit and as a word"},
      {"| a   b\n+-[>]-( )\n| 40000\n", "RP053 3:3 `40000` is no number"},
      {"| a   b\n+-[>]-( )\n| 9z\n", "RP053"},
      // Boxes.
      {"|  t\n| +-----+\n| | TON | q\n+-|IN  Q|-( )\n|x|PT ET|\n| +-----+\n",
       "RP053 5:3 a time is expected left of `PT`"},
      {"|  t\n| +-----+\n| | CTU | q\n+-|CU  Q|-( )\n| |PV CV|\n| +-----+\n",
       "RP087 3:3 the box `CTU` is not supported"},
      {"|  t\n| +-----+\n| | TON | q\n+-|IN  Q|-( )\n| +-----+\n",
       "RP051 2:3 a box has a name"},
      {"|\n|    +-----+\n|    | TON | q\n+----|IN  Q|-( )\n|  2s|PT "
       "ET|\n|    +-----+\n",
       "RP051 2:6 no name stands above this box"},
      {"(* open\n| a   b\n+-[ ]-( )-\n", "RP007 1:1 this comment"},
      {"{ open\n| a   b\n+-[ ]-( )-\n", "RP007 1:1 this pragma"},
      {"{ LANGUAGE Other }\n|\n", "RP087 1:1 `LANGUAGE Other` is not"},
      {"|\n\x02", "RP001"},
      {"|\t a\n+-[ ]-\n", "RP051 1:2"},
  };
  for (const Refused& row : table) {
    const DeclaredText text("ascii", std::string(row.drawing));
    EXPECT_NE(text.problems().find(row.problem), std::string::npos)
        << row.drawing << text.problems();
  }
}

TEST(AsciiReader, RolesFollowFromUse) {
  const DeclaredText text("ascii",
                          "| in   %QX0   m   b\n+-[ ]--(S)----[>]-( )\n"
                          "|             %MW3\n");
  ASSERT_FALSE(text.list.has_errors()) << text.problems();
  std::string roles;
  for (const AstDeclaration& cell : text.ast.declarations) {
    roles += std::string(cell.name) + (cell.word ? "w" : "") +
             std::to_string(static_cast<int>(cell.kind)) + " ";
  }
  EXPECT_EQ(roles, "in0 %QX01 mw0 %MW3w2 b1 power.12 ");
}

// Many branches, rows and joints: linear.
TEST(AsciiReader, IsLinear) {
  std::string top = "|";
  std::string wires = "+-";
  std::string below = "  ";
  std::string bypass = "  ";
  const int count = 3000;
  for (int i = 0; i < count; ++i) {
    top += "      a  ";
    wires += "-+--[ ]--";
    bypass += i == 0 ? " +-------" : "-+-------";
    below += " |       ";
  }
  const std::string drawing =
      top + "    b\n" + wires + "-+-( )\n" + below + " |\n" + bypass + "-+\n";
  const DeclaredText text("ascii", drawing);
  EXPECT_FALSE(text.list.has_errors()) << text.problems().substr(0, 500);
  EXPECT_LT(text.ast.nodes.size(), 40U * count);
}

// --- the collection ----------------------------------------------------------

/// Words, names in quotes, and single characters of a tool's pragma.
std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    if (is_word(text[at])) {
      while (end < text.size() && is_word(text[end])) ++end;
    } else if (text[at] == '"') {
      end = text.find('"', end) + 1;
    }
    if (text[at] != ' ' && text[at] != '\n') {
      tokens.push_back(text.substr(at, end - at));
    }
    at = end;
  }
  return tokens;
}

/// The test that a file has for its own tool: inputs of scans, and what the
/// watched names are after each.
struct ToolTest {
  struct Step {
    int scans = 1;
    std::map<std::string, int> inputs;
  };
  std::vector<Step> steps;
  std::vector<std::string> watch;
  std::vector<int> expected;  // by scan and watched name
};

ToolTest tool_test(const std::string& text) {
  ToolTest test;
  const std::size_t begin = text.find("testVect");
  if (begin == std::string::npos) return test;
  const std::size_t end = text.find("\\}", begin);
  const std::vector<std::string> tokens =
      tokens_of(text.substr(begin, end - begin));
  std::string section;
  std::string name;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (token == "testVect" || token == "watch" || token == "expected") {
      section = token;
    } else if (token[0] == '"') {
      name = token.substr(1, token.size() - 2);
      if (section == "watch") test.watch.push_back(name);
    } else if (token == "X" || token == "I") {
      const std::string& word = tokens[++i];
      const int value = token == "I" ? std::stoi(word) : (word == "True");
      if (section == "expected") {
        test.expected.push_back(value);
      } else {
        test.steps.back().inputs[name] = value;
      }
    } else if (section == "testVect" && std::isdigit(token[0]) != 0) {
      test.steps.push_back({std::stoi(token), {}});
    }
  }
  return test;
}

/// What the program does in the tool's test, in the form of `expected`. Names
/// that the program itself writes are 0 at first, as the tests say, too.
std::vector<int> run_of(const Program& program, const ToolTest& test) {
  Simulator simulator(program);
  std::vector<int> result;
  for (const ToolTest::Step& step : test.steps) {
    for (const auto& [name, value] : step.inputs) {
      const CellId cell = find_cell(program, name);
      if (!cell.has_value() || program.cells[cell].role != CellRole::Input) {
        EXPECT_EQ(value, 0) << name;
        continue;
      }
      simulator.set_input(cell, value);
    }
    for (int scan = 0; scan < step.scans; ++scan) {
      simulator.scan(10);
      for (const std::string& name : test.watch) {
        result.push_back(
            static_cast<int>(simulator.value(find_cell(program, name))));
      }
    }
  }
  return result;
}

TEST(AsciiReader, ReadsTheCorpusAndReproducesItsTraces) {
  const std::string root = RUNG_SOURCE_DIR "/../shared/corpus/ascii_ladder";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  const std::set<std::string> negative = {"negative__testN02.txt",
                                          "negative__testN03.txt"};
  int read = 0;
  int all = 0;
  int traces = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(recognise(bytes).name, "ascii") << entry.path();
    const DeclaredText text("ascii", bytes);
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(text.list.has_errors(), negative.contains(name))
        << name << "\n"
        << text.problems();
    ++all;
    if (text.list.has_errors()) continue;
    ++read;
    const ToolTest test = tool_test(bytes);
    traces += test.steps.empty() ? 0 : 1;
    EXPECT_EQ(run_of(text.program, test), test.expected) << name;
  }
  EXPECT_EQ(all, 18);
  EXPECT_EQ(read, 16);
  EXPECT_EQ(traces, 9);
}

}  // namespace
}  // namespace rung::test
