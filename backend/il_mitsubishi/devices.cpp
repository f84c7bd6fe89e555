#include "backend/il_mitsubishi/devices.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace rung::backend {
namespace {

struct Area {
  char letter;
  int base;
  std::uint32_t count;
};
// Relays from M500 on keep their state when the power goes.
constexpr std::array kAreas = {Area{'X', 8, 256}, Area{'Y', 8, 256},
                               Area{'M', 10, 500}};

const Area& area_of(const Variable& variable) {
  return kAreas[static_cast<std::size_t>(variable.role)];
}

/// The number at the end of a name, as the area counts.
std::optional<std::uint32_t> number_in(std::string_view name,
                                       const Area& area) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const char* const begin = name.data() + digits;
  const char* const end = name.data() + name.size();
  std::uint32_t number = 0;
  const auto read = std::from_chars(begin, end, number, area.base);
  const bool whole = read.ec == std::errc() && read.ptr == end;
  // `X01` is the same as `X1`.
  const bool plain = end - begin == 1 || (begin != end && *begin != '0');
  if (!whole || !plain || number >= area.count) return std::nullopt;
  return number;
}

std::string device(const Area& area, std::uint32_t number) {
  std::array<char, 16> digits = {};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(),
                                 number, area.base);
  return area.letter + std::string(digits.data(), end.ptr);
}

class Assignment {
 public:
  explicit Assignment(Unit& unit) : unit_(unit) {
    for (const CellId id : ids_of(unit.variables)) {
      if (!unit.variables[id].block.has_value()) open_.push_back(id);
    }
  }

  std::string run() {
    take([](const Variable& it, const Area& area) {
      const bool same =
          it.name.size() > 1 && it.name[0] == area.letter &&
          it.name.find_first_not_of("0123456789", 1) == std::string::npos;
      return same ? number_in(it.name, area) : std::nullopt;
    });
    take([](const Variable& it, const Area& area) {
      return it.source.empty() ? std::nullopt : number_in(it.name, area);
    });
    for (const CellId id : open_) {
      const Area& area = area_of(unit_.variables[id]);
      auto& used = used_[static_cast<std::size_t>(&area - kAreas.data())];
      std::uint32_t& next =
          next_[static_cast<std::size_t>(&area - kAreas.data())];
      while (used.contains(next)) ++next;
      if (next >= area.count) {
        return "more than " + std::to_string(area.count) + " devices " +
               area.letter + ": there are no more";
      }
      used.insert(next);
      unit_.variables[id].name = device(area, next);
    }
    return number_timers();
  }

 private:
  template <class Choose>
  void take(Choose choose) {
    std::vector<CellId> rest;
    for (const CellId id : open_) {
      Variable& variable = unit_.variables[id];
      const Area& area = area_of(variable);
      const std::optional<std::uint32_t> number = choose(variable, area);
      auto& used = used_[static_cast<std::size_t>(&area - kAreas.data())];
      if (number && used.insert(*number).second) {
        variable.name = device(area, *number);
      } else {
        rest.push_back(id);
      }
    }
    open_ = std::move(rest);
  }

  std::string number_timers() {
    std::uint32_t slow = 0;
    std::uint32_t fast = 200;
    std::vector<bool> named(unit_.blocks.size(), false);
    for (const Statement& statement : unit_.statements) {
      if (!statement.block.has_value() || named[statement.block.index()]) {
        continue;
      }
      named[statement.block.index()] = true;
      std::uint32_t& next = timer_base(*statement.preset) == 100 ? slow : fast;
      unit_.blocks[statement.block].name = "T" + std::to_string(next++);
    }
    for (const CellId id : ids_of(unit_.variables)) {
      Variable& variable = unit_.variables[id];
      if (variable.block.has_value()) {
        variable.name = unit_.blocks[variable.block].name;
      }
    }
    if (slow > 200 || fast > 246) {
      return "more than 200 timers of 100 ms, or 46 of 10 ms: there are no "
             "more";
    }
    return {};
  }

  Unit& unit_;
  std::vector<CellId> open_;
  std::array<std::set<std::uint32_t>, 3> used_;
  std::array<std::uint32_t, 3> next_ = {};
};

}  // namespace

std::int64_t timer_base(std::int64_t preset) {
  return preset % 100 == 0 && preset / 100 <= 32'767 ? 100 : 10;
}

std::string assign_devices(Unit& unit) {
  std::unordered_map<std::string, CellId> before;
  for (const CellId id : ids_of(unit.variables)) {
    before.emplace(unit.variables[id].name, id);
  }
  std::string why = Assignment(unit).run();
  // Relations speak of variables by name.
  for (StateRelation& relation : unit.relations) {
    for (StateRelation::Name& name : relation.names) {
      const auto found = before.find(name.state);
      if (!name.second || found == before.end()) continue;
      name.state = unit.variables[found->second].name;
    }
  }
  return why;
}

}  // namespace rung::backend
