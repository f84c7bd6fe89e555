#pragma once

#include <string_view>

namespace rung {

inline constexpr std::string_view kVersion = RUNG_VERSION;

}  // namespace rung
