#include "reports/sarif_rules.h"

#include <fmt/format.h>

namespace rung {
namespace {

/// What the rules say that are not lint rules.
struct VerdictRule {
  std::string_view summary;
  std::string_view help;
};

VerdictRule verdict_rule(Verdict verdict) {
  switch (verdict) {
    case Verdict::Proved:
      return {"a proved property", "It holds in every reachable state."};
    case Verdict::Violated:
      return {"a property that does not hold",
              "A run of the program breaks the property; the code flow shows "
              "it scan by scan. It was replayed on the simulator. Of a `reach` "
              "property: its state was proved unreachable."};
    case Verdict::Bounded:
      return {"a property that was searched, but not proved",
              "No run of up to the given number of scans breaks the property. "
              "Longer runs may. Give more time (`--timeout`) or another engine "
              "(`--engine`)."};
    case Verdict::Vacuous:
      return {"a property that holds for a wrong reason",
              "Its left side or its assumptions can never be true, so it says "
              "nothing about the program."};
    case Verdict::Unknown:
      return {"a property that could not be decided",
              "The message gives the reason. It is neither proved nor broken."};
  }
  return {};
}

/// The first paragraph under a Markdown heading.
std::string_view paragraph(std::string_view doc, std::string_view heading) {
  std::size_t at = doc.find(heading);
  if (at == std::string_view::npos) return {};
  at = doc.find_first_not_of('\n', at + heading.size());
  if (at == std::string_view::npos) return {};
  const std::size_t end = std::min(doc.find("\n\n", at), doc.find("\n#", at));
  return doc.substr(at, end == std::string_view::npos ? end : end - at);
}

Json text(std::string_view value) { return {{"text", value}}; }

Json lint_rule(const Rule& rule) {
  std::string_view finds = paragraph(rule.doc, "## Finds");
  while (finds.ends_with('\n')) finds.remove_suffix(1);
  if (finds.empty()) finds = rule.name;
  return {{"id", rule.code},
          {"name", rule.name},
          {"shortDescription", text(finds)},
          {"fullDescription", text(finds)},
          {"help", {{"text", rule.doc}, {"markdown", rule.doc}}},
          {"defaultConfiguration", {{"level", to_string(rule.severity)}}},
          {"properties",
           {{"tags", Json::array({"lint", rule.decision == Decision::Solver
                                              ? "solver"
                                              : "syntax"})}}}};
}

Json plain_rule(std::string_view id, std::string_view summary,
                std::string_view help, std::string_view level,
                std::string_view tag) {
  return {{"id", id},
          {"shortDescription", text(summary)},
          {"fullDescription", text(summary)},
          {"help", {{"text", help}, {"markdown", help}}},
          {"defaultConfiguration", {{"level", level}}},
          {"properties", {{"tags", Json::array({tag})}}}};
}

}  // namespace

std::string verdict_rule_id(Verdict verdict) {
  return fmt::format("property-{}", to_string(verdict));
}

std::size_t SarifRules::index_of(const Diagnostic& finding) {
  const auto found = indices_.find(finding.code);
  if (found != indices_.end()) return found->second;
  for (const Rule* rule : report_.rules) {
    if (rule->code == finding.code) {
      return add(std::string(finding.code), lint_rule(*rule));
    }
  }
  const bool input = is_input_error(finding);
  return add(
      std::string(finding.code),
      plain_rule(finding.code,
                 input ? "an input that cannot be read" : rule_name(finding),
                 input ? "Nothing is said about a program with such an "
                         "error: what cannot be read is never skipped."
                       : rule_name(finding),
                 to_string(finding.severity), input ? "input" : "lint"));
}

std::size_t SarifRules::index_of(Verdict verdict) {
  const std::string id = verdict_rule_id(verdict);
  const auto found = indices_.find(id);
  if (found != indices_.end()) return found->second;
  const VerdictRule rule = verdict_rule(verdict);
  return add(id, plain_rule(id, rule.summary, rule.help,
                            verdict == Verdict::Violated ? "error" : "warning",
                            "property"));
}

std::size_t SarifRules::add(const std::string& id, Json rule) {
  indices_.emplace(id, rules_.size());
  rules_.push_back(std::move(rule));
  return rules_.size() - 1;
}

}  // namespace rung
