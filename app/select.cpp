#include "app/select.h"

#include <algorithm>

namespace rung {
bool is_selected(std::string_view name, const std::string& wanted) {
  return name == wanted ||
         (name.starts_with(wanted) && name[wanted.size()] == '.');
}

namespace {

bool is_one_of(std::string_view name, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& one) {
    return is_selected(name, one);
  });
}

}  // namespace

std::function<bool(std::string_view)> wanted_by(
    const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return [names](std::string_view name) { return is_one_of(name, names); };
}

PropertySet select(PropertySet all, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return all;
  std::erase_if(all.properties, [&](const Property& property) {
    const bool has_wanted_part =
        std::any_of(wanted.begin(), wanted.end(), [&](const std::string& one) {
          return is_selected(one, property.name);
        });
    return !has_wanted_part && !is_one_of(property.name, wanted);
  });
  return all;
}

}  // namespace rung
