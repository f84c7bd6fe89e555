#pragma once

#include <map>
#include <string>
#include <string_view>

#include "reports/json_parts.h"
#include "reports/report.h"

namespace rung {

/// "property-violated" and so on: the rules that obligations break.
std::string verdict_rule_id(Verdict verdict);

/// The rules of a SARIF run, in the order in which results name them first.
class SarifRules {
 public:
  explicit SarifRules(const Report& report) : report_(report) {}

  std::size_t index_of(const Diagnostic& finding);
  std::size_t index_of(Verdict verdict);
  Json take() { return std::move(rules_); }

 private:
  std::size_t add(const std::string& id, Json rule);

  const Report& report_;
  std::map<std::string, std::size_t, std::less<>> indices_;
  Json rules_ = Json::array();
};

}  // namespace rung
