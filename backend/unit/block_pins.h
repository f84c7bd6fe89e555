#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/program.h"

namespace rung::backend {

/// A block of IEC 61131-3, be it that of the standard or of matiec.
bool is_block(const ElementKind& kind);

/// The first output of a block: "QU" of "CTUD".
std::string_view output_of(std::string_view block);

/// A cell that a reader of an IEC language made for a pin of a block.
struct BlockPin {
  CellId cell;
  InstanceId instance;
  std::string_view name;  // "CU"
  Type type = Type::Bit;
  /// An input's value at every call, where it is always the same number.
  std::optional<std::int64_t> constant;
};

/// Inputs, and the outputs that are written by the calls of their block alone.
/// Linear in the program.
std::vector<BlockPin> find_block_pins(const Program& program);

}  // namespace rung::backend
