// The proof reaches the pins: a sketch with the Arduino core and the library
// runs the programs of the corpus on both AVR boards, its inputs driven as in
// the runs that the proofs show, and the pins of its outputs go high and low in
// the scans in which the proofs say it, and never else.
//
// RUNG_WRITE_WAVEFORMS: a folder for the waveforms of the pins (VCD).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>

#include "analysis/explanation.h"
#include "avr_board.h"
#include "cases.h"
#include "smt/verify.h"

namespace rung {
namespace {

/// An Arduino board's digital pins, and which converter reads A0, A1 ...
struct Wires {
  std::string name;
  std::string mcu;
  std::array<AvrBoard::Pin, 14> digital;
  std::array<int, 6> analog;
};

const Wires kUno = {"uno",
                    "atmega328p",
                    {{{'D', 0},
                      {'D', 1},
                      {'D', 2},
                      {'D', 3},
                      {'D', 4},
                      {'D', 5},
                      {'D', 6},
                      {'D', 7},
                      {'B', 0},
                      {'B', 1},
                      {'B', 2},
                      {'B', 3},
                      {'B', 4},
                      {'B', 5}}},
                    {0, 1, 2, 3, 4, 5}};
const Wires kYun = {"yun",
                    "atmega32u4",
                    {{{'D', 2},
                      {'D', 3},
                      {'D', 1},
                      {'D', 0},
                      {'D', 4},
                      {'C', 6},
                      {'D', 7},
                      {'E', 6},
                      {'B', 4},
                      {'B', 5},
                      {'B', 6},
                      {'B', 7},
                      {'D', 6},
                      {'C', 7}}},
                    {7, 6, 5, 4, 1, 0}};

/// The digital pin of a cell: its name, or as in the map of pins.ino.
std::optional<std::size_t> digital_pin(const std::string& name) {
  static const std::vector<std::pair<std::string, std::size_t>> map = {
      {"I0", 2}, {"I1", 4},  {"I2", 5},  {"I3", 6},  {"I4", 7},  {"I5", 8},
      {"Q0", 3}, {"Q1", 13}, {"Q2", 12}, {"Q3", 11}, {"Q4", 10}, {"Q5", 9}};
  for (const auto& [mapped, pin] : map) {
    if (mapped == name) return pin;
  }
  for (std::size_t pin = 0; pin < 14; ++pin) {
    if (name == "pin" + std::to_string(pin)) return pin;
  }
  return std::nullopt;
}

std::optional<std::size_t> analog_pin(const Cell& cell) {
  if (cell.type != Type::Word || cell.low < 0 || cell.high > 1023) {
    return std::nullopt;
  }
  for (std::size_t pin = 0; pin < 6; ++pin) {
    if (cell.name == "A" + std::to_string(pin)) return pin;
  }
  return std::nullopt;
}

/// Whether the sketch has pins for all inputs and outputs.
bool has_pins(const Program& program) {
  for (const CellId id : ids_of(program.cells)) {
    const Cell& cell = program.cells[id];
    if (cell.role == CellRole::Memory) continue;
    const bool digital =
        cell.type == Type::Bit && digital_pin(cell.name).has_value();
    const bool analog =
        cell.role == CellRole::Input && analog_pin(cell).has_value();
    if (!digital && !analog) return false;
  }
  return true;
}

class PinBoard {
 public:
  /// `sketch`: "pins", led scan by scan, or "clock", with millis().
  PinBoard(const Wires& wires, const Case& test,
           const std::string& sketch = "pins")
      : wires_(wires),
        test_(test),
        board_(wires.mcu,
               RUNG_FIRMWARE_DIR "/" + sketch + "-" + wires.name + ".elf") {}

  /// What differs from `expected`, the cells at the end of every scan.
  std::string run(const Execution& expected) {
    const std::string problem = start();
    if (!problem.empty()) return problem;
    if (!wait_for(128)) {
      return "the sketch answers " + std::to_string(board_.data()[kCounter]);
    }
    for (std::size_t scan = 0; scan < expected.values.size(); ++scan) {
      drive(test_.stimulus.steps[scan]);
      if (!wait_for(static_cast<std::uint8_t>((scan + 1) & 127U))) {
        return "no scan " + std::to_string(scan + 1);
      }
      for (const CellId id : outputs()) {
        const bool wanted = expected.values[scan][id.index()] != 0;
        if (board_.level(pin(id)) == wanted) continue;
        return "scan " + std::to_string(scan + 1) + ": the pin of " +
               test_.program->cells[id].name + " is not " +
               std::to_string(static_cast<int>(wanted));
      }
    }
    return compare_changes(expected);
  }

