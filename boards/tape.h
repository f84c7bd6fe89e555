#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "base/diagnostic.h"

namespace rung::boards {

/// A program and a run of it, for a board to execute.
struct Job {
  std::string program;        // the binary of docs/postfix.md
  std::vector<CellId> cells;  // by the machine's number: bits, then words
  std::size_t bit_count = 0;
  std::uint32_t step_count = 0;
  std::string steps;  // as the tape has them
};

/// Lowers `program`. Of inputs that `stimulus` does not name the initial
/// values are taken; a `//Sim` plant does not run on a board.
/// Errors: what the postfix format cannot express (RP084) goes to `sink`, then
///         there is no job.
/// Preconditions: values of `stimulus` are in their cells' ranges, steps have
///                less than 2^32 scans.
std::optional<Job> make_job(const Program& program, const Stimulus& stimulus,
                            DiagnosticSink& sink);

/// What boards/firmware/replay.cpp plays; numbers are little-endian:
///
///     job:  program bytes (4), bytes of all steps (4), steps (4), the program,
///           the steps
///     step: scans (4), ms a scan (4), the bits of all inputs that are bits,
///           eight a byte from the lowest, those that are words (4 each)
///     end:  0 (4)
std::string write_tape(std::span<const Job> jobs);

/// What the machine on the board made of one job.
struct Execution {
  unsigned refusal = 0;  // docs/postfix.md, section 5; 0: executed
  std::uint32_t refused_at = 0;
  /// At the end of every step, by CellId index. After a fault the last ones
  /// are those that the fault left.
  std::vector<std::vector<std::int64_t>> values;
  unsigned fault = 0;            // 0: none
  std::uint64_t fault_scan = 0;  // of the last step, from 1

  bool operator==(const Execution&) const = default;
};

struct Playback {
  std::vector<Execution> executions;  // by job
  std::string error;                  // the report is none, or not complete
};

/// Reads the report in what an emulator printed:
///
///     { job... }
///     job:  p, refusal (2 digits), its offset (8), steps
///     step: s, cells;   or the last: f, fault (2), scans before it (8), cells
///
/// Numbers are hexadecimal; cells are four bits a digit from the lowest, then
/// words of 8 digits. Ends of lines and what simavr makes of them are skipped.
/// Limits: linear; any bytes.
Playback read_report(std::string_view printed, std::span<const Job> jobs);

}  // namespace rung::boards
