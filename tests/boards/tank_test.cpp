// The tanks of the paper, closed loop: a plant on the host, h = h + (x - q) T /
// 1000, its levels at the emulated Yun's pins, its valves at the others; the
// controller runs the lowered script with millis() for a clock. The levels stay
// where the script's thresholds promise, as they do in the same loop with the
// simulator for a controller. Time is the board's: nothing here is timed.
//
// RUNG_UPDATE=1 writes docs/images/tank.svg anew.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>

#include "analysis/simulator.h"
#include "avr_board.h"
#include "cases.h"
#include "smt/verify.h"
#include "tank_chart.h"

namespace rung {
namespace {

constexpr std::uint64_t kCyclesOfMs = AvrBoard::kHertz / 1000;
constexpr std::int64_t kStepMs = 1;  // the plant's sampling time
constexpr std::size_t kSteps = 4750;
constexpr int kLow = 300;  // the left tank's switches
constexpr int kHigh = 800;
constexpr int kStart = 650;  // what the script compares the right one with
constexpr int kStop = 700;

// The Yun's pins 2 to 5, and the converter that reads A0.
constexpr AvrBoard::Pin kRightValve = {'D', 1};
constexpr AvrBoard::Pin kLowSwitch = {'D', 0};
constexpr AvrBoard::Pin kHighSwitch = {'D', 4};
constexpr AvrBoard::Pin kLeftValve = {'C', 6};
constexpr int kLevelChannel = 7;

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A tank with a valve above and a hole below; flows in counts of the
/// converter a second.
struct Tank {
  std::int64_t inflow;
  std::int64_t outflow;
  std::int64_t level = 0;  // in thousandths: nothing is rounded

  void step(bool open) {
    level += ((open ? inflow : 0) - outflow) * kStepMs;
    level = std::max<std::int64_t>(level, 0);
  }
  int counts() const { return static_cast<int>(level / 1000); }
};

struct Plant {
  Tank left = {4000, 800};
  Tank right = {3000, 300};

  bool low() const { return left.counts() < kLow; }
  bool high() const { return left.counts() >= kHigh; }
};

/// The Yun with the plant at its pins.
class TankBoard {
 public:
  explicit TankBoard(const std::string& program)
      : board_("atmega32u4", RUNG_FIRMWARE_DIR "/clock-yun.elf") {
    EXPECT_EQ(board_.error(), "");
    EXPECT_TRUE(put_program(board_.flash(), program));
    board_.reset();
    drive();
    for (int i = 0; i < 5000 && count() == 0; ++i) board_.run(64);
    EXPECT_EQ(count(), 128) << "the sketch takes the program";
    board_.watch(kLeftValve, "pin5");
    board_.watch(kRightValve, "pin2");
  }

  Plant plant;

  AvrBoard& board() { return board_; }
  bool left_open() { return board_.level(kLeftValve); }
  bool right_open() { return board_.level(kRightValve); }

  // GPIOR0, 1 and 2: pins.ino.
  std::uint8_t count() { return board_.data()[0x3e]; }
  std::uint8_t clock() { return board_.data()[0x4a]; }
  std::uint8_t pins_touched() { return board_.data()[0x4b]; }

  void step() {
    plant.left.step(left_open());
    plant.right.step(right_open());
    drive();
  }

 private:
  void drive() {
    board_.drive(kLowSwitch, plant.low());
    board_.drive(kHighSwitch, plant.high());
    const auto counts = static_cast<std::uint32_t>(plant.right.counts());
    board_.drive_analog(kLevelChannel, (counts * 5000 + 1022) / 1023);
  }

  AvrBoard board_;
};

/// The same loop with the simulator, which is at its pins when the board is.
class TankSimulation {
 public:
  explicit TankSimulation(const Program& program)
      : program_(program), simulator_(program) {
    for (const CellRole role : {CellRole::Input, CellRole::Output}) {
      for (const Type type : {Type::Bit, Type::Word}) {
        for (const CellId id : ids_of(program.cells)) {
          const Cell& cell = program.cells[id];
          if (cell.role == role && cell.type == type) points_.push_back(id);
        }
      }
    }
  }

