#include "tests/reports/page_check.h"

#include <gtest/gtest.h>

#include "reports/assets.h"

namespace rung::test {
namespace {

std::string with(const std::string& body) {
  return problems_of("<html><body>" + body + "</body></html>");
}

TEST(PageCheck, AcceptsWhatIsRight) {
  EXPECT_EQ(with("<p id=\"a\">&lt;<a href=\"#a\">x</a></p>"), "");
  EXPECT_EQ(with("<script type=\"application/json\">{}</script>"), "");
  EXPECT_EQ(with("<script>" + std::string(kPageScript.text) + "</script>"), "");
}

TEST(PageCheck, RefusesWhatIsNot) {
  for (const std::string body :
       {"<p>", "<p>&</p>", "<p><</p>", "<p>&nbsp;</p>", "<p>\x01</p>",
        "<p>\xff</p>", "<p>\xef\xbf\xbe</p>", "<p class=\"a\" class=\"b\"/>",
        "<script>1</script>", "<script type=\"module\">1</script>",
        "<script src=\"x\"/>", "<p onclick=\"x\"/>", "<img src=\"x\"/>",
        "<p id=\"a\"/><p id=\"a\"/>", "<a href=\"#b\">x</a>",
        "<a href=\"https://example.org\">x</a>", "<p style=\"x\"/>",
        "<style>p{background:url(x)}</style>"}) {
    EXPECT_NE(with(body), "") << body;
  }
}

// Of FIPS 180-2 and RFC 4648: the hash of nothing.
TEST(ContentSecurityPolicy, NamesAnAssetByItsHashInBase64) {
  EXPECT_EQ(csp_source({"",
                        "e3b0c44298fc1c149afbf4c8996fb924"
                        "27ae41e4649b934ca495991b7852b855"}),
            "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

}  // namespace
}  // namespace rung::test
