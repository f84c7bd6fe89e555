#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// Which signals a property is about, for tables that a person reads. It may
/// name more than the proof needs, never fewer.
class Cones {
 public:
  explicit Cones(const Program& program);

  /// Cells that the formulas name, in the order of the program.
  std::vector<CellId> named(std::span<const std::string> formulas) const;

  /// Those, and every cell that can change one of them, through any number of
  /// scans, in the order of the program. Linear in what it returns.
  std::vector<CellId> of(std::span<const std::string> formulas) const;

  /// The rungs that write one of `cells`, in scan order.
  std::vector<RungId> drivers(std::span<const CellId> cells) const;

 private:
  struct Found {
    std::vector<CellId> cells;
    std::vector<InstanceId> instances;
  };
  Found look_up(std::span<const std::string> formulas) const;

  const Program& program_;
  std::unordered_map<std::string_view, CellId> cells_;
  std::unordered_map<std::string_view, InstanceId> instances_;
  std::vector<std::vector<RungId>> writers_;  // by CellId
  std::vector<std::vector<RungId>> callers_;  // by InstanceId
};

}  // namespace rung