  Plant plant;

  /// Reads the next input or writes the next output, in the order in which a
  /// controller does it; between them is the scan.
  void exchange(std::int64_t dt_ms) {
    const CellId id = points_[next_];
    const Cell& cell = program_.cells[id];
    if (cell.role == CellRole::Input) {
      simulator_.set_input(id, sensor(cell.name));
      const CellId behind = points_[next_ + 1];
      const bool last = program_.cells[behind].role == CellRole::Output;
      if (last) simulator_.scan(dt_ms);
    } else {
      const bool open = simulator_.value(id) != 0;
      (cell.name == "pin5" ? left_open_ : right_open_) = open;
    }
    next_ = (next_ + 1) % points_.size();
  }

  void step() {
    plant.left.step(left_open_);
    plant.right.step(right_open_);
  }
  bool right_has_its_turn() const {
    return value("y6") != 0 && value("y7") == 0;
  }

 private:
  std::int64_t sensor(std::string_view name) const {
    if (name == "pin3") return plant.low() ? 1 : 0;
    if (name == "pin4") return plant.high() ? 1 : 0;
    return plant.right.counts();
  }
  std::int64_t value(std::string_view name) const {
    return simulator_.value(find_cell(program_, name));
  }

  const Program& program_;
  Simulator simulator_;
  std::vector<CellId> points_;  // inputs, then outputs; each bits, then words
  std::size_t next_ = 0;
  bool left_open_ = false;
  bool right_open_ = false;
};

/// An input that changes, and what the script does then.
struct Cause {
  std::uint64_t cycle;
  AvrBoard::Pin valve;
  bool open;
};

struct Span {
  std::uint64_t longest = 0;  // in cycles
  std::uint64_t shortest = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t sum = 0;
  std::uint64_t count = 0;

  void add(std::uint64_t cycles) {
    longest = std::max(longest, cycles);
    shortest = std::min(shortest, cycles);
    sum += cycles;
    ++count;
  }
};

double ms(std::uint64_t cycles) {
  return static_cast<double>(cycles) / static_cast<double>(kCyclesOfMs);
}

std::ostream& operator<<(std::ostream& out, const Span& span) {
  return out << ms(span.shortest) << " to " << ms(span.longest)
             << " ms, on average " << ms(span.sum / span.count) << " ("
             << span.count << ")";
}

struct Levels {
  int least = 1023;
  int most = 0;

  void add(int level) {
    least = std::min(least, level);
    most = std::max(most, level);
  }
};

class ClosedLoop {
 public:
  ClosedLoop(const Program& program, const std::string& lowered)
      : board_(lowered), simulation_(program) {}

  void run() {
    const std::uint64_t begin = board_.board().cycle();
    seen_count_ = board_.count();
    seen_clock_ = board_.clock();
    seen_pins_ = board_.pins_touched();
    for (std::size_t step = 1; step <= kSteps; ++step) {
      const std::uint64_t end = begin + step * kCyclesOfMs;
      // No input changes while a pin is read: before it or behind it.
      while (board_.board().cycle() < end || board_.pins_touched() % 2 != 0) {
        board_.board().run(kLook);
        look();
      }
      advance();
    }
  }

  /// From an input's change to the output's.
  Span reaction(const std::vector<Cause>& causes) {
    Span span;
    for (const Cause& cause : causes) {
      const auto& changes = board_.board().changes(cause.valve);
      const auto effect =
          std::find_if(changes.begin(), changes.end(), [&](const auto& change) {
            return change.cycle >= cause.cycle && change.level == cause.open;
          });
      if (effect == changes.end()) {
        ADD_FAILURE() << "no answer to the change at " << ms(cause.cycle);
        continue;
      }
      span.add(effect->cycle - cause.cycle);
    }
    return span;
  }

