// Certificates of `recoverable`: which ways back are believed.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "confirm.h"
#include "random_run.h"

namespace rung {
namespace {

constexpr std::string_view kProgram = R"(//@ off: recoverable !Q0
//@ on: recoverable Q1
//@ both: recoverable Q0 && !Q0
//@ assume !(I1 && I2)
Q0 = (I0 || Q0) && !I1;
Q1 = T(0, 2, I0);
QW0 = IW0;
Q2 = I2;
)";

using Texts = std::vector<std::string>;

class WaysTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    read_ = read_program("sim", std::string(kProgram), error);
    ASSERT_TRUE(read_) << error;
  }

  /// Of each list of ways to the goal of the property `name`.
  std::vector<std::string> outcomes(const std::string& name,
                                    const std::string& formula,
                                    const std::vector<Texts>& lists) {
    Confirmation confirmation;
    for (const Texts& ways : lists) {
      check::ClaimedResult claimed;
      check::ClaimedProperty& property = claimed.properties.emplace_back();
      property.name = name;
      property.kind = "recoverable";
      property.text = name + ": recoverable " + formula;
      property.goal = "recover";
      property.verdict = "proved";
      property.has_certificate = true;
      property.ways = ways;
      confirmation.add(read_->program, read_->properties, claimed);
    }
    std::vector<std::string> result;
    for (const auto& checked : confirmation.ask()) {
      result.emplace_back(to_string(checked.front().outcome));
    }
    return result;
  }

  std::optional<ReadProgram> read_;
};

TEST_F(WaysTest, ThatLeadBackAreConfirmed) {
  for (const std::string& outcome :
       outcomes("off", "!Q0",
                {{"true: I1 = 1, I2 = 0"},
                 {"Q0: I1 = 1, I2 = 0"},
                 {"Q0: I1 = 1, I2 = 0", "!Q0: I1 = 1, I2 = 0"}})) {
    EXPECT_EQ(outcome, "confirmed");
  }
  for (const std::string& outcome : outcomes(
           "on", "Q1",
           {{"T(0).started && T(0).elapsed >= 1900: I0 = 1, dt = 100, "
             "I1 = 0",
             "T(0).started: I0 = 1, I1 = 0, until T(0).elapsed is large enough",
             "true: I0 = 1, I1 = 0"},
            {"T(0).started: I0 = 1, I1 = 0, until T(0).elapsed is large enough",
             "true: I0 = 1, I1 = 0"}})) {
    EXPECT_EQ(outcome, "confirmed");
  }
}

TEST_F(WaysTest, ThatDoNotAreRejected) {
  for (const std::string& outcome :
       outcomes("off", "!Q0",
                {{},
                 {"true"},
                 {"true: I1 = 0"},
                 {"true: I1 = 1"},  // and I2 may be true: not assumed
                 {"!Q0: I1 = 1, I2 = 0"},
                 {"true: I1 = 2, I2 = 0"},
                 {"true: I1 = 1, I1 = 1, I2 = 0"},
                 {"true: Q0 = 0, I2 = 0"},
                 {"true: nothing = 0"},
                 {"true: I1 = one"},
                 {"true: I1"},
                 {"true: "},
                 {": I1 = 1, I2 = 0"},
                 {"I1: I1 = 1, I2 = 0"},
                 {"QW0: I1 = 1, I2 = 0"},
                 {"true: dt = 0, I1 = 1, I2 = 0"},
                 {"true: until nothing is large enough"},
                 {"true: until Q0 is large enough"},
                 {"Q0: I1 = 0, until QW0 is large enough"}})) {
    EXPECT_EQ(outcome, "rejected");
  }
  for (const std::string& outcome : outcomes(
           "on", "Q1",
           {{"true: I0 = 1, I1 = 0"},
            {"T(0).started: I0 = 1, I1 = 0", "true: I0 = 1, I1 = 0"},
            // Round and round: each leads to the other.
            {"T(0).started: I0 = 0, I1 = 0", "!T(0).started: I0 = 1, I1 = 0"},
            {"true: I0 = 0, I1 = 0, until T(0).elapsed is large enough"},
            {"true: I0 = 1, I1 = 0, until T(0).elapsed is large enough"}})) {
    EXPECT_EQ(outcome, "rejected");
  }
  EXPECT_EQ(outcomes("both", "Q0 && !Q0", {{"true: I1 = 1, I2 = 0"}}),
            std::vector<std::string>{"rejected"});
}

}  // namespace
}  // namespace rung
