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