  std::vector<Cause> digital;
  std::vector<Cause> analog;
  Span period;
  Span scan;
  Levels left;   // from its first filling on
  Levels right;  // in its turns, from its filling on
  int right_most = 0;
  std::int64_t difference = 0;  // to the simulator, at most; in thousandths
  std::vector<TankHistory> history = {
      {"Left tank: low and high switch, pins 3, 4; valve, pin 5",
       kLow,
       kHigh,
       {}},
      {"Right tank: level, A0, compared; valve, pin 2", kStart, kStop, {}}};

 private:
  static constexpr std::uint64_t kLook = 64;  // cycles; a scan takes thousands

  /// Whether a scan has begun, what it has read, and whether it has ended.
  void look() {
    const std::uint64_t now = board_.board().cycle();
    if (board_.clock() != seen_clock_) {
      const int passed = board_.clock() - seen_clock_;
      seen_clock_ = board_.clock();
      dt_ms_ = static_cast<std::uint8_t>(passed);
      if (scan_began_ != 0) period.add(now - scan_began_);
      scan_began_ = now;
    }
    const unsigned touched = board_.pins_touched();
    for (; seen_pins_ / 2 != touched / 2; seen_pins_ += 2) {
      simulation_.exchange(dt_ms_);
    }
    if (board_.count() == seen_count_) return;
    seen_count_ = board_.count();
    scan.add(now - scan_began_);
  }

  void advance() {
    const Plant before = board_.plant;
    const bool left_open = board_.left_open();
    const bool right_open = board_.right_open();
    board_.step();
    simulation_.step();
    const Plant& after = board_.plant;
    note_causes(before, after, right_open);
    note_levels(after, before.right.counts());
    history[0].samples.push_back({after.left.level, left_open});
    history[1].samples.push_back({after.right.level, right_open});
    const Plant& other = simulation_.plant;
    difference =
        std::max({difference, std::abs(after.left.level - other.left.level),
                  std::abs(after.right.level - other.right.level)});
  }

  void note_causes(const Plant& before, const Plant& after, bool right_open) {
    const std::uint64_t now = board_.board().cycle();
    const int was = before.right.counts();
    const int is = after.right.counts();
    if (!before.low() && after.low()) {
      digital.push_back({now, kLeftValve, true});
    }
    if (!before.high() && after.high()) {
      digital.push_back({now, kLeftValve, false});
    }
    if (was <= kStop && is > kStop && right_open) {
      analog.push_back({now, kRightValve, false});
    }
    if (was >= kStart && is < kStart && simulation_.right_has_its_turn()) {
      analog.push_back({now, kRightValve, true});
    }
  }

  void note_levels(const Plant& plant, int right_before) {
    left_was_full_ = left_was_full_ || plant.high();
    if (left_was_full_) left.add(plant.left.counts());
    const int counts = plant.right.counts();
    right_most = std::max(right_most, counts);
    if (!simulation_.right_has_its_turn()) {
      right_was_full_ = false;
      return;
    }
    right_was_full_ =
        right_was_full_ || (right_before <= kStop && counts > kStop);
    if (right_was_full_) right.add(counts);
  }

