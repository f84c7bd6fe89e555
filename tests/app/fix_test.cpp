// Fixes of random programs, against the simulator; differences as patches.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "analysis/fixes/apply_edits.h"
#include "analysis/simulator.h"
#include "app/fix_proof.h"
#include "app/fixer.h"
#include "app/unified_diff.h"
#include "tests/rules/random_script.h"

namespace rung {
namespace {

const Options kOptions;
const std::vector<AstAnnotation> kNoLines;

struct Read {
  explicit Read(const std::string& text)
      : loaded(load({sources.add("x.rung", text), "x.rung", std::nullopt},
                    kOptions, kNoLines, sources)) {}
  SourceSet sources;
  Loaded loaded;
};

/// Values of the outputs and of the cells that both have, scan for scan.
void expect_same_runs(const std::string& before, const std::string& after,
                      unsigned seed) {
  const Read a(before);
  const Read b(after);
  ASSERT_TRUE(a.loaded.program && b.loaded.program) << after;
  const Program& x = *a.loaded.program;
  const Program& y = *b.loaded.program;
  Simulator left(x);
  Simulator right(y);
  std::mt19937 random(seed);
  for (int scan = 0; scan < 60; ++scan) {
    for (const CellId id : ids_of(x.cells)) {
      if (x.cells[id].role != CellRole::Input) continue;
      const auto value = static_cast<std::int64_t>(random() % 2);
      left.set_input(id, value);
      const CellId other = find_cell(y, x.cells[id].name);
      if (other.has_value()) right.set_input(other, value);
    }
    const std::int64_t dt = random() % 2 == 0 ? 100 : 30;
    left.scan(dt);
    right.scan(dt);
    for (const CellId id : ids_of(x.cells)) {
      const CellId other = find_cell(y, x.cells[id].name);
      if (!other.has_value()) {
        ASSERT_NE(x.cells[id].role, CellRole::Output) << after;
        continue;
      }
      ASSERT_EQ(left.value(id), right.value(other))
          << x.cells[id].name << " in scan " << scan << "\n"
          << before << "became\n"
          << after;
    }
  }
}

TEST(Fixes, LeaveRandomProgramsWhatTheyWere) {
  int changed = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    const std::string text = testing::RandomScript(seed).text();
    const FixedText fixed =
        fix_text("x.rung", text, kOptions, kNoLines, VerifyOptions{});
    EXPECT_EQ(fixed.failure, "");
    if (fixed.text == text) continue;
    ++changed;
    expect_same_runs(text, fixed.text, seed);
  }
  EXPECT_GT(changed, 10) << "too few programs had anything to fix";
}

struct Change {
  const char* before;
  const char* after;
  const char* reason;  // a part of it; null: it is proved
};

TEST(Fixes, AProofLooksAtEverythingThatCounts) {
  constexpr Change kChanges[] = {
      {"Q0 = I0 && I0;\n", "Q0 = I0;\n", nullptr},
      {"M0 = I0;\nQ0 = I1;\n", "Q0 = I1;\n", nullptr},
      {"Q0 = I0;\n", "Q0 = !I0;\n", "`Q0` would differ in scan 1"},
      {"Q0 = I0;\n", "Q0 = I0 &&;\n", "then "},
      {"Q0 = I0;\nQ1 = I0;\n", "Q0 = I0;\n", "no rung would write"},
      {"Q0 = I0;\n", "Q0 = I0;\nQ1 = I0;\n", "it adds `Q1`"},
      {"Q0 = I0;\n", "Q0 = I0 || I1 && !I1;\n", "it adds `I1`"},
      // The world sees no difference, who reads the memory in a test does.
      {"M0 = I0;\nQ0 = I1;\n", "M0 = !I0;\nQ0 = I1;\n", "`M0` would differ"},
      {"M0 = I0;\nQ0 = I1;\n//Sim\nx = M0;\n", "Q0 = I1;\n//Sim\nx = M0;\n",
       "the plant names `M0`"},
      {"//@ never Q0\nQ0 = I0;\n", "Q0 = I0;\n", "property lines"},
      {"//@ scan 5 ms\nQ0 = I0;\n", "Q0 = I0;\n", "read differently"},
      {"//@ assume !I0\nQ0 = I0;\n", "//@ assume I0\nQ0 = I0;\n",
       "property lines"},
      {"//@ never T(0).elapsed > 9000\nQ0 = T(0, 5, I0 && I0);\n",
       "//@ never T(0).elapsed > 9000\nQ0 = T(0, 5, I0);\n", "looks at `T(0)`"},
      {"pin3 = y0 || pin1;\ny0 = pin1;\n", "y0 = pin1;\npin3 = y0 || pin1;\n",
       "`pin3` would differ in scan 2"},
      {"pin3 = pin1;\n", "Q0 = I0;\n", "read differently"},
  };
  for (const Change& change : kChanges) {
    const Read before(change.before);
    ASSERT_TRUE(before.loaded.program) << change.before;
    const FixProof::Answer answer =
        FixProof(before.loaded, "x.rung", kOptions, kNoLines)
            .prove(change.after, 10);
    EXPECT_EQ(answer.proved, change.reason == nullptr)
        << change.before << change.after << answer.reason;
    if (change.reason == nullptr) continue;
    EXPECT_NE(answer.reason.find(change.reason), std::string::npos)
        << change.before << change.after << answer.reason;
  }
}

TEST(Fixes, EditsThatOverlapAreNotJoined) {
  const FileId file(0);
  std::vector<Edit> twice = {{{file, 1, 2}, "x"}, {{file, 1, 2}, "x"}};
  EXPECT_TRUE(make_disjoint(twice));
  EXPECT_EQ(apply_edits("abc", twice), "axc");
  std::vector<Edit> beside = {{{file, 2, 3}, "y"}, {{file, 0, 2}, ""}};
  EXPECT_TRUE(make_disjoint(beside));
  EXPECT_EQ(apply_edits("abc", beside), "y");
  std::vector<Edit> overlap = {{{file, 0, 2}, ""}, {{file, 1, 3}, ""}};
  EXPECT_FALSE(make_disjoint(overlap));
  std::vector<Edit> same_place = {{{file, 1, 1}, "x"}, {{file, 1, 1}, "y"}};
  EXPECT_FALSE(make_disjoint(same_place));
}

// --- patches -----------------------------------------------------------------

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

/// What `patch` makes of it; an error is a text that nobody expects.
std::string patched(const std::string& before, const std::string& patch) {
  const std::vector<std::string> old = lines_of(before);
  std::string out;
  std::size_t at = 0;
  char last = ' ';
  for (const std::string& line : lines_of(patch)) {
    if (line.starts_with("---") || line.starts_with("+++")) continue;
    if (line.starts_with("@@ -")) {
      const auto first = std::stoul(line.substr(4));
      const bool empty = line.substr(0, line.find(" +")).ends_with(",0");
      const std::size_t begin = empty ? first : first - 1;
      while (at < begin) out += old[at++];
    } else if (line.starts_with("\\")) {
      if (last != '-') out.pop_back();
    } else if (line[0] == '+') {
      out += line.substr(1);
    } else {
      std::string known = at < old.size() ? old[at] : "nothing";
      if (!known.ends_with('\n')) known += '\n';
      if (known != line.substr(1)) return "wrong context: " + line;
      if (line[0] == ' ') out += line.substr(1);
      ++at;
    }
    last = line[0];
  }
  while (at < old.size()) out += old[at++];
  return out;
}

TEST(UnifiedDiff, IsWhatOneExpects) {
  EXPECT_EQ(unified_diff("x", "a\n", "a\n"), "");
  EXPECT_EQ(unified_diff("x", "a\nb\nc\nd\ne\nf\n", "a\nb\nc\nd\nX\nf\n"),
            "--- x\n+++ x\n@@ -2,5 +2,5 @@\n b\n c\n d\n-e\n+X\n f\n");
  EXPECT_EQ(unified_diff("x", "", "a\n"), "--- x\n+++ x\n@@ -0,0 +1 @@\n+a\n");
}

TEST(UnifiedDiff, MakesTheOtherText) {
  std::mt19937 random(3);
  for (int run = 0; run < 300; ++run) {
    std::string a;
    std::string b;
    const auto length = random() % 30;
    for (std::size_t i = 0; i < length; ++i) {
      const std::string line = std::string(1, "abcd"[random() % 4]) + "\n";
      if (random() % 6 != 0) a += line;
      if (random() % 6 != 0) b += line;
    }
    if (a != b) {
      EXPECT_EQ(patched(a, unified_diff("x", a, b)), b) << a << "and\n" << b;
    }
  }
}

TEST(UnifiedDiff, AFileWithoutItsLastLineEnd) {
  const std::string patch = unified_diff("x", "a\nb", "a\nc");
  EXPECT_EQ(patch,
            "--- x\n+++ x\n@@ -1,2 +1,2 @@\n a\n-b\n\\ No newline at end of "
            "file\n+c\n\\ No newline at end of file\n");
}

TEST(UnifiedDiff, ManyChangesAreOneWhereTheSearchIsTooLong) {
  std::string a;
  std::string b;
  for (int i = 0; i < 4000; ++i) {
    a += std::to_string(i) + "\n";
    b += std::to_string(i * 7 % 4001) + "\n";
  }
  EXPECT_EQ(patched(a, unified_diff("x", a, b)), b);
}

}  // namespace
}  // namespace rung
