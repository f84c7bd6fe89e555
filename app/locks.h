#pragma once

#include <string>
#include <variant>

#include "app/lock_file.h"

namespace rung {

/// The lock at `path`, or `PATH: why it cannot be read`.
std::variant<Lock, std::string> load_lock(const std::string& path);

}  // namespace rung