  TankBoard board_;
  TankSimulation simulation_;
  std::uint8_t seen_count_ = 0;
  std::uint8_t seen_clock_ = 0;
  std::uint8_t seen_pins_ = 0;
  std::int64_t dt_ms_ = 0;
  std::uint64_t scan_began_ = 0;
  bool left_was_full_ = false;
  bool right_was_full_ = false;
};

/// What flows within these cycles and a step of the plant, in counts.
int flow(std::int64_t a_second, std::uint64_t cycles) {
  const double seconds = (ms(cycles) + kStepMs) / 1000;
  return static_cast<int>(static_cast<double>(a_second) * seconds) + 1;
}

TEST(BoardTank, LevelsStayWhereTheScriptHoldsThem) {
  Programs programs;
  ASSERT_TRUE(programs.add(
      "tank.rung", read_file(RUNG_SOURCE_DIR "/tests/boards/tank.rung")));
  const Loaded& loaded = programs.items().front();
  for (const ObligationResult& result :
       verify(loaded.program, loaded.properties, {}).results) {
    if (result.obligation.built_in) continue;
    EXPECT_EQ(result.verdict, Verdict::Proved) << result.obligation.name;
  }
  Case test;
  ASSERT_TRUE(make_case(loaded, 1, 1, test));
  ClosedLoop loop(loaded.program, test.job.program);
  ASSERT_FALSE(HasFailure());
  loop.run();

  const Span digital = loop.reaction(loop.digital);
  const Span analog = loop.reaction(loop.analog);
  std::cout << "scan period: " << loop.period << "\nscan: " << loop.scan
            << "\nI/O cycle, digital: " << digital
            << "\nI/O cycle, analog: " << analog
            << "\nleft: " << loop.left.least << " to " << loop.left.most
            << ", right: " << loop.right.least << " to " << loop.right_most
            << ", at most " << loop.difference
            << "/1000 from the simulator's\n";

  // Two rounds, with two turns of the right tank: the loop does something.
  EXPECT_GE(digital.count, 11U);
  EXPECT_GE(analog.count, 6U);
  // Below the script's longest scan, far below the paper's 0.3 and 0.53 s.
  EXPECT_LE(loop.period.longest, 3 * kCyclesOfMs);
  EXPECT_LE(digital.longest, 4 * kCyclesOfMs);
  EXPECT_LE(analog.longest, 4 * kCyclesOfMs);

  const Plant plant;
  const std::int64_t left_rise = plant.left.inflow - plant.left.outflow;
  const std::int64_t right_rise = plant.right.inflow - plant.right.outflow;
  EXPECT_LE(loop.left.most, kHigh + flow(left_rise, digital.longest));
  EXPECT_GE(loop.left.least, kLow - flow(plant.left.outflow, digital.longest));
  EXPECT_LE(loop.right_most, kStop + flow(right_rise, analog.longest));
  EXPECT_GE(loop.right.least,
            kStart - flow(plant.right.outflow, analog.longest));

  const double inflow = static_cast<double>(plant.left.inflow);
  EXPECT_LE(static_cast<double>(loop.difference),
            inflow * ms(loop.period.longest))
      << "the inflow of one scan";

  const std::string path = RUNG_SOURCE_DIR "/docs/images/tank.svg";
  const std::string chart = tank_chart(loop.history);
  if (std::getenv("RUNG_UPDATE") != nullptr) {
    std::ofstream(path) << chart;
    return;
  }
  // Some pixels: a scan takes another time when the library changes.
  EXPECT_TRUE(same_drawing(chart, read_file(path), 3))
      << "RUNG_UPDATE=1 rewrites " << path;
}

TEST(BoardTank, AnotherChartIsNoticed) {
  TankHistory tank = {"tank", 1, 2, {}};
  for (int i = 0; i < 3000; ++i) tank.samples.push_back({i * 300, i < 1000});
  const std::string chart = tank_chart({tank});
  EXPECT_TRUE(same_drawing(chart, chart, 0));
  TankHistory later = tank;
  later.samples[1000].open = true;
  EXPECT_TRUE(same_drawing(chart, tank_chart({later}), 3));
  EXPECT_FALSE(same_drawing(chart, tank_chart({later}), 0));
  later.samples[2000].open = true;
  EXPECT_FALSE(same_drawing(chart, tank_chart({later}), 3));
  EXPECT_FALSE(same_drawing(chart, chart.substr(1), 3));
}

}  // namespace
}  // namespace rung
