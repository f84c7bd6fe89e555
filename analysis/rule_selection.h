#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"

namespace rung {

struct Rule;

/// Rules that are switched on together. `Safety` asks for what a plain program
/// need not have; `Pedantic` is about how a program reads.
enum class Pack : std::uint8_t { Default, Safety, Pedantic };
inline constexpr std::array<Pack, 3> kPacks = {Pack::Default, Pack::Safety,
                                               Pack::Pedantic};

std::string_view to_string(Pack pack);
std::optional<Pack> find_pack(std::string_view name);

/// Which rules run, and how severe is what they find. A value: made from the
/// configuration and the command line, read by run_rules.
class RuleSelection {
 public:
  /// Every rule of every pack, as severe as it says itself.
  RuleSelection() = default;
  /// Those of some packs.
  explicit RuleSelection(const std::vector<Pack>& packs);

  /// Has the last word on the rule, whatever its pack; nothing: off.
  void set(const Rule& rule, std::optional<Severity> severity);

  /// Nothing: the rule is off.
  std::optional<Severity> severity_of(const Rule& rule) const;
  bool is_on(const Rule& rule) const { return severity_of(rule).has_value(); }

 private:
  std::array<bool, kPacks.size()> on_ = {true, true, true};  // by pack
  std::vector<std::pair<const Rule*, std::optional<Severity>>> set_;
};

}  // namespace rung
