#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "analysis/element.h"

namespace rung {
namespace {

std::string operand_list(const ElementOperation& operation) {
  std::string out;
  for (const ElementParameter& parameter : operation.parameters) {
    out += (out.empty() ? "" : ", ") + std::string(parameter.name);
  }
  return out;
}

std::string type_text(const ElementState& state) {
  switch (state.type) {
    case StateType::Bit:
      return "bit";
    case StateType::Clock:
      return "ms, running while `" + std::string(state.running) + "`";
    case StateType::Count:
      return "count, `" + std::string(state.low) + "` to `" +
             std::string(state.high) + "`";
  }
  return "";
}

bool is_state(const ElementKind& kind, std::string_view name) {
  for (const ElementState& state : kind.states) {
    if (state.name == name) return true;
  }
  return false;
}

void describe(const ElementKind& kind, std::string& out) {
  out += "## " + std::string(kind.id) + "\n\n" + std::string(kind.summary) +
         "\n\n";
  out +=
      "Dialect: " + (kind.dialect.empty() ? "all" : std::string(kind.dialect)) +
      ". Source: " + std::string(kind.source) + ".\n\n";
  out += "State, all 0 before the first scan:\n\n";
  for (const ElementState& state : kind.states) {
    out += "- `" + std::string(state.name) + "`: " + type_text(state) + "\n";
  }
  for (const ElementOperation& operation : kind.operations) {
    out += "\n`" + std::string(operation.name) + "(" + operand_list(operation) +
           (operation.reads ? ")`, changes nothing:" : ")`, step:") +
           "\n\n```\n";
    for (const ElementUpdate& update : operation.updates) {
      out += std::string(update.state);
      out += is_state(kind, update.state) ? "' = " : " = ";
      out += std::string(update.value) + "\n";
    }
    out += "result = " + std::string(operation.result) + "\n```\n";
  }
  if (!kind.done.empty()) {
    const bool indexed = kind.is_in("yun") || kind.is_in("sim");
    const std::string name =
        !indexed ? std::string("name") : std::string(kind.letter) + "(n)";
    out += "\nIn properties: `" + name + ".q` is `" + std::string(kind.done) +
           "`, `" + name + "." +
           (kind.family == ElementFamily::Timer ? "elapsed" : "value") +
           "` is `" + std::string(kind.value) + "`.\n";
  }
  out += "\n";
}

std::string reference_page() {
  std::string out =
      "# Elements\n\n"
      "Timers, counters and edges, exactly as the transition system has them.\n"
      "This page is made from `analysis/elements.cpp`: a test compares the\n"
      "two, and `RUNG_UPDATE=1` writes it anew.\n\n"
      "`n` is the index: calls of one kind with one index share their state.\n"
      "`p` is the time operand in ms (`d` seconds, `PT`) or the count "
      "operand.\n"
      "A primed name is the value after the lines above. `any` is a free bit:\n"
      "there the encoding allows more runs than the program has, which keeps\n"
      "proofs sound; traces are checked by the simulator in any case.\n\n";
  for (const ElementKind& kind : element_kinds()) describe(kind, out);
  out.pop_back();
  return out;
}

TEST(ElementsPage, IsMadeFromTheDefinitions) {
  const std::string path = std::string(RUNG_ROOT) + "/docs/elements.md";
  const std::string expected = reference_page();
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(path) << expected;
    return;
  }
  std::stringstream actual;
  actual << std::ifstream(path).rdbuf();
  EXPECT_EQ(actual.str(), expected) << "RUNG_UPDATE=1 rewrites " << path;
}

}  // namespace
}  // namespace rung
