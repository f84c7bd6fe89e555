// Random sketches do in the simulator what the listings of the published
// library do, executed here call by call on plain integers.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/simulator.h"
#include "frontend/plclib/reader.h"

namespace rung::test {
namespace {

struct Statement {
  std::string call;  // "in"; "if" and "end" are brackets
  std::string operand;
  std::string second;
};
using Statements = std::vector<Statement>;

constexpr std::array<std::int64_t, 2> kPeriods = {250, 120};  // of the tasks
constexpr std::int64_t kLongestScan = 100;  // without a `scan` line

/// The library, as its listings have it.
class Library {
 public:
  std::int64_t scan_value = 0;
  std::array<std::int64_t, 4> x = {};
  std::int64_t analogue = 0;
  std::array<std::int64_t, 4> y = {};
  std::array<std::int64_t, 2> variable = {};
  std::int64_t now = 0;

  /// `tasks`: the longest period first. `runs(t, k)`: task t is chosen at its
  /// place k, from 1.
  template <class Runs>
  void scan(const Statements& loop, const std::vector<Statements>& tasks,
            Runs runs) {
    places_ = {};
    std::vector<bool> live = {true};
    for (const Statement& statement : loop) {
      if (statement.call == "end") {
        live.pop_back();
        continue;
      }
      point(tasks, 0, runs, live.back());
      if (statement.call == "if") {
        live.push_back(live.back() && read(statement.operand) != 0);
      } else if (live.back()) {
        call(statement);
      }
    }
    point(tasks, 0, runs, true);
  }

 private:
  template <class Runs>
  void point(const std::vector<Statements>& tasks, std::size_t level, Runs runs,
             bool live) {
    for (std::size_t task = level; task < tasks.size(); ++task) {
      const bool chosen = runs(task, ++places_[task]) && live;
      const bool early =
          ran_[task] && now - ran_at_[task] + kLongestScan <= kPeriods[task];
      const bool starts = chosen && !early;
      if (starts) {
        ran_[task] = true;
        ran_at_[task] = now;
      }
      for (const Statement& statement : tasks[task]) {
        point(tasks, task + 1, runs, starts);
        if (starts) call(statement);
      }
    }
  }

  std::int64_t& cell(const std::string& name) {
    const auto digit = static_cast<std::size_t>(name[1] - '0');
    if (name[0] == 'X') return x[digit];
    if (name[0] == 'Y') return y[digit];
    return variable[digit];
  }
  std::int64_t read(const std::string& name) { return cell(name); }

  void call(const Statement& statement) {
    const std::string& name = statement.call;
    std::int64_t& sv = scan_value;
    const std::string& on = statement.operand;
    if (name == "in") sv = read(on);
    if (name == "inNot") sv = read(on) == 1 ? 0 : 1;
    if (name == "inAnalog") sv = analogue;
    if (name == "andBit") sv = sv & read(on);
    if (name == "orBit") sv = sv | read(on);
    if (name == "xorBit") sv = sv ^ read(on);
    if (name == "andNotBit") sv = sv & ~read(on);
    if (name == "orNotBit" && sv != 1) sv = read(on) == 0 ? 1 : 0;
    if (name == "out") cell(on) = sv == 1 ? 1 : 0;
    if (name == "outNot") cell(on) = sv == 1 ? 0 : 1;
    if (name == "set") {
      sv = sv | read(on);
      if (sv == 1) cell(on) = 1;
    }
    if (name == "reset" && sv == 1) cell(on) = 0;
    if (name == "latch") {
      sv = sv | read(on);
      sv = sv & ~read(statement.second);
      cell(on) = sv == 1 ? 1 : 0;
    }
    if (name == "compareGT") sv = sv > read(on) ? 1 : 0;
    if (name == "timerOn") timer_on();
    if (name == "c.countUp") count_up();
    if (name == "c.clear" && sv == 1) count_ = up_ = 0;
    if (name == "c.upperQ") sv = count_ == 3 ? 1 : 0;
    if (name == "p.inClock") clock();
    if (name == "p.rising") sv = rising_;
    if (name == "s.shiftLeft") shift_left();
    if (name == "s.inputBit") input_ = sv == 0 ? 0 : 1;
    if (name == "s.bitValue") sv = (register_ >> 2) & 1;
  }

