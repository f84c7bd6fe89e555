#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"

namespace rung {

/// Executes a program directly, with elements written by hand from the papers'
/// listings: the second opinion on everything that the transition system says.
/// It shares no element code with it and does not look at element_kinds()'
/// step texts. 64-bit millisecond clock, 0 at power-up; the first scan runs at
/// its dt. Words saturate at 64 bits.
///
/// Errors: an element that it does not know is a broken contract (assert; the
///         program ends).
class Simulator {
 public:
  explicit Simulator(const Program& program);
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// Back to before the first scan.
  void reset();

  /// Sets an input's sample for the scans that follow; of a bit, any value but
  /// 0 is 1.
  void set_input(CellId cell, std::int64_t value);

  /// Lets `dt_ms` pass, then runs all rungs once.
  void scan(std::int64_t dt_ms);

  /// Runs the `//Sim` plant once; the inputs that it assigns get the whole part
  /// of its numbers for the scans that follow.
  void run_plant();
  bool has_plant() const;

  /// How many more scans of `dt_ms` with these inputs would do exactly what the
  /// last one did: no cell, count or bit of an element changes and no timer
  /// fires, only time passes. 0 when that is not known. It compares with its
  /// call after the scan before, so it is meant to be called after every scan.
  std::uint64_t idle_scans(std::int64_t dt_ms);

  /// Runs `count` scans at once; `count` is at most idle_scans(dt_ms).
  void skip(std::uint64_t count, std::int64_t dt_ms);

  std::int64_t value(CellId cell) const;

  /// Observations for properties: elapsed ms of a timer (unsaturated; 0 while
  /// it is not timing: a T that is not started, a TOF that is armed or out),
  /// value of a counter, done bit as T(0).q means it (docs/elements.md).
  std::int64_t elapsed(InstanceId instance) const;
  std::int64_t count(InstanceId instance) const;
  bool done(InstanceId instance) const;
  /// elapsed() grows with time in the scans of skip(); else it is constant.
  bool elapsed_grows(InstanceId instance) const;

  /// Value of the node at `index` of Program::nodes in the scan just run; 0
  /// where it was skipped. For power flow in reports.
  std::int64_t node_value(std::uint32_t index) const;
  bool node_executed(std::uint32_t index) const;

  std::int64_t now_ms() const;
  std::uint64_t scans() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Runs a whole stimulus from power-up; one Trace step a stimulus step. Scans
/// in which only time passes are not executed one by one.
///
/// The `//Sim` plant runs after every scan, unless the stimulus gives values
/// for an input that the plant writes: then the stimulus is the plant.
Trace simulate(const Program& program, const Stimulus& stimulus);

/// The same with a Trace step for each stretch of scans in which no cell
/// changes, so that no value is hidden between two steps. Where a stimulus step
/// has very many of them, as of a relay that flickers for an hour, the last of
/// its Trace steps stands for the rest and says that it `changes`.
Trace simulate_changes(const Program& program, const Stimulus& stimulus);

/// Every change of a run, for waveforms.
struct Recording {
  struct Change {
    CellId cell;
    std::int64_t value = 0;
  };
  struct Sample {
    std::int64_t now_ms = 0;
    std::vector<Change> changes;  // by CellId, each against the sample before
  };
  std::vector<std::int64_t> initial;  // by CellId index, before the first scan
  std::vector<Sample> samples;        // scans in which something changed
  std::int64_t end_ms = 0;            // the last scan
};

/// As simulate().
Recording record(const Program& program, const Stimulus& stimulus);

}  // namespace rung