  /// Until the sketch begins.
  std::string start() {
    if (!board_.error().empty()) return board_.error();
    if (!put_program(board_.flash(), test_.job.program)) {
      return "no place for the program";
    }
    for (const CellId id : outputs()) {
      const std::string& name = test_.program->cells[id].name;
      board_.watch(pin(id), name);
    }
    board_.reset();
    return {};
  }

  AvrBoard& board() { return board_; }

  /// How often a pin went high; what a waveform shows.
  std::size_t rises() const { return rises_; }
  std::string waveform() const { return board_.waveform(); }

 private:
  // GPIOR0, 1 and 2: pins.ino.
  static constexpr std::size_t kCounter = 0x3e;
  static constexpr std::size_t kClock = 0x4a;

  std::vector<CellId> outputs() const {
    std::vector<CellId> found;
    for (const CellId id : ids_of(test_.program->cells)) {
      const bool output = test_.program->cells[id].role == CellRole::Output;
      if (output) found.push_back(id);
    }
    return found;
  }

  AvrBoard::Pin pin(CellId id) const {
    return wires_.digital[*digital_pin(test_.program->cells[id].name)];
  }

  /// Until the sketch has written this into its counter of scans.
  bool wait_for(std::uint8_t count) {
    for (int i = 0; i < 5000; ++i) {
      if (board_.data()[kCounter] == count) return true;
      board_.run(64);
    }
    return false;
  }

  void drive(const StimulusStep& step) {
    for (std::size_t i = 0; i < step.inputs.size(); ++i) {
      const Cell& cell = test_.program->cells[test_.stimulus.inputs[i]];
      if (cell.type == Type::Bit) {
        board_.drive(wires_.digital[*digital_pin(cell.name)],
                     step.inputs[i] != 0);
      } else {
        const auto value = static_cast<std::uint32_t>(step.inputs[i]);
        board_.drive_analog(wires_.analog[*analog_pin(cell)],
                            (value * 5000 + 1022) / 1023);
      }
    }
    clock_ += static_cast<std::uint64_t>(step.dt_ms);
    board_.data()[kClock] = static_cast<std::uint8_t>(clock_ & 0xffU);
    board_.data()[kClock + 1] = static_cast<std::uint8_t>(clock_ >> 8 & 0xffU);
  }

  /// A pin changes where the program's output does, and not in between.
  std::string compare_changes(const Execution& expected) {
    for (const CellId id : outputs()) {
      std::vector<bool> levels = {false};
      for (const auto& values : expected.values) {
        const bool level = values[id.index()] != 0;
        if (level != levels.back()) levels.push_back(level);
      }
      std::vector<bool> seen;
      for (const AvrBoard::Change& change : board_.changes(pin(id))) {
        seen.push_back(change.level);
        rises_ += change.level ? 1 : 0;
      }
      if (seen != levels) {
        return "the pin of " + test_.program->cells[id].name +
               " changes between scans";
      }
    }
    return {};
  }

