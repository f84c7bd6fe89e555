#pragma once

#include <cstdint>
#include <string_view>

#include "analysis/program.h"
#include "program_generator.h"

namespace rung {

/// A program that executes the timers, counters, edges and latches of one
/// dialect (every kind of every dialect but those of scripts), some of them
/// behind a condition, and looks at their outputs at any place.
Program random_block_program(Tape& tape);

/// One block of a kind; its operands are inputs, in the order of its
/// parameters, and each operation has a cell. Times are 30 ms.
Program single_block(std::string_view kind);

}  // namespace rung
