#include "analysis/rules/suppress.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "analysis/rules/rule_run.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kAllow = "allow";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// One name of one `allow` line.
struct Permit {
  const Rule* rule = nullptr;
  std::string_view name;  // as written
  SourceRange where;
  bool used = false;
};

using PermitsByLine = std::unordered_map<std::uint64_t, std::vector<Permit>>;

std::uint64_t key(SourceRange where, std::uint32_t line) {
  return std::uint64_t{where.file.index()} << 32 | line;
}

bool takes(std::vector<Permit>& permits, std::string_view code) {
  for (Permit& permit : permits) {
    if (permit.rule == nullptr || permit.rule->code != code) continue;
    permit.used = true;
    return true;
  }
  return false;
}

Diagnostic unused(const Permit& permit) {
  const std::string message = permit.rule == nullptr
                                  ? "no rule is called " + quoted(permit.name)
                                  : "nothing to allow: no " +
                                        quoted(permit.rule->name) +
                                        " on this line or the next";
  return {.code = unused_allow.code,
          .severity = unused_allow.severity,
          .where = permit.where,
          .message = message,
          .rule = unused_allow.name};
}

}  // namespace

bool is_allow(std::string_view annotation) {
  if (!annotation.starts_with(kAllow)) return false;
  return annotation.size() == kAllow.size() ||
         annotation[kAllow.size()] == ' ' || annotation[kAllow.size()] == '\t';
}

Allow parse_allow(const AstAnnotation& annotation) {
  Allow allow{{}, {}, annotation.where};
  std::string_view names = annotation.text.substr(kAllow.size());
  const std::size_t colon = names.find(':');
  if (colon != std::string_view::npos) {
    allow.reason = trimmed(names.substr(colon + 1));
    names = names.substr(0, colon);
  }
  while (!names.empty()) {
    const std::size_t comma = names.find(',');
    const std::string_view name = trimmed(names.substr(0, comma));
    if (!name.empty()) allow.rules.push_back(name);
    if (comma == std::string_view::npos) break;
    names.remove_prefix(comma + 1);
  }
  return allow;
}

std::vector<Diagnostic> suppress(const RuleContext& context,
                                 std::vector<Diagnostic> findings) {
  PermitsByLine permits;
  std::vector<std::uint64_t> order;
  for (const AstAnnotation& annotation : context.program.annotations) {
    if (!is_allow(annotation.text)) continue;
    const Allow allow = parse_allow(annotation);
    if (allow.reason.empty()) continue;  // a finding of its own
    const SourceFile& file = context.sources[allow.where.file];
    const std::uint64_t line =
        key(allow.where, file.position(allow.where.begin).line);
    for (const std::string_view name : allow.rules) {
      permits[line].push_back({find_rule(name), name, allow.where});
    }
    order.push_back(line);
  }
  if (order.empty()) return findings;

  std::vector<Diagnostic> kept;
  for (Diagnostic& finding : findings) {
    const std::uint32_t line =
        context.sources[finding.where.file].position(finding.where.begin).line;
    const auto here = permits.find(key(finding.where, line));
    const auto above = permits.find(key(finding.where, line - 1));
    const bool allowed =
        (here != permits.end() && takes(here->second, finding.code)) ||
        (above != permits.end() && takes(above->second, finding.code));
    if (!allowed) kept.push_back(std::move(finding));
  }
  for (const std::uint64_t line : order) {
    for (Permit& permit : permits[line]) {
      if (!std::exchange(permit.used, true)) kept.push_back(unused(permit));
    }
  }
  return kept;
}

}  // namespace rung
