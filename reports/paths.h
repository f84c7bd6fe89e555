#pragma once

#include <string>
#include <string_view>

namespace rung {

/// `path` without `directory/` when it lies below it, and without `./`.
std::string relative_path(std::string_view path, std::string_view directory);

/// A path as a URI: percent-encoded; absolute ones with file://.
std::string path_uri(std::string_view path);

}  // namespace rung
