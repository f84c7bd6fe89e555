#include "analysis/rule_selection.h"

#include <algorithm>

#include "analysis/rule.h"

namespace rung {

std::string_view to_string(Pack pack) {
  switch (pack) {
    case Pack::Default:
      return "default";
    case Pack::Safety:
      return "safety";
    case Pack::Pedantic:
      return "pedantic";
  }
  return "";
}

std::optional<Pack> find_pack(std::string_view name) {
  for (const Pack pack : kPacks) {
    if (to_string(pack) == name) return pack;
  }
  return std::nullopt;
}

RuleSelection::RuleSelection(const std::vector<Pack>& packs) : on_{} {
  for (const Pack pack : packs) on_[static_cast<std::size_t>(pack)] = true;
}

void RuleSelection::set(const Rule& rule, std::optional<Severity> severity) {
  std::erase_if(set_, [&](const auto& one) { return one.first == &rule; });
  set_.emplace_back(&rule, severity);
}

std::optional<Severity> RuleSelection::severity_of(const Rule& rule) const {
  for (const auto& [one, severity] : set_) {
    if (one == &rule) return severity;
  }
  if (!on_[static_cast<std::size_t>(rule.pack)]) return std::nullopt;
  return rule.severity;
}

}  // namespace rung
