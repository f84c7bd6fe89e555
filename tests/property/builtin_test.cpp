#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sample.h"

namespace rung {
namespace {

std::string builtins(const ReadLines& read) {
  std::string text;
  for (const Property& property : read.set.properties) {
    if (!property.built_in) continue;
    text += property.name + " " + property.formulas[0] + "\n";
  }
  return text;
}

TEST(Builtins, AreAskedOfEveryLatchOutputTimerAndCounter) {
  EXPECT_EQ(builtins(ReadLines("")),
            "builtin.Q0.settable rose(Q0)\n"
            "builtin.Q0.releasable fell(Q0)\n"
            "builtin.Q1.can-become-true rose(Q1)\n"
            "builtin.Q1.can-become-false fell(Q1)\n"
            "builtin.Q2.can-become-true rose(Q2)\n"
            "builtin.Q2.can-become-false fell(Q2)\n"
            "builtin.Q3.can-become-true rose(Q3)\n"
            "builtin.Q3.can-become-false fell(Q3)\n"
            "builtin.Q4.can-become-true rose(Q4)\n"
            "builtin.Q4.can-become-false fell(Q4)\n"
            "builtin.T(0).can-fire T(0).fired\n"
            "builtin.C(0).can-fire C(0).fired\n");
}

TEST(Builtins, ComeAfterTheWrittenOnes) {
  const ReadLines read("z: never Q1\noutput M0");
  EXPECT_EQ(read.set.properties.front().name, "z");
  EXPECT_TRUE(read.set.properties.back().built_in);
  EXPECT_NE(builtins(read).find("builtin.M0.can-become-true"),
            std::string::npos);
}

TEST(Builtins, ALatchSaysWhatSetsAndWhatHoldsIt) {
  const std::string text = "Q0 = ((IW0 < 20) || Q0 || M1) && !I1;";
  SourceSet sources;
  DiagnosticList found;
  const FileId file = sources.add("latch.rung", text);
  const auto at = [&](const char* part) {
    const auto begin = static_cast<std::uint32_t>(text.find(part));
    const auto size = static_cast<std::uint32_t>(std::string(part).size());
    return SourceRange{file, begin, begin + size};
  };
  SampleProgram sample;
  sample.program.rungs = {};
  sample.program.nodes.clear();
  sample.read("I2");  // stands for the comparison
  sample.program.nodes.back().where = at("IW0 < 20");
  sample.read("Q0");
  sample.program.nodes.back().where = at("Q0 ||");
  const std::uint32_t set = sample.node({.op = NodeOp::Or, .a = 0, .b = 1});
  const std::uint32_t also = sample.read("M1");
  sample.program.nodes.back().where = at("M1");
  const std::uint32_t any =
      sample.node({.op = NodeOp::Or, .a = set, .b = also});
  const std::uint32_t stop = sample.read("I1");
  const std::uint32_t no_stop = sample.node({.op = NodeOp::Not, .a = stop});
  sample.program.nodes.back().where = at("!I1");
  sample.node({.op = NodeOp::And, .a = any, .b = no_stop});
  sample.rung("Q0", 0);
  const PropertySet set_of =
      read_properties(sample.program, {}, sources, found);
  EXPECT_EQ(set_of.properties.front().text,
            "`Q0` latches itself, set by `M1` and `IW0 < 20`, held while "
            "`!I1`: some run sets it");
}

TEST(Builtins, AToggleIsNoLatch) {
  SampleProgram sample;
  const std::uint32_t begin = sample.read("M1");
  sample.node({.op = NodeOp::Not, .a = begin});
  sample.rung("M1", begin);
  SourceSet sources;
  DiagnosticList found;
  const PropertySet set = read_properties(sample.program, {}, sources, found);
  for (const Property& property : set.properties) {
    EXPECT_NE(property.name, "builtin.M1.settable");
  }
}

TEST(Builtins, EachBecomesAReachObligation) {
  ReadLines read("");
  TransitionSystem ts = build_transition_system(read.sample.program);
  for (const Obligation& obligation :
       make_obligations(read.sample.program, read.set, ts)) {
    EXPECT_EQ(obligation.goal, Goal::Reach);
    EXPECT_EQ(obligation.kind, "built-in");
    EXPECT_TRUE(obligation.built_in);
    EXPECT_FALSE(obligation.text.empty());
  }
}

}  // namespace
}  // namespace rung
