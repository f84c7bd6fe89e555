#include "analysis/rules/suppress.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "analysis/rules/rule_run.h"
#include "analysis/rules/support.h"
#include "base/text.h"

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
  std::string_view reason;
  SourceRange where;
  bool used = false;
};

using PermitsByLine = std::unordered_map<std::uint64_t, std::vector<Permit>>;

std::uint64_t key(SourceRange where, std::uint32_t line) {
  return std::uint64_t{where.file.index()} << 32 | line;
}

/// The first permit for such a finding; null when there is none.
const Permit* take(PermitsByLine& all, std::uint64_t line,
                   std::string_view code) {
  const auto permits = all.find(line);
  if (permits == all.end()) return nullptr;
  for (Permit& permit : permits->second) {
    if (permit.rule == nullptr || permit.rule->code != code) continue;
    permit.used = true;
    return &permit;
  }
  return nullptr;
}

std::string nothing_called(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Rule* rule : all_rules()) known.push_back(rule->name);
  return "no rule is called " + quoted(name) + did_you_mean(name, known);
}

Diagnostic unused(const Permit& permit, Severity severity) {
  const std::string message = permit.rule == nullptr
                                  ? nothing_called(permit.name)
                                  : "nothing to allow: no " +
                                        quoted(permit.rule->name) +
                                        " on this line or the next";
  return {.code = unused_allow.code,
          .severity = severity,
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

namespace {

/// By line; `order` gets the lines as they come. A rule that is off may have
/// had something to say there: its permits count as used.
PermitsByLine read_permits(const RuleContext& context,
                           std::vector<std::uint64_t>& order) {
  PermitsByLine permits;
  for (const AstAnnotation& annotation : context.program.annotations) {
    if (!is_allow(annotation.text)) continue;
    const Allow allow = parse_allow(annotation);
    if (allow.reason.empty()) continue;  // a finding of its own
    const SourceFile& file = context.sources[allow.where.file];
    const std::uint64_t line =
        key(allow.where, file.position(allow.where.begin).line);
    for (const std::string_view name : allow.rules) {
      const Rule* const rule = find_rule(name);
      const bool off = rule != nullptr && !context.rules.is_on(*rule);
      permits[line].push_back({rule, name, allow.reason, allow.where, off});
    }
    order.push_back(line);
  }
  return permits;
}

}  // namespace

std::vector<Diagnostic> suppress(const RuleContext& context,
                                 std::vector<Diagnostic> findings) {
  std::vector<std::uint64_t> order;
  PermitsByLine permits = read_permits(context, order);
  if (order.empty()) return findings;
  for (Diagnostic& finding : findings) {
    const std::uint32_t line =
        context.sources[finding.where.file].position(finding.where.begin).line;
    const Permit* permit =
        take(permits, key(finding.where, line), finding.code);
    if (permit == nullptr) {
      permit = take(permits, key(finding.where, line - 1), finding.code);
    }
    if (permit == nullptr) continue;
    finding.waiver = {Waiver::Kind::InSource, std::string(permit->reason)};
  }
  const std::optional<Severity> severity =
      context.rules.severity_of(unused_allow);
  if (!severity) return findings;
  for (const std::uint64_t line : order) {
    for (Permit& permit : permits[line]) {
      if (std::exchange(permit.used, true)) continue;
      findings.push_back(unused(permit, *severity));
    }
  }
  return findings;
}

}  // namespace rung
