#include <fmt/format.h>

#include "analysis/rule.h"
#include "app/commands.h"
#include "app/output.h"
#include "base/text.h"

namespace rung {
namespace {

std::string table() {
  std::string out;
  for (const Rule* rule : all_rules()) {
    out += fmt::format("{:<6} {:<8} {:<7} {:<9} {}\n", rule->code,
                       to_string(rule->severity),
                       rule->decision == Decision::Solver ? "solver" : "syntax",
                       to_string(rule->pack), rule->name);
  }
  return out;
}

std::string page(const Rule& rule) {
  std::string_view doc = rule.doc;
  while (doc.starts_with('\n')) doc.remove_prefix(1);
  return fmt::format(
      "# {}: {}\n\n{}, decided {}, pack `{}`\n\n{}", rule.code, rule.name,
      to_string(rule.severity),
      rule.decision == Decision::Solver ? "by the solver" : "on the syntax",
      to_string(rule.pack), doc);
}

std::string unknown_rule(const std::string& wanted) {
  std::vector<std::string_view> known;
  for (const Rule* rule : all_rules()) {
    known.push_back(rule->code);
    known.push_back(rule->name);
  }
  return fmt::format("there is no rule `{}`{}; `rungproof rule` lists them",
                     wanted, did_you_mean(wanted, known));
}

}  // namespace

int run_rule(const Options& options) {
  if (options.rule.empty()) return print_out(table()) ? 0 : kExitUsage;
  const Rule* rule = find_rule(options.rule);
  if (rule == nullptr) return usage_error(unknown_rule(options.rule));
  return print_out(page(*rule)) ? 0 : kExitUsage;
}

}  // namespace rung
