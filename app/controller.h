#pragma once

#include <string>

#include "app/options.h"

namespace rung {

/// A lowered program, in bytes, as an array for a sketch: called after the file
/// that is written, else after the program's.
std::string controller_header(const std::string& bytes, const Options& options);

/// What `lower --report` prints of it.
std::string controller_report(const std::string& bytes);

}  // namespace rung
