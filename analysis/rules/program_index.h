#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/property.h"

namespace rung {

/// Lists of numbers by a key, in one array: built in two passes over the pairs
/// (key, item), whose order stays within a list.
class Grouped {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  Grouped() = default;
  Grouped(std::size_t keys, const std::vector<Pair>& pairs);

  std::span<const std::uint32_t> operator[](std::uint32_t key) const {
    return {items_.data() + starts_[key], starts_[key + 1] - starts_[key]};
  }

 private:
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> items_;
};

/// Who writes, reads and calls what: flat tables that all rules share.
/// Limits: built in time linear in the program.
struct ProgramIndex {
  ProgramIndex(const Program& program, const PropertySet& properties);

  Grouped writers;  // by cell: rungs, in scan order
  Grouped reads;    // by cell: nodes, in scan order
  Grouped calls;    // by instance: calls, in scan order

  std::vector<std::uint32_t> rung_of;       // by node
  std::vector<std::uint32_t> rung_of_call;  // by call
  std::vector<std::uint32_t> first;   // by node: where its subtree begins
  std::vector<std::uint32_t> parent;  // by node; kNone at a rung's root

  std::vector<bool> plant_reads;   // by cell: the `//Sim` plant reads it
  std::vector<bool> plant_writes;  // by cell: the plant assigns it
  std::vector<bool> mentioned;     // by cell: a property line names it
  std::vector<bool> reads_itself;  // by rung: its expression reads its target

  static constexpr std::uint32_t kNone = 0xffff'ffff;
};

}  // namespace rung
