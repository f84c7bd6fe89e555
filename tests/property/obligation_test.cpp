#include <gtest/gtest.h>

#include <map>
#include <string>

#include "sample.h"

namespace rung {
namespace {

/// The obligations of property lines, with their terms as text.
class Obligations {
 public:
  explicit Obligations(const std::string& lines)
      : read(lines), ts(build_transition_system(read.sample.program)) {
    all = make_obligations(read.sample.program, read.set, ts);
  }
  const Obligation& named(const std::string& name) const {
    for (const Obligation& obligation : all) {
      if (obligation.name == name) return obligation;
    }
    ADD_FAILURE() << "no obligation " << name;
    return all.front();
  }
  std::string condition(const std::string& name) const {
    return to_string(ts, named(name).condition);
  }
  ReadLines read;
  TransitionSystem ts;
  std::vector<Obligation> all;
};

TEST(Obligations, OfALatchInTheirOrder) {
  const Obligations made("m: latch Q0 set I0 reset I1");
  const char* const names[] = {"m.settable", "m.sets",
                               "m.holds",    "m.releasable",
                               "m.resets",   "m.no-spurious-start"};
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(made.all[i].name, names[i]);
    EXPECT_EQ(made.all[i].part, i);
    EXPECT_EQ(made.all[i].kind, "latch");
    const Goal other = i == 3 ? Goal::Recover : Goal::Invariant;
    EXPECT_EQ(made.all[i].goal, i == 0 ? Goal::Reach : other);
    EXPECT_EQ(made.all[i].trigger.has_value(), i != 0);
  }
  EXPECT_EQ(made.condition("m.settable"), "!Q0 && (I0 || Q0) && !I1");
  EXPECT_EQ(made.condition("m.sets"), "!I0 || I1 || (I0 || Q0) && !I1");
  EXPECT_EQ(made.condition("m.holds"), "(I0 || Q0) && !I1 || !Q0 || I1");
  EXPECT_EQ(made.condition("m.resets"), "!I1 || !I0 && !Q0 || I1");
}

TEST(Obligations, ALatchIsReleasableWhenItCanAlwaysBeOffAgain) {
  const Obligations made(
      "m: latch Q0 set I0 reset I1\nr: recoverable Q0 && !I1");
  const Obligation& releasable = made.named("m.releasable");
  EXPECT_EQ(releasable.goal, Goal::Recover);
  EXPECT_EQ(made.condition("m.releasable"), "!I0 && !Q0 || I1");
  EXPECT_EQ(made.named("r").goal, Goal::Recover);
  EXPECT_EQ(made.named("r").kind, "recoverable");
  EXPECT_FALSE(made.named("r").trigger.has_value());
}

TEST(Obligations, HistoryIsSharedAndOfInputsOnly) {
  const Obligations made(
      "always prev(I0) -> I1 || !I1\nnever prev(I0) && !prev(I0)\n"
      "reach prev(Q0) && rose(I0)\nreach prev(T(0).q)");
  std::map<std::string, int> names;
  for (const State& state : made.ts.states)
    ++names[made.ts.vars[state.var].name];
  EXPECT_EQ(names["prev(I0)"], 1);
  EXPECT_EQ(names["prev(Q0)"], 0) << "the state itself";
  EXPECT_EQ(names["prev(T(0).q)"], 0) << "over the timer's own state";
}

TEST(Obligations, CarryTheirLineAndPlace) {
  const Obligations made("scan 1..5 ms\n  n: never Q1 && Q2  \n");
  const Obligation& never = made.named("n");
  EXPECT_EQ(never.kind, "never");
  EXPECT_EQ(made.read.sources.text(never.where), "  n: never Q1 && Q2  ");
  EXPECT_FALSE(never.trigger.has_value());
}

TEST(Obligations, InterlocksAreLinear) {
  std::string line = "interlock I0";
  for (int i = 0; i < 2000; ++i) {
    line += ", IW0 == " + std::to_string(i);
  }
  const Obligations made(line);
  EXPECT_LT(made.ts.exprs.size(), 20'000U);
}

}  // namespace
}  // namespace rung
