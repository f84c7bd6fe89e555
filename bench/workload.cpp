#include "workload.h"

#include <cstdio>
#include <cstdlib>

#include "base/diagnostic.h"
#include "frontend/script/reader.h"

namespace rung::bench {
namespace {

std::string motor(const std::string& cell, const std::string& previous) {
  const std::string lock = previous.empty() ? "" : " && !Motor" + previous;
  return "Motor" + cell + " = (Start" + cell + " || Motor" + cell +
         ") && !Stop" + cell + lock + ";\n";
}

}  // namespace

std::string plant_text(std::size_t rungs) {
  std::string lines = "//@ language script\n";
  std::string text;
  std::string previous;
  for (std::size_t i = 0; i < rungs; ++i) {
    const std::string cell = std::to_string(i / 4);
    switch (i % 4) {
      case 0:
        lines += "//@ input Start" + cell + "\n//@ input Stop" + cell + "\n";
        lines += "//@ output Motor" + cell + "\n";
        lines += "//@ always Stop" + cell + " -> !Motor" + cell + "\n";
        text += motor(cell, previous);
        break;
      case 1:
        lines += "//@ never Run" + cell + " && !Motor" + cell + "\n";
        text += "Run" + cell + " = T(" + cell + ", 2, Motor" + cell + ");\n";
        break;
      case 2:
        lines += "//@ input Part" + cell + "\n";
        text += "Full" + cell + " = C(" + cell + ", 5, Part" + cell +
                ", false, Stop" + cell + ");\n";
        break;
      default:
        text += "Hot" + cell + " = IW0 > 700 && Full" + cell + ";\n";
        previous = cell;
    }
  }
  return lines + text;
}

Workload::Workload(const std::string& text) {
  file = sources.add("plant", text);
  DiagnosticList diagnostics;
  const Ast ast = read_script(sources, file, "sim", diagnostics);
  program = build_program(ast, {}, diagnostics);
  if (!diagnostics.has_errors()) {
    properties = read_properties(program, {}, sources, diagnostics);
  }
  if (!diagnostics.has_errors()) return;
  for (const Diagnostic& diagnostic : diagnostics.items()) {
    std::fprintf(stderr, "%s\n", diagnostic.message.c_str());
  }
  std::abort();
}

}  // namespace rung::bench