  const Wires& wires_;
  const Case& test_;
  AvrBoard board_;
  std::uint64_t clock_ = 0;
  std::size_t rises_ = 0;
};

constexpr std::uint64_t kMostScans = 3000;

/// The run on pins; no value where there are none for it, or it is too long.
std::optional<Case> pin_case(const Violation& run) {
  const Program& program = run.loaded->program;
  std::uint64_t scans = 0;
  for (const Trace::Step& step : run.trace.steps) {
    if (step.dt_ms > 0xffff || step.dt_ms < program.scan.min_ms) return {};
    scans += step.repeat;
    if (scans > kMostScans) return {};
  }
  // A controller that may scan at any time cannot be led scan by scan.
  if (!has_pins(program) || program.scan.min_ms == 0) return {};
  Case test;
  test.name = run.loaded->name + ": " + run.obligation.name;
  test.program = &program;
  test.stimulus = scan_by_scan(stimulus_of(program, run.trace));
  DiagnosticList found;
  test.job = *boards::make_job(program, test.stimulus, found);
  return test;
}

void write_waveform(const std::string& board, const Case& test,
                    const std::string& waveform) {
  const char* const folder = std::getenv("RUNG_WRITE_WAVEFORMS");
  if (folder == nullptr) return;
  std::string file = board + "-" + test.name.substr(test.name.rfind('/') + 1);
  std::replace(file.begin(), file.end(), ' ', '-');
  std::ofstream out(std::string(folder) + "/" + file + ".vcd");
  out << waveform;
  EXPECT_TRUE(out.good()) << file;
}

TEST(BoardPins, GoHighExactlyWhenTheProofSaysIt) {
  Programs programs;
  programs.add_project_corpus();
  const std::vector<Violation> runs = find_runs(programs);
  std::size_t violations = 0;
  std::size_t witnesses = 0;
  std::size_t rises = 0;
  for (const Violation& run : runs) {
    const std::optional<Case> test = pin_case(run);
    if (!test) continue;
    const bool witness = run.obligation.goal == Goal::Reach;
    (witness ? witnesses : violations) += 1;
    const Execution expected = run_simulator(*test->program, test->stimulus);
    ASSERT_EQ(expected.values.size(), test->stimulus.steps.size());
    for (const Wires* const wires : {&kUno, &kYun}) {
      PinBoard board(*wires, *test);
      EXPECT_EQ(board.run(expected), "") << wires->name << ": " << test->name;
      rises += board.rises();
      write_waveform(wires->name, *test, board.waveform());
    }
  }
  std::cout << violations << " violations and " << witnesses << " witnesses of "
            << runs.size() << " runs, on two boards; " << rises
            << " times a pin went high\n";
  EXPECT_GE(violations, 15U);
  EXPECT_GE(witnesses, 25U);
  EXPECT_GE(rises, 100U);
}

// The comparison would notice a pin that does anything else.
TEST(BoardPins, AnotherRunIsNoticed) {
  Programs programs;
  ASSERT_TRUE(programs.add("latch", R"(//@ language script
//@ dialect yun
//@ scan 10..10 ms
pin3 = (pin5 || pin3) && !pin4;
)"));
  Case test;
  ASSERT_TRUE(make_case(programs.items().front(), 3, 30, test));
  Execution expected = run_simulator(*test.program, test.stimulus);
  const CellId output = find_cell(*test.program, "pin3");
  EXPECT_EQ(PinBoard(kUno, test).run(expected), "");
  expected.values[17][output.index()] ^= 1;
  EXPECT_EQ(PinBoard(kUno, test).run(expected).substr(0, 8), "scan 18:");
}

// With millis() for a clock: what is proved of a timer is measured at the pin.
TEST(BoardPins, ATimerTakesTheTimeThatIsProved) {
  Programs programs;
  ASSERT_TRUE(programs.add("timer", R"(//@ language script
//@ dialect yun
//@ scan 5..20 ms
//@ in-time: pin5 for 520 ms implies pin3
//@ not-before: after !pin5, no pin3 for 500 ms
pin3 = T(0, 0.5, pin5);
y0 = TR(0, !pin5);
)"));
  const Loaded& loaded = programs.items().front();
  for (const ObligationResult& result :
       verify(loaded.program, loaded.properties, {}).results) {
    if (result.obligation.built_in) continue;
    EXPECT_EQ(result.verdict, Verdict::Proved) << result.obligation.name;
  }
  Case test;
  ASSERT_TRUE(make_case(loaded, 1, 1, test));
  for (const Wires* const wires : {&kUno, &kYun}) {
    PinBoard pins(*wires, test, "clock");
    ASSERT_EQ(pins.start(), "");
    AvrBoard& board = pins.board();
    constexpr std::uint64_t kMillisecond = AvrBoard::kHertz / 1000;
    board.run(100 * kMillisecond);
    const std::uint64_t pressed = board.cycle();
    board.drive(wires->digital[5], true);
    board.run(700 * kMillisecond);
    const auto& changes = board.changes(wires->digital[3]);
    ASSERT_EQ(changes.size(), 2U) << "low, then high";
    const std::uint64_t after = changes[1].cycle - pressed;
    EXPECT_GT(after, 500 * kMillisecond) << wires->name;
    EXPECT_LE(after, 520 * kMillisecond) << wires->name;
  }
}

}  // namespace
}  // namespace rung
