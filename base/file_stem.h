#pragma once

#include <string>
#include <string_view>

namespace rung {

/// A file's name of what a user called something: letters, digits, `-`, `_` and
/// inner `.`; nothing in it leaves the folder. At most 200 bytes, never empty.
std::string file_stem(std::string_view name);

}  // namespace rung
