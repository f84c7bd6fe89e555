#include "reports/unicode.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(Decode, TakesWellFormedSequences) {
  EXPECT_EQ(decode("A", 0).code, 0x41U);
  EXPECT_EQ(decode("\xc3\xb6", 0).code, 0xf6U);
  EXPECT_EQ(decode("\xe2\x82\xac", 0).code, 0x20acU);
  EXPECT_EQ(decode("\xf0\x9f\x94\xa5", 0).code, 0x1f525U);
  EXPECT_EQ(decode("\xf0\x9f\x94\xa5", 0).bytes, 4U);
}

TEST(Decode, RefusesEverythingElseByteByByte) {
  for (const std::string_view bad :
       {"\xff", "\x80", "\xc0\x80", "\xc3", "\xc3z", "\xe2\x82", "\xed\xa0\x80",
        "\xe0\x80\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80",
        "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(decode(bad, 0).valid) << bad;
    EXPECT_EQ(decode(bad, 0).bytes, 1U) << bad;
  }
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("a\x1b[31m"), "a\\x1b[31m");
  EXPECT_EQ(printable("\r\n"), "\\x0d\\x0a");
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xe2\x80\xae"), "\\u{202e}");
  EXPECT_EQ(printable("\xef\xbb\xbfx"), "\\u{feff}x");
  EXPECT_EQ(printable("\xc2\x85"), "\\x85");
}

TEST(Printable, TabsEndAtMultiplesOfFour) {
  EXPECT_EQ(printable("\tx"), "    x");
  EXPECT_EQ(printable("abc\tx"), "abc x");
  EXPECT_EQ(printable("abcd\tx"), "abcd    x");
}

TEST(PrintableWidth, CountsColumns) {
  EXPECT_EQ(printable_width("abc"), 3U);
  EXPECT_EQ(printable_width("\xe6\xb0\xb4"), 2U);      // a wide character
  EXPECT_EQ(printable_width("e\xcc\x81"), 1U);         // a combining accent
  EXPECT_EQ(printable_width("\xf0\x9f\x94\xa5"), 2U);  // an emoji
}

TEST(ValidUtf8, ReplacesOnlyBadBytes) {
  EXPECT_EQ(valid_utf8("\xc3\xb6\xff\x41"), "\xc3\xb6\xef\xbf\xbd\x41");
  EXPECT_EQ(valid_utf8("\xef\xbf\xbf"), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace rung
