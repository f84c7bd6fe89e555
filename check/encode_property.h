#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "check/model.h"

namespace rung::check {

/// What is claimed of one obligation, read from the source's property lines.
struct Goal {
  enum class Kind : std::uint8_t {
    Always,
    Reach,
    Recover,
    Unknown,  // a form that is not encoded here
  };
  Kind kind = Kind::Always;
  std::string name;  // "pump.holds"
  std::string form;  // "latch", "built-in"
  std::string text;  // the property line
  Value condition;   // at every scan's end; what is reached
};

/// Encodes the properties and the assumptions, with the states that they need.
std::vector<Goal> encode_properties(const Program& program,
                                    const PropertySet& properties,
                                    const ProgramValues& values, Model& model);

}  // namespace rung::check
