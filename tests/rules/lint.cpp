#include "lint.h"

#include <algorithm>

#include "analysis/property.h"
#include "analysis/transition_system.h"
#include "explicit_oracle.h"
#include "frontend/recognise.h"

namespace rung::testing {
namespace {

std::string place(const SourceSet& sources, SourceRange where) {
  if (!where.has_value()) return "?";
  const LineColumn at = sources[where.file].position(where.begin);
  return std::to_string(at.line) + ":" + std::to_string(at.column);
}

}  // namespace

OracleMaker explicit_oracle() {
  return [](const Program&, TransitionSystem& ts) {
    return std::make_unique<ExplicitOracle>(ts);
  };
}

OracleMaker no_oracle() {
  return [](const Program&, TransitionSystem&) {
    return std::unique_ptr<Oracle>();
  };
}

Linted& lint(std::string_view text, Linted& linted,
             const OracleMaker& make_oracle) {
  const FileId file = linted.sources.add("test.rung", std::string(text));
  DiagnosticList sink;
  const Language& language = recognise(text);
  const Ast ast = language.read(linted.sources, file, {}, sink);
  BuildOptions options;
  options.scan = {100, 100};
  if (!sink.has_errors()) {
    Program program = build_program(ast, options, sink);
    const PropertySet properties =
        read_properties(program, {}, linted.sources, sink);
    if (!sink.has_errors()) {
      TransitionSystem ts = build_transition_system(program);
      make_obligations(program, properties, ts);
      const std::unique_ptr<Oracle> oracle = make_oracle(program, ts);
      linted.summary = run_rules(
          {linted.sources, program, properties, ts, oracle.get(), linted.rules},
          sink);
    }
  }
  for (Diagnostic& finding : sink.take()) {
    (finding.waiver ? linted.waived : linted.findings)
        .push_back(std::move(finding));
  }
  return linted;
}

bool has_finding(const Linted& linted, std::string_view rule) {
  return std::any_of(
      linted.findings.begin(), linted.findings.end(),
      [&](const Diagnostic& finding) { return finding.rule == rule; });
}

std::string to_text(const Linted& linted) {
  std::string text;
  for (const Diagnostic& finding : linted.waived) {
    text += place(linted.sources, finding.where) + " allowed " +
            std::string(finding.code) + " " + std::string(finding.rule) + ": " +
            finding.waiver->reason + "\n";
  }
  for (const Diagnostic& finding : linted.findings) {
    text += place(linted.sources, finding.where) + " " +
            std::string(to_string(finding.severity)) + " " +
            std::string(finding.code) + " " + std::string(finding.rule) + ": " +
            finding.message + "\n";
    for (const Label& label : finding.labels) {
      text +=
          "  " + place(linted.sources, label.where) + " " + label.text + "\n";
    }
    if (!finding.help.empty()) text += "  help: " + finding.help + "\n";
  }
  return text;
}

}  // namespace rung::testing
