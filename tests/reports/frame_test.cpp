#include "reports/frame.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

/// The frame of the first place of each of `needles`; the first is primary.
std::string frame(const std::string& text,
                  const std::vector<std::string>& needles) {
  SourceSet sources;
  const FileId file = sources.add("m.rung", text);
  std::vector<Mark> marks;
  for (const std::string& needle : needles) {
    const std::size_t at = text.find(needle);
    EXPECT_NE(at, std::string::npos);
    const auto begin = static_cast<std::uint32_t>(at);
    marks.push_back(
        {{file, begin, begin + static_cast<std::uint32_t>(needle.size())},
         marks.empty() ? "" : "here",
         marks.empty()});
  }
  Locator locator(sources);
  return draw_frame(sources, marks, Ink::Error, Painter(false), locator);
}

TEST(Frame, MarksARangeOfOneLine) {
  EXPECT_EQ(frame("Q0 = I0;\nQ1 = I1;\n", {"I1"}),
            " --> m.rung:2:6\n"
            "  |\n"
            "2 | Q1 = I1;\n"
            "  |      ^^\n");
}

TEST(Frame, TabsTakeTheColumnsThatTheyAreShownWith) {
  EXPECT_EQ(frame("\tQ0 =\tI0;", {"I0"}),
            " --> m.rung:1:7\n"
            "  |\n"
            "1 |     Q0 =    I0;\n"
            "  |             ^^\n");
}

TEST(Frame, WideCharactersTakeTwoColumns) {
  EXPECT_EQ(frame("\xe6\xb0\xb4 = I0;", {"I0"}),
            " --> m.rung:1:5\n"
            "  |\n"
            "1 | \xe6\xb0\xb4 = I0;\n"
            "  |      ^^\n");
  EXPECT_EQ(frame("\xe6\xb0\xb4 = I0;", {"\xe6\xb0\xb4"}),
            " --> m.rung:1:1\n"
            "  |\n"
            "1 | \xe6\xb0\xb4 = I0;\n"
            "  | ^^\n");
}

TEST(Frame, LineEndsOfWindowsAreNotShown) {
  EXPECT_EQ(frame("Q0 = I0;\r\nQ1 = I1;\r\n", {"I0"}),
            " --> m.rung:1:6\n"
            "  |\n"
            "1 | Q0 = I0;\n"
            "  |      ^^\n");
}

TEST(Frame, ARangeOverManyLinesShowsItsEnds) {
  EXPECT_EQ(frame("Q0 = (I0\n  || I1\n  || I2\n  || I3\n  || I4);\n",
                  {"(I0\n  || I1\n  || I2\n  || I3\n  || I4)"}),
            " --> m.rung:1:6\n"
            "  |\n"
            "1 | Q0 = (I0\n"
            "  |      ^^^\n"
            "2 |   || I1\n"
            "  |   ^^^^^\n"
            "...\n"
            "5 |   || I4);\n"
            "  |   ^^^^^^\n");
}

TEST(Frame, ARangeThatEndsWithALineMarksNothingOfTheNext) {
  EXPECT_EQ(frame("Q0 = I0;\nQ1 = I1;\n", {"I0;\n"}),
            " --> m.rung:1:6\n"
            "  |\n"
            "1 | Q0 = I0;\n"
            "  |      ^^^\n");
}

TEST(Frame, OtherPlacesStandInTheOrderOfTheFile) {
  EXPECT_EQ(
      frame("Q0 = I0;\nM0 = I2;\nM1 = I3;\nQ0 = I1;\n", {"Q0 = I1", "Q0"}),
      " --> m.rung:4:1\n"
      "  |\n"
      "1 | Q0 = I0;\n"
      "  | -- here\n"
      "...\n"
      "4 | Q0 = I1;\n"
      "  | ^^^^^^^\n");
}

TEST(Frame, AnEmptyRangeHasOneMark) {
  EXPECT_EQ(frame("", {""}), " --> m.rung:1:1\n");
  EXPECT_EQ(frame("Q0", {""}),
            " --> m.rung:1:1\n"
            "  |\n"
            "1 | Q0\n"
            "  | ^\n");
}

TEST(Frame, LongLinesAreCutAroundTheMark) {
  std::string line(400, 'a');
  line += "NEEDLE";
  line += std::string(400, 'b');
  const std::string shown = frame(line, {"NEEDLE"});
  EXPECT_EQ(shown,
            " --> m.rung:1:401\n"
            "  |\n"
            "1 | ..." +
                std::string(40, 'a') + "NEEDLE" + std::string(74, 'b') +
                "...\n"
                "  | " +
                std::string(43, ' ') + "^^^^^^\n");
}

TEST(Locator, RisingRangesAreCountedFromTheLast) {
  SourceSet sources;
  const FileId file = sources.add("m",
                                  "a\n\xc3\xb6"
                                  "b\n\nc");
  Locator locator(sources);
  EXPECT_EQ(locator.of({file, 0, 1}).end.column, 2U);
  const Place second = locator.of({file, 4, 5});
  EXPECT_EQ(second.begin.line, 2U);
  EXPECT_EQ(second.begin.column, 2U);
  const Place last = locator.of({file, 7, 99});  // behind the end
  EXPECT_EQ(last.begin.line, 4U);
  EXPECT_EQ(last.end.column, 2U);
  EXPECT_EQ(locator.of({file, 2, 4}).end.column, 2U);  // backwards
}

}  // namespace
}  // namespace rung
