#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "analysis/transition_system.h"
#include "explicit_oracle.h"
#include "lint.h"
#include "random_script.h"
#include "smt/oracle.h"

namespace rung::testing {
namespace {

struct Tally {
  std::size_t decided = 0;  // by both
  std::size_t questions = 0;
  std::string contradictions;
};

/// Asks the engines and the explicit search, and compares.
class BothOracles : public Oracle {
 public:
  BothOracles(const Program& program, TransitionSystem& ts, Tally& tally)
      : engines_(program, ts), search_(ts), ts_(ts), tally_(tally) {}

  std::vector<Evidence> answer(
      const std::vector<Question>& questions) override {
    std::vector<Evidence> found = engines_.answer(questions);
    const std::vector<Evidence> known = search_.answer(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      ++tally_.questions;
      if (found[i].answer == Answer::Unknown ||
          known[i].answer == Answer::Unknown) {
        continue;
      }
      ++tally_.decided;
      if (found[i].answer == known[i].answer) continue;
      tally_.contradictions += to_string(ts_, questions[i].condition) + " is " +
                               (found[i].answer == Answer::Yes ? "" : "not ") +
                               "always true, says " + found[i].engine + "\n";
    }
    return found;
  }

 private:
  SolverOracle engines_;
  ExplicitOracle search_;
  TransitionSystem& ts_;
  Tally& tally_;
};

OracleMaker both(Tally& tally) {
  return [&tally](const Program& program, TransitionSystem& ts) {
    return std::make_unique<BothOracles>(program, ts, tally);
  };
}

TEST(OracleAgreement, RandomPrograms) {
  Tally tally;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::string script = RandomScript(seed).text();
    const std::size_t before = tally.contradictions.size();
    Linted linted;
    lint(script, linted, both(tally));
    EXPECT_EQ(tally.contradictions.size(), before)
        << script << tally.contradictions.substr(before);
  }
  // The comparison is worth something only when it compares.
  EXPECT_GT(tally.decided, 40U);
  RecordProperty("questions", static_cast<int>(tally.questions));
  RecordProperty("decided", static_cast<int>(tally.decided));
}

TEST(OracleAgreement, Goldens) {
  namespace fs = std::filesystem;
  Tally tally;
  for (const auto& entry :
       fs::directory_iterator(fs::path(RUNG_ROOT) / "tests/rules/golden")) {
    // Its timer runs for weeks: too many scans to visit one by one.
    if (entry.path().stem() == "preset-out-of-scan.bad") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string all = text.str();
    const std::size_t before = tally.contradictions.size();
    Linted linted;
    lint(all.substr(0, all.find("// --- expected")), linted, both(tally));
    EXPECT_EQ(tally.contradictions.size(), before)
        << entry.path() << "\n"
        << tally.contradictions.substr(before);
  }
  EXPECT_GT(tally.decided, 50U);
}

}  // namespace
}  // namespace rung::testing