  void timer_on() {
    if (scan_value == 0) {
      started_ = false;
    } else if (!started_) {
      started_ = true;
      start_ = now;
      scan_value = 0;
    } else {
      scan_value = now - start_ >= 120 ? 1 : 0;
    }
  }
  void count_up() {
    if (count_ == 3) return;
    if (scan_value == 0) {
      up_ = 0;
    } else if (up_ == 0) {
      up_ = 1;
      ++count_;
    }
  }
  void clock() {
    const std::int64_t level = scan_value == 1 ? 1 : 0;
    rising_ = level == 1 && clock_ == 0 ? 1 : 0;
    clock_ = level;
  }
  void shift_left() {
    if (scan_value == 0) {
      left_ = 0;
    } else if (left_ == 0) {
      left_ = 1;
      register_ = (register_ << 1 | input_) & 0xffff;
    }
  }

  std::array<std::size_t, 2> places_ = {};
  std::array<bool, 2> ran_ = {};
  std::array<std::int64_t, 2> ran_at_ = {};

  bool started_ = false;
  std::int64_t start_ = 0;
  std::int64_t count_ = 0, up_ = 0;
  std::int64_t clock_ = 0, rising_ = 0;
  std::int64_t register_ = 0x8005, left_ = 0, input_ = 0;
};

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  int pick(int count) {
    return static_cast<int>(engine_() % static_cast<std::uint64_t>(count));
  }

 private:
  std::mt19937_64 engine_;
};

std::string one_of(Random& random, const std::vector<std::string>& names) {
  return names[static_cast<std::size_t>(
      random.pick(static_cast<int>(names.size())))];
}

/// `words`: analogue values go through the accumulator, where calls take them.
Statement random_call(Random& random, bool words) {
  const std::vector<std::string> inputs = {"X0", "X1", "X2", "Y0",
                                           "Y1", "A0", "A1"};
  const std::vector<std::string> outputs = {"Y0", "Y1", "Y2", "A0", "A1"};
  static const std::vector<std::string> kReads = {
      "in", "inNot", "andBit", "orBit", "xorBit", "andNotBit", "orNotBit"};
  const std::vector<std::string> methods = {
      "timerOn",    "c.countUp",  "c.clear",
      "c.upperQ",   "s.inputBit", "s.shiftLeft",
      "s.bitValue", "p.rising",   words ? "timerOn" : "p.inClock"};
  switch (random.pick(words ? 10 : 8)) {
    case 0:
    case 1:
    case 2:
      return {one_of(random, kReads), one_of(random, inputs), {}};
    case 3:
    case 4:
    case 5:
      return {one_of(random, {"out", "outNot", "set", "reset"}),
              one_of(random, outputs),
              {}};
    case 6:
      return {"latch", one_of(random, outputs), one_of(random, inputs)};
    case 7:
      return {one_of(random, methods), {}, {}};
    case 8:
      return {"inAnalog", {}, {}};
    default:
      return {"compareGT", one_of(random, {"A0", "A1"}), {}};
  }
}

Statements random_statements(Random& random, int count, bool conditions,
                             bool words) {
  Statements result;
  int open = 0;
  for (int i = 0; i < count; ++i) {
    const int choice = random.pick(12);
    if (conditions && choice == 0) {
      result.push_back({"if", one_of(random, {"A0", "A1"}), {}});
      ++open;
    } else if (open > 0 && choice < 4) {
      result.push_back({"end", {}, {}});
      --open;
    } else {
      result.push_back(random_call(random, words));
    }
  }
  for (; open > 0; --open) result.push_back({"end", {}, {}});
  return result;
}

/// A0 of the statements is the variable V0 of the sketch.
std::string spelled(std::string name) {
  if (name[0] == 'A') name[0] = 'V';
  return name;
}

std::string text_of(const Statements& statements) {
  std::string text;
  for (const Statement& statement : statements) {
    const std::string& name = statement.call;
    if (name == "if") {
      text += "if (" + spelled(statement.operand) + ") {";
    } else if (name == "end") {
      text += "}";
    } else if (name == "inAnalog") {
      text += "inAnalog(X3);";
    } else if (name == "timerOn") {
      text += "timerOn(T, 120);";
    } else if (name == "s.bitValue") {
      text += "s.bitValue(2);";
    } else {
      text += name + "(";
      if (!statement.operand.empty()) text += spelled(statement.operand);
      if (!statement.second.empty()) text += ", " + spelled(statement.second);
      text += ");";
    }
    text += "\n";
  }
  return text;
}

std::string sketch_of(const Statements& loop,
                      const std::vector<Statements>& tasks) {
  std::string text =
      "//@ inputs stable\n#include <plcLib.h>\nunsigned int V0, V1 = 1;\n"
      "unsigned long T;\nCounter c(3);\nShift s(0x8005);\nPulse p;\n"
      "void setup() { setupPLC(); }\nvoid loop() {\n" +
      text_of(loop) + "}\n";
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    text += "void loop" + std::to_string(i + 1) + "(" +
            std::to_string(kPeriods[i]) + ") {\n" + text_of(tasks[i]) + "}\n";
  }
  return text;
}

