#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "boards/tape.h"

namespace rung {

/// A program, a run of it scan by scan (no step is repeated), and both as the
/// boards are given them.
struct Case {
  std::string name;
  const Program* program = nullptr;
  Stimulus stimulus;
  boards::Job job;
};

/// The same run with each scan a step of its own.
Stimulus scan_by_scan(const Stimulus& stimulus);

/// Everything that executes programs answers in the same form: the cells at
/// the end of every scan, by CellId. Machines say why they stop (`fault`); the
/// simulator and the transition system end before the first scan in which a
/// value leaves its range or 32 bits.
using boards::Execution;

Execution run_simulator(const Program& program, const Stimulus& stimulus);
Execution run_system(const Program& program, const Stimulus& stimulus);

/// The machine of runtime/ on the host; and one that takes `&&` for `||`.
Execution run_machine(const Case& test);
Execution run_faulty_machine(const Case& test);

struct BoardRun {
  std::vector<Execution> executions;  // by case
  std::string problem;                // with the board itself
};

/// On "uno", "yun" (libsimavr) or "arm" (qemu), with the firmware "replay" or
/// the one with a fault, "faulty". As often as it takes, a tape is written into
/// the flash of an AVR board and the board reset.
BoardRun run_board(const std::string& board, const std::string& firmware,
                   std::span<const Case> cases);

/// The program that an executor with the fault takes this one for.
Program with_fault(Program program);

/// What differs first, in words; empty when all is alike. Machines also stop
/// alike and say why.
std::string difference(const Program& program, const Execution& reference,
                       const Execution& other);
/// The machine stops in the scan that the simulator does not go on with.
std::string difference_to_simulator(const Program& program,
                                    const Execution& simulated,
                                    const Execution& machine);
/// As far as the encoding claims to be the program.
std::string difference_before_end(const Program& program,
                                  const Execution& simulated,
                                  const Execution& system);

}  // namespace rung
