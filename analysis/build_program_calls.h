#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/build_program_number.h"
#include "analysis/program.h"
#include "frontend/error_limit.h"

namespace rung::build {

/// A call in a rung, resolved: an element, or one of the two functions that
/// are expressions.
struct ResolvedCall {
  enum class Kind : std::uint8_t { Element, Orn, Cmp, Wrong };
  Kind kind = Kind::Wrong;
  FoundOperation found;
  std::int64_t index = 0;
  std::int64_t parameter = 0;            // as ElementCall::parameter
  std::vector<std::uint32_t> arguments;  // AST nodes, all of them
};

/// Which function is called, and with the right number of arguments?
/// Errors: RP024 unknown function, RP025 number of arguments.
ResolvedCall resolve_call(const Ast& ast, std::uint32_t node,
                          ErrorLimit& errors);

/// The constant value of an argument; no value when it is not constant.
using ConstantArgument = std::optional<Fraction>;

/// The operands of an element call that are no signals.
/// Errors: RP026 index, RP027 time, RP028 count.
std::int64_t check_index(const Ast& ast, const AstNode& node,
                         ErrorLimit& errors);
std::int64_t check_seconds(const AstNode& node, ConstantArgument value,
                           SecondsRounding rounding, ErrorLimit& errors);
std::int64_t check_count(const Ast& ast, const AstNode& node,
                         ConstantArgument value, ErrorLimit& errors);

}  // namespace rung::build
