#pragma once

#include <cstdint>
#include <string>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "boards/emulator.h"

namespace rung::boards {

/// What became of a trace on a board.
struct Replayed {
  enum class Outcome : std::uint8_t {
    Alike,      // every cell at the end of every step as the trace has it
    Different,  // one of the two is wrong
    NotRun,     // the board cannot show it
  };
  Outcome outcome = Outcome::NotRun;
  std::string what;  // differs, or why not
};

/// Executes a run of `program` on the board, by the machine that a controller
/// has: lowered, verified by the loader, scan for scan.
///
/// NotRun: what the postfix format has not, a program or a run too large for
/// the board, a scan in which the machine stops as it has to, an emulator that
/// fails or takes more than `seconds`.
Replayed replay_on_board(const Emulator& emulator, const Program& program,
                         const Trace& trace, double seconds);

}  // namespace rung::boards
