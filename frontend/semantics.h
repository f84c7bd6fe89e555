#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace rung {

/// In which order the coils of one network are written.
enum class CoilOrder : std::uint8_t {
  Document,     // as they stand in the file
  Position,     // by row, then by column, as the drawing looks
  Snapshot,     // contacts see the values from before the network
  ColumnMajor,  // column by column, all rows of one before the next
};

/// What a drawing or a list means where tools differ. A preset is a whole
/// policy under the name of the tool that has it; every report names it.
struct Semantics {
  std::string_view name;      // for --semantics
  std::string_view elements;  // dialect of element_kinds()
  CoilOrder order = CoilOrder::Document;
  /// Inputs are sampled once a scan; else every read is a fresh sample.
  bool input_image = true;
  std::string_view summary;  // one sentence for docs/semantics.md
};

/// Every preset, in a fixed order.
std::span<const Semantics> semantics_presets();

/// By name; null when there is none.
const Semantics* find_semantics(std::string_view name);

}  // namespace rung
