#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"
#include "check/encode_property.h"
#include "check/model.h"
#include "check/result_file.h"

namespace rung::check {

/// What is to be proved, and of what. Terms know their model, so it stays
/// where it is.
struct Claims {
  std::unique_ptr<Model> model;
  std::vector<Goal> goals;
  /// States from here on are memories of property lines.
  std::uint32_t first_memory = 0;
  std::string error;  // there is nothing to be proved of these programs
};

/// The property lines of a program.
Claims claims_of(const Program& program, const PropertySet& properties);

/// A program with what it assumes of its inputs.
struct Compared {
  const Program& program;
  const PropertySet& properties;
};

/// That outputs of two programs, which the result names as the first does, are
/// the same in every scan, under the same inputs: those of one name, or of two
/// that `map` holds.
Claims claims_of(const Compared& a, const Compared& b,
                 const std::vector<std::pair<std::string, std::string>>& map,
                 const ClaimedResult& claimed);

}  // namespace rung::check
