#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "analysis/program.h"
#include "base/source.h"

namespace rung {

/// A script as a program, with the texts that it points into.
struct Read {
  SourceSet sources;
  Program program;
};

/// Errors in the script fail the test.
std::unique_ptr<Read> read(const std::string& text, std::string_view dialect);

}  // namespace rung
