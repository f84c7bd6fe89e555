#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace rung::backend {

/// How a target spells names.
struct NameRules {
  /// Words that are no names, with a blank between two.
  std::string_view reserved;
  bool ignores_case = true;
  bool plain_underscores = false;  // any number of them, at any place
  std::size_t longest = 0;         // 0: any length
  bool (*is_reserved)(std::string_view name) = nullptr;  // more of them
};

/// Gives every variable of a target a name of its own: the source's where the
/// target can have it, else the nearest that is free. Names are letters,
/// digits and single underscores, and begin with a letter.
class NameTable {
 public:
  NameTable() : NameTable(kNone) {}
  explicit NameTable(const NameRules& rules);

  /// The name itself if it can be, else one like it.
  std::string add(std::string_view wanted);
  /// `prefix_1`, or the next number that is free.
  std::string make(std::string_view prefix);

 private:
  static constexpr NameRules kNone = {};

  std::string spelled(std::string_view name) const;
  std::string key_of(std::string_view name) const;
  bool take(const std::string& name);

  const NameRules* rules_;
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::uint32_t> next_;
};

/// The reserved words of IEC 61131-3, in capitals.
const NameRules& iec_names();

}  // namespace rung::backend
