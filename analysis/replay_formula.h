#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/formula.h"
#include "analysis/program.h"
#include "analysis/simulator.h"

namespace rung {

/// Where a name of a formula is read in the simulator.
struct Observation {
  enum class Kind : std::uint8_t { Cell, Done, Fired, Elapsed, Count };
  Kind kind = Kind::Cell;
  CellId cell;
  InstanceId instance;
  /// Fired: the calls of the instance, as positions in Program::nodes.
  std::vector<std::uint32_t> calls;
};

/// The names of a program: cells, and T(0).q, T(0).fired, T(0).elapsed,
/// C(0).value. Views into the program, which outlives it.
class ObservationNames {
 public:
  explicit ObservationNames(const Program& program);
  /// Preconditions: properties name only what the program has (assert).
  Observation find(std::string_view name) const;

 private:
  std::unordered_map<std::string_view, CellId> cells_;
  std::unordered_map<std::string_view, InstanceId> instances_;
  std::vector<std::vector<std::uint32_t>> calls_;  // by InstanceId
};

constexpr std::uint64_t kForever = ~std::uint64_t{0};

/// A formula evaluated at scan ends, with the memory that prev, begin, rose,
/// fell and once need. Before the first scan every one of these sees the
/// values that are there then, and once(e) has not been true. begin(e) is of
/// cells: it has no call inside.
class FormulaWatch {
 public:
  /// Preconditions: `text` is a formula over `names` (checked when the
  ///                property was read). `text` outlives the watch.
  FormulaWatch(const Program& program, const ObservationNames& names,
               std::string_view text);

  /// The values before the first scan.
  void start(const Simulator& simulator);
  /// Inputs are sampled, no rung has run.
  void begin(const Simulator& simulator);
  /// The scan's end.
  void end(const Simulator& simulator);

  bool holds() const { return end_.back() != 0; }
  /// Of `P -> Q`: does P? Of any other formula: true.
  bool left_side_holds() const;
  bool held_before() const { return previous_.back() != 0; }

  /// For how many more idle scans of `dt_ms` (Simulator::skip) no condition in
  /// the formula changes; what grows with time may grow.
  std::uint64_t steady_scans(const Simulator& simulator, std::int64_t dt_ms);
  /// After steady_scans(), with at most its result.
  void skip(std::uint64_t count);

 private:
  enum class Memory : std::uint8_t { None, Prev, Begin, Rose, Fell, Once };
  struct Step {
    FormulaOp op = FormulaOp::Bool;
    Memory memory = Memory::None;
    std::uint32_t operand[3] = {0, 0, 0};
    std::int64_t number = 0;
    Observation observation;
  };

  std::int64_t remembered(const Step& step, std::size_t index);
  /// Change of a step's value a scan; lowers `limit` where it cannot be kept.
  std::int64_t slope_of(const Step& step, const Simulator& simulator,
                        std::int64_t dt_ms, std::uint64_t& limit) const;
  std::int64_t operator_slope(const Step& step, std::uint64_t& limit) const;
  std::int64_t observed_slope(const Observation& seen,
                              const Simulator& simulator, std::int64_t dt_ms,
                              std::uint64_t& limit) const;

  const Program& program_;
  std::vector<Step> steps_;
  bool has_begin_ = false;
  std::vector<std::int64_t> end_;
  std::vector<std::int64_t> previous_;  // at the end of the scan before
  std::vector<std::int64_t> begin_;
  std::vector<std::int64_t> slope_;
  std::vector<bool> once_;
};

}  // namespace rung
