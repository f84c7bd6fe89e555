#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "boards/tape.h"

namespace rung::boards {

/// A controller for which there is a replay firmware and, in Debian, a command
/// that emulates it.
struct Board {
  std::string_view name;      // "uno"
  std::string_view mcu;       // "ATmega328P"
  std::string_view emulator;  // "simavr"
  std::string_view package;   // that has it
};

/// uno, yun and arm.
std::span<const Board> all_boards();
const Board* find_board(std::string_view name);

/// What runs on a board: its firmware is read once, from beside the program
/// (the build directory) or where it is installed.
class Emulator {
 public:
  /// Errors: error() says what is missing: the firmware or the command.
  explicit Emulator(const Board& board);
  /// With a firmware of the caller's.
  Emulator(const Board& board, const std::string& firmware_path);

  const Board& board() const { return board_; }
  const std::string& error() const { return error_; }

  /// How long a tape may be, in bytes.
  std::size_t capacity() const { return capacity_; }

  /// Runs `jobs` one after the other in one process. Errors: in the result,
  /// with none of its executions to be used; the jobs not fitting on a tape,
  /// the emulator failing, or `seconds` having passed.
  Playback play(std::span<const Job> jobs, double seconds) const;

 private:
  void read_firmware(const std::string& path);

  const Board& board_;
  std::string firmware_path_;
  std::string firmware_;
  std::size_t tape_at_ = 0;
  std::size_t capacity_ = 0;
  std::string error_;
};

}  // namespace rung::boards
