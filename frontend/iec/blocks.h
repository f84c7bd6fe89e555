#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/iec/types.h"

namespace rung::iec {

/// An input or an output of a standard function block.
struct Pin {
  std::string_view name;
  const Type* type = &kBool;
};

/// A standard function block: the operands of its call are the inputs in this
/// order, without PT. The first output is the call's own result.
struct Block {
  std::string_view name;     // "TON"
  std::string_view element;  // "ton", in the tables of elements
  /// Dialects whose own element is `ton-matiec`; blank-separated.
  std::string_view own = {};
  std::span<const Pin> inputs;
  std::span<const Pin> outputs;

  bool is_timer() const { return inputs.back().name == "PT"; }
  std::string element_id(std::string_view dialect) const;
};

std::span<const Block> blocks();
const Block* find_block(std::string_view upper_name);
std::vector<std::string_view> block_names();

const Pin* find_pin(std::span<const Pin> pins, std::string_view upper_name);
/// `IN PT Q ET`, for messages.
std::string pin_list(const Block& block);

}  // namespace rung::iec
