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
/// step texts. 64-bit millisecond clock.
class Simulator {
 public:
  explicit Simulator(const Program& program);
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// Back to before the first scan.
  void reset();

  /// Sets an input's sample for the scans that follow.
  void set_input(CellId cell, std::int64_t value);

  /// Lets `dt_ms` pass, then runs all rungs once.
  void scan(std::int64_t dt_ms);

  /// Runs the `//Sim` plant once; the inputs that it assigns get its values.
  void run_plant();

  std::int64_t value(CellId cell) const;

  /// Observations for properties: elapsed ms of a timer (unsaturated; 0 while
  /// it is not timing: a T that is not started, a TOF that is armed or out),
  /// value of a counter, done bit as T(0).q means it (docs/elements.md).
  std::int64_t elapsed(InstanceId instance) const;
  std::int64_t count(InstanceId instance) const;
  bool done(InstanceId instance) const;

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

/// Runs a whole stimulus from power-up; one Trace step a stimulus step.
Trace simulate(const Program& program, const Stimulus& stimulus);

}  // namespace rung