void compare(const Statements& loop, const std::vector<Statements>& tasks,
             Random& random) {
  const std::string text = sketch_of(loop, tasks);
  SourceSet sources;
  DiagnosticList list;
  const FileId file = sources.add("sketch.ino", text);
  const Ast ast = read_plclib(sources, file,
                              {.semantics = find_semantics("plclib14")}, list);
  const Program program = build_program(ast, {}, list);
  std::string problems;
  for (const Diagnostic& item : list.items()) problems += item.message + "\n";
  ASSERT_EQ(problems, "") << text;
  Simulator simulator(program);
  Library library;
  library.variable[1] = 1;
  const auto set = [&](const std::string& name, std::int64_t value) {
    const CellId cell = find_cell(program, name);
    if (cell.has_value()) simulator.set_input(cell, value);
  };
  for (int scan = 0; scan < 40; ++scan) {
    for (std::size_t i = 0; i < 3; ++i) {
      library.x[i] = random.pick(2);
      set("X" + std::to_string(i), library.x[i]);
    }
    library.analogue = random.pick(4);
    set("X3", library.analogue);
    std::array<std::vector<bool>, 2> runs;
    for (std::size_t i = 0; i < 2; ++i) {
      for (int place = 1; place < 150; ++place) {
        runs[i].push_back(random.pick(6) == 0);
        set("loop" + std::to_string(i + 1) + "." + std::to_string(place),
            runs[i].back() ? 1 : 0);
      }
    }
    const std::int64_t dt = 1 + random.pick(100);
    library.now += dt;
    simulator.scan(dt);
    library.scan(loop, tasks, [&](std::size_t task, std::size_t place) {
      return runs[task][place - 1];
    });
    for (std::size_t i = 0; i < 3; ++i) {
      const CellId cell = find_cell(program, "Y" + std::to_string(i));
      if (!cell.has_value()) continue;
      ASSERT_EQ(simulator.value(cell), library.y[i])
          << "Y" << i << " in scan " << scan + 1 << " of\n"
          << text;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const CellId cell = find_cell(program, "V" + std::to_string(i));
      ASSERT_EQ(simulator.value(cell), library.variable[i])
          << "V" << i << " in scan " << scan + 1 << " of\n"
          << text;
    }
  }
}

TEST(PlclibRun, RandomSketchesDoWhatTheListingsDo) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    const bool words = seed % 3 == 0;
    const Statements loop =
        random_statements(random, 1 + random.pick(25), true, words);
    ASSERT_NO_FATAL_FAILURE(compare(loop, {}, random)) << "seed " << seed;
  }
}

TEST(PlclibRun, TasksRunWhereTheyAreChosen) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const bool words = seed % 5 == 0;
    const Statements loop =
        random_statements(random, 1 + random.pick(15), true, words);
    std::vector<Statements> tasks;
    for (std::uint64_t i = 0; i <= seed % 2; ++i) {
      tasks.push_back(
          random_statements(random, 1 + random.pick(4), false, words));
    }
    ASSERT_NO_FATAL_FAILURE(compare(loop, tasks, random)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace rung::test
