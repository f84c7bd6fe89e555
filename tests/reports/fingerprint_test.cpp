#include "reports/fingerprint.h"

#include <gtest/gtest.h>

#include "reports/paths.h"

namespace rung {
namespace {

TEST(Fingerprints, StayWhenALineIsIndentedAnew) {
  Fingerprints one;
  Fingerprints other;
  EXPECT_EQ(one.next("RP101", "a.rung", "Q0 = I0;"),
            other.next("RP101", "a.rung", "  Q0\t=  I0;\r"));
}

TEST(Fingerprints, DifferByRulePathAndText) {
  Fingerprints prints;
  const std::string first = prints.next("RP101", "a", "x");
  EXPECT_NE(first, prints.next("RP102", "a", "x"));
  EXPECT_NE(first, prints.next("RP101", "b", "x"));
  EXPECT_NE(first, prints.next("RP101", "a", "y"));
  EXPECT_NE(prints.next("RP1", "01a", "x"), prints.next("RP10", "1a", "x"));
}

TEST(Fingerprints, CountEqualOnes) {
  Fingerprints prints;
  const std::string first = prints.next("RP101", "a", "x");
  const std::string second = prints.next("RP101", "a", "x");
  EXPECT_TRUE(first.ends_with(":1"));
  EXPECT_TRUE(second.ends_with(":2"));
}

TEST(Fingerprints, AreTheSameForEver) {
  EXPECT_EQ(Fingerprints().next("RP101", "a.rung", "Q0 = I0;"),
            "320ec0a8bb1c69f4:1");
}

TEST(Paths, AreRelativeBelowTheDirectory) {
  EXPECT_EQ(relative_path("/home/user/a.rung", "/home/user"), "a.rung");
  EXPECT_EQ(relative_path("/home/user2/a.rung", "/home/user"),
            "/home/user2/a.rung");
  EXPECT_EQ(relative_path("./a.rung", "/home/user"), "a.rung");
  EXPECT_EQ(relative_path("../a.rung", ""), "../a.rung");
}

TEST(Paths, AreEncodedAsUris) {
  EXPECT_EQ(path_uri("a b/m\xc3\xb6%.rung"), "a%20b/m%C3%B6%25.rung");
  EXPECT_EQ(path_uri("/x y"), "file:///x%20y");
}

}  // namespace
}  // namespace rung
