#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
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
  Grouped calls;    // by instance: calls but mere looks, in scan order

  std::vector<std::uint32_t> rung_of;       // by node
  std::vector<std::uint32_t> rung_of_call;  // by call
  std::vector<std::uint32_t> first;         // by node: where its subtree begins
  std::vector<std::uint32_t> parent;        // by node; kNone at a rung's root

  std::vector<bool> plant_reads;   // by cell: the `//Sim` plant reads it
  std::vector<bool> plant_writes;  // by cell: the plant assigns it
  std::vector<bool> mentioned;     // by cell: a property line names it
  std::vector<bool> observed;      // by instance: a property line names it
  std::vector<bool> reads_itself;  // by rung: its expression reads its target

  /// The cell of that name; no value when there is none.
  CellId find(std::string_view name) const {
    const auto found = names.find(name);
    return found == names.end() ? CellId() : found->second;
  }
  /// Does anything but the cell's own rungs care for its value?
  bool is_used(CellId cell) const {
    const std::uint32_t i = cell.index();
    return read_by_others[i] || plant_reads[i] || mentioned[i];
  }

  std::vector<std::uint32_t> component;  // by cell: cell_components()
  std::vector<bool> in_loop;             // by cell: it depends on itself
  std::vector<bool> read_by_others;      // by cell: in a rung of another target
  std::unordered_map<std::string_view, CellId> names;

  static constexpr std::uint32_t kNone = 0xffff'ffff;
};

}  // namespace rung
