// docs/semantics.md is made from the tables of languages and presets.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "frontend/recognise.h"
#include "frontend/semantics.h"

namespace rung {
namespace {

std::string_view coils(CoilOrder order) {
  switch (order) {
    case CoilOrder::Document:
      return "as they stand";
    case CoilOrder::Position:
      return "by row, then column";
    case CoilOrder::Snapshot:
      return "a network at a time";
    case CoilOrder::ColumnMajor:
      return "by column";
  }
  return "";
}

std::string ticked(std::string_view name) {
  return "`" + std::string(name) + "`";
}

std::string languages_of(const Semantics& preset) {
  std::string names;
  for (const Language& language : languages()) {
    if (!language.has_preset(preset.name)) continue;
    names += (names.empty() ? "" : ", ") + ticked(language.name);
  }
  return names;
}

std::string page() {
  std::string out =
      "# Semantics\n\n"
      "The same drawing or list does not mean the same in every tool: timers\n"
      "fire a scan earlier or later, coils are written in another order, an\n"
      "input is sampled once a scan or at each read. A preset is a whole "
      "policy\n"
      "under the name of the tool that has it. `--semantics NAME` chooses "
      "one;\n"
      "every report names the one that its verdicts are about, and\n"
      "`rungproof prove --sweep` proves under all that fit the language and "
      "says\n"
      "which verdicts depend on it.\n\n"
      "This page is made from `frontend/semantics.cpp`: a test compares the "
      "two,\n"
      "and `RUNG_UPDATE=1` writes it anew.\n\n"
      "## Languages\n\n"
      "| language | presets; the first is the default unless the text decides "
      "|\n"
      "|---|---|\n";
  for (const Language& language : languages()) {
    if (!language.supported()) continue;
    out += "| " + ticked(language.name) + " |";
    for (const std::string_view preset : language.presets) {
      out += " " + ticked(preset);
    }
    out += " |\n";
  }
  out +=
      "\n## Presets\n\n"
      "`elements` is the dialect of the timers, counters and edges in\n"
      "`docs/elements.md`.\n";
  for (const Semantics& preset : semantics_presets()) {
    out += "\n### " + std::string(preset.name) + "\n\n" +
           std::string(preset.summary) + "\n\n";
    out +=
        "Of " + languages_of(preset) + "; elements " + ticked(preset.elements) +
        "; coils " + std::string(coils(preset.order)) + "; inputs " +
        (preset.input_image ? "sampled once a scan" : "sampled at each read") +
        ".\n";
  }
  return out;
}

TEST(SemanticsPage, IsMadeFromTheTables) {
  const std::string path = std::string(RUNG_ROOT) + "/docs/semantics.md";
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(path) << page();
    return;
  }
  std::stringstream actual;
  actual << std::ifstream(path).rdbuf();
  EXPECT_EQ(actual.str(), page()) << "RUNG_UPDATE=1 rewrites " << path;
}

TEST(Semantics, EveryPresetFitsALanguageAndEveryNameIsOne) {
  for (const Semantics& preset : semantics_presets()) {
    EXPECT_NE(languages_of(preset), "") << preset.name;
  }
  for (const Language& language : languages()) {
    for (const std::string_view name : language.presets) {
      EXPECT_NE(find_semantics(name), nullptr) << language.name << " " << name;
    }
  }
}

}  // namespace
}  // namespace rung
