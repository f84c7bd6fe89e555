#pragma once

#include <string_view>

namespace rung::iec {

/// Is it a function of the standard that is supported? The name is in capitals.
bool is_standard_function(std::string_view upper_name);

}  // namespace rung::iec
