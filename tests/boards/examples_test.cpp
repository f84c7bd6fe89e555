// The examples of the Arduino library: their programs have proved properties,
// their headers are made of them, and the sketches do on the emulated boards
// what they say. That they compile for every board is their build's business.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "avr_board.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> programs() {
  std::vector<fs::path> found;
  const fs::path root = RUNG_SOURCE_DIR "/runtime/examples";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".rung") found.push_back(entry.path());
  }
  return found;
}

int run(const std::string& arguments) {
  return std::system((RUNG_PROGRAM " " + arguments + " > /dev/null").c_str());
}

TEST(Examples, ArePrograms) {
  ASSERT_GE(programs().size(), 3U);
  for (const fs::path& program : programs()) {
    EXPECT_EQ(run("check '" + program.string() + "'"), 0) << program;
  }
}

TEST(Examples, HaveHeadersThatAreMadeOfThem) {
  std::string folder =
      (fs::temp_directory_path() / "rungproof-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  int headers = 0;
  for (const fs::path& program : programs()) {
    fs::path header = program;
    header.replace_extension(".h");
    if (!fs::exists(header)) continue;
    ++headers;
    const fs::path made = fs::path(folder) / header.filename();
    EXPECT_EQ(run("lower '" + program.string() +
                  "' --to postfix --header -o '" + made.string() + "'"),
              0);
    EXPECT_EQ(read_text(made), read_text(header)) << header;
  }
  EXPECT_GE(headers, 3);
  fs::remove_all(folder);
}

/// A board with a sketch, and where its pins are.
struct Sketch {
  Sketch(const std::string& mcu, const std::string& example,
         const std::string& name)
      : board(mcu, RUNG_FIRMWARE_DIR "/" + example + "-" + name + ".elf"),
        yun(name == "yun") {}

  AvrBoard::Pin pin(int number) const {
    switch (number) {
      case 2:
        return {'D', yun ? 1 : 2};
      case 3:
        return {'D', yun ? 0 : 3};
      case 4:
        return {'D', 4};
      case 5:
        return yun ? AvrBoard::Pin{'C', 6} : AvrBoard::Pin{'D', 5};
      default:  // 6
        return {'D', yun ? 7 : 6};
    }
  }
  void set(int number, bool level) { board.drive(pin(number), level); }
  bool get(int number) { return board.level(pin(number)); }
  void wait(unsigned ms) { board.run(AvrBoard::kHertz / 1000 * ms); }

  AvrBoard board;
  bool yun;
};

const char* const kBoards[][2] = {{"atmega328p", "uno"}, {"atmega32u4", "yun"}};

TEST(Examples, StartStopStartsHoldsAndStops) {
  for (const auto& [mcu, name] : kBoards) {
    Sketch sketch(mcu, "StartStop", name);
    ASSERT_EQ(sketch.board.error(), "");
    for (const int pin : {4, 5}) sketch.set(pin, false);
    sketch.wait(50);
    EXPECT_FALSE(sketch.get(3)) << name;
    sketch.set(5, true);
    sketch.wait(10);
    EXPECT_TRUE(sketch.get(3)) << name;
    sketch.set(5, false);
    sketch.wait(50);
    EXPECT_TRUE(sketch.get(3)) << name;
    sketch.set(4, true);
    sketch.wait(10);
    EXPECT_FALSE(sketch.get(3)) << name;
  }
}

TEST(Examples, TwoPumpsTakeTurnsAndOneReplacesTheOther) {
  for (const auto& [mcu, name] : kBoards) {
    Sketch sketch(mcu, "TwoPumps", name);
    ASSERT_EQ(sketch.board.error(), "");
    for (const int pin : {2, 4, 5}) sketch.set(pin, false);
    sketch.wait(400);  // longer than the watchdog waits
    EXPECT_FALSE(sketch.get(3) || sketch.get(6)) << name;
    sketch.set(2, true);
    sketch.wait(10);
    const bool first = sketch.get(3);
    EXPECT_NE(first, sketch.get(6)) << name;
    sketch.set(2, false);
    sketch.wait(10);
    sketch.set(2, true);
    sketch.wait(10);
    EXPECT_NE(sketch.get(3), first) << name;  // the other one's turn
    EXPECT_EQ(sketch.get(6), first) << name;
    sketch.set(first ? 5 : 4, true);  // which trips
    sketch.wait(10);
    EXPECT_EQ(sketch.get(3), first) << name;
    EXPECT_NE(sketch.get(6), first) << name;
  }
}

}  // namespace
}  // namespace rung
