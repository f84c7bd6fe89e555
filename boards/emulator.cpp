#include "boards/emulator.h"

#include <sys/wait.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/process.h"
#include "base/temporary_file.h"
#include "boards/image.h"

namespace rung::boards {
namespace {

namespace fs = std::filesystem;

constexpr std::array<Board, 3> kBoards = {{
    {"uno", "atmega328p", "simavr", "simavr"},
    {"yun", "atmega32u4", "simavr", "simavr"},
    {"arm", "cortex-m3", "qemu-system-arm", "qemu-system-arm"},
}};

// The external RAM of mps2-an385: boards/firmware/board_arm.cpp.
constexpr std::string_view kArmTape = "0x21000000";
constexpr std::size_t kArmCapacity = std::size_t{16} << 20;

constexpr std::size_t kMostOutput = std::size_t{1} << 28;

bool is_arm(const Board& board) { return board.name == "arm"; }

std::string find_firmware(const Board& board) {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored);
  const std::string file = "replay-" + std::string(board.name) + ".elf";
  const fs::path installed =
      here.parent_path().parent_path() / "share" / "rungproof" / "boards";
  for (const fs::path& folder : {here.parent_path() / "boards", installed}) {
    if (fs::is_regular_file(folder / file, ignored)) {
      return (folder / file).string();
    }
  }
  return {};
}

/// In an option of qemu's a comma ends a value, and two are one.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path)
    text += c == ',' ? std::string(",,") : std::string(1, c);
  return text;
}

std::vector<std::string> simavr_command(const Board& board,
                                        const std::string& image) {
  return {"simavr", "-m", std::string(board.mcu), "-f", "16000000", image};
}

std::vector<std::string> qemu_command(const std::string& image,
                                      const std::string& tape) {
  return {"qemu-system-arm",
          "-M",
          "mps2-an385",
          "-nographic",
          "-monitor",
          "none",
          "-serial",
          "none",
          "-semihosting-config",
          "enable=on,target=native",
          "-kernel",
          image,
          "-device",
          "loader,force-raw=on,addr=" + std::string(kArmTape) +
              ",file=" + escaped(tape)};
}

}  // namespace

std::span<const Board> all_boards() { return kBoards; }

const Board* find_board(std::string_view name) {
  for (const Board& board : kBoards) {
    if (board.name == name) return &board;
  }
  return nullptr;
}

Emulator::Emulator(const Board& board) : board_(board) {
  const std::string path = find_firmware(board);
  if (path.empty()) {
    error_ = "the replay firmware for " + std::string(board.name) +
             " is neither in the build directory nor installed";
    return;
  }
  read_firmware(path);
  if (!error_.empty()) return;
  const std::string command(board.emulator);
  const char* const question = is_arm(board) ? "--version" : "--help";
  const ProcessOutput output = run_process({command, question}, 10, 1 << 16);
  if (!output.error.empty()) {
    error_ =
        output.error + " (Debian package " + std::string(board.package) + ")";
  }
}

Emulator::Emulator(const Board& board, const std::string& firmware_path)
    : board_(board) {
  read_firmware(firmware_path);
}

void Emulator::read_firmware(const std::string& path) {
  firmware_path_ = path;
  std::ifstream in(path, std::ios::binary);
  firmware_.assign(std::istreambuf_iterator<char>(in), {});
  if (is_arm(board_)) {
    capacity_ = kArmCapacity;
    if (firmware_.empty()) error_ = "cannot read `" + path + "`";
    return;
  }
  const std::optional<TapePlace> place = find_tape_place(firmware_);
  if (!place) {
    error_ = "`" + path + "` is no replay firmware";
    return;
  }
  tape_at_ = place->at;
  capacity_ = place->size;
}

Playback Emulator::play(std::span<const Job> jobs, double seconds) const {
  Playback playback;
  const std::string tape = write_tape(jobs);
  if (tape.size() > capacity_) {
    playback.error = "program and run take " + std::to_string(tape.size()) +
                     " bytes of flash, and it has " +
                     std::to_string(capacity_) + " for them";
    return playback;
  }
  std::string image = firmware_;
  if (!is_arm(board_)) image.replace(tape_at_, tape.size(), tape);
  const TemporaryFile file(is_arm(board_) ? tape : image);
  playback.error = file.error();
  if (!playback.error.empty()) return playback;
  const ProcessOutput output =
      run_process(is_arm(board_) ? qemu_command(firmware_path_, file.path())
                                 : simavr_command(board_, file.path()),
                  seconds, kMostOutput);
  playback.error = output.error;
  if (!playback.error.empty()) return playback;
  if (!WIFEXITED(output.status) || WEXITSTATUS(output.status) != 0) {
    playback.error = std::string(board_.emulator) + " fails";
    return playback;
  }
  return read_report(output.text, jobs);
}

}  // namespace rung::boards
