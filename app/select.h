#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"

namespace rung {

/// Is it `wanted`, or a part of it (`NAME.holds` of `NAME`)?
bool is_selected(std::string_view name, const std::string& wanted);

/// Which obligations --property names; empty when it names none, so all.
std::function<bool(std::string_view)> wanted_by(
    const std::vector<std::string>& names);

/// Keeps the properties that --property names, wholly or in part.
PropertySet select(PropertySet all, const std::vector<std::string>& wanted);

}  // namespace rung
