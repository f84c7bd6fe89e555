#include "frontend/props_yaml.h"

#include <gtest/gtest.h>

#include <string>

namespace rung::test {
namespace {

TEST(PropsYaml, APropertyStandsOnTheLineOfItsExpression) {
  const YamlProperties made = read_properties_yaml(
      "# of a motor\n"
      "properties:\n"
      "  - id: P1\n"
      "    kind: invariant   # always\n"
      "    expression: \"run || !on\"\n"
      "    description: \"why: because\"\n"
      "\n"
      "  - id: P2\n"
      "    kind: absence\n"
      "    expression: run && stop\n"
      "  - id: P3\n"
      "    kind: reachability\n"
      "    expression: 'run'\n"
      "    justification: it must start\n"
      "  - id: P4\n"
      "    kind: mutual_exclusion\n"
      "    variables: [up, down, halt]\n");
  EXPECT_EQ(made.error, "");
  EXPECT_EQ(made.lines,
            "\n\n\n\nP1: always run || !on\n\n\n\n\n"
            "P2: never run && stop\n\n\nP3: reach run\n\n\n\n"
            "P4: interlock up, down, halt\n");
}

TEST(PropsYaml, RefusesWhatItDoesNotRead) {
  const std::string head = "properties:\n";
  const std::string entry = head + "- id: P\n";
  for (const std::string& text : {
           std::string("kind: invariant\n"),
           head + "id: P\n",
           head + "text\n",
           entry,
           entry + "  kind: invariant\n",
           entry + "  kind: response\n  expression: a\n",
           entry + "  kind: invariant\n  trigger: a\n",
           entry + "  kind: invariant\n  expression: |\n    a\n",
           entry + "  kind: invariant\n  expression: \"a\n",
           entry + "  kind: invariant\n  expression: \"a\\n\"\n",
           entry + "  kind: invariant\n  expression: \"a\" b\n",
           entry + "  kind: invariant\n  expression: a\n  expression: b\n",
           head + "-\n",
           head + "- kind: absence\n  expression: a\n",
       }) {
    EXPECT_NE(read_properties_yaml(text).error, "") << text;
  }
  EXPECT_EQ(
      read_properties_yaml(head + "- id: P\n- id: Q\n").error.substr(0, 7),
      "line 3:");
}

TEST(PropsYaml, IsRecognised) {
  EXPECT_TRUE(is_properties_yaml("# x\n\nproperties:\n"));
  EXPECT_FALSE(is_properties_yaml("never a && b\n"));
  EXPECT_FALSE(is_properties_yaml(""));
}

}  // namespace
}  // namespace rung::test
