#include "tests/reports/page_check.h"

#include <gtest/gtest.h>

namespace rung::test {
namespace {

std::string with(const std::string& body) {
  return problems_of("<html><body>" + body + "</body></html>");
}

TEST(PageCheck, AcceptsWhatIsRight) {
  EXPECT_EQ(with("<p id=\"a\">&lt;<a href=\"#a\">x</a></p>"), "");
}

TEST(PageCheck, RefusesWhatIsNot) {
  for (const std::string body :
       {"<p>", "<p>&</p>", "<p><</p>", "<p>&nbsp;</p>", "<p>\x01</p>",
        "<p>\xff</p>", "<p>\xef\xbf\xbe</p>", "<p class=\"a\" class=\"b\"/>",
        "<script>1</script>", "<p onclick=\"x\"/>", "<img src=\"x\"/>",
        "<p id=\"a\"/><p id=\"a\"/>", "<a href=\"#b\">x</a>",
        "<a href=\"https://example.org\">x</a>", "<p style=\"x\"/>",
        "<style>p{background:url(x)}</style>"}) {
    EXPECT_NE(with(body), "") << body;
  }
}

}  // namespace
}  // namespace rung::test
