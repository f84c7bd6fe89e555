#pragma once

#include <cstdint>
#include <string>

#include "analysis/program.h"
#include "program_generator.h"

namespace rung {

/// Times of property lines.
enum class PropertyTimes : std::uint8_t { Short, Long };  // to 30, to 200 ms

/// One property line (with `//@ ` and a line end) over the names of `program`:
/// every form, with prev, begin, rose, fell, once, and T(0).q and its like.
std::string generate_property(const Program& program, Tape& tape,
                              PropertyTimes times);

/// The same, a `recoverable` line.
std::string generate_recoverable(const Program& program, Tape& tape);

/// `P -> Q`, as `rungproof bound` asks it.
std::string generate_question(const Program& program, Tape& tape);

/// An `//@ assume` line over its bit inputs; empty when it has none.
std::string generate_assumption(const Program& program, Tape& tape);

}  // namespace rung
