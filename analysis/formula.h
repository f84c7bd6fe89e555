#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// The expression language of properties and of element definitions:
/// `! && || ^ -> <-> ?:` and NOT AND OR XOR, comparisons `== = != <> < <= >
/// >=`,
/// `+ - *`, numbers (with an optional unit ms or s), true and false, names
/// (dots and trailing primes belong to a name), calls f(x, ...), and
/// instances such as T(0).q, which are one name.
enum class FormulaOp : std::uint8_t {
  Name,    // text
  Number,  // number
  Bool,    // number: 0 or 1
  Not,
  Negate,
  And,
  Or,
  Xor,
  Implies,
  Equivalent,
  Choose,  // a ? b : c
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Call,  // text is the name: prev(e), once(e)
};

struct FormulaNode {
  FormulaOp op = FormulaOp::Name;
  std::uint32_t arguments = 0;  // operands; they stand right before this node
  std::uint32_t size = 1;       // nodes of this subtree
  std::int64_t number = 0;
  std::string_view text;    // Name, Call
  std::uint32_t begin = 0;  // bytes of the parsed text
  std::uint32_t end = 0;
};

/// Postorder, as frontend/ast.h; the last node is the root.
struct Formula {
  std::vector<FormulaNode> nodes;
  std::string error;           // empty when the text is a formula
  std::uint32_t error_at = 0;  // byte offset in the text
  std::uint32_t length = 0;    // bytes read
  bool has_value() const { return error.empty() && !nodes.empty(); }
  std::uint32_t root() const {
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
};

/// Parses the whole of `text`. Views in the result point into `text`.
/// Iterative: depth costs no stack. Linear time.
Formula parse_formula(std::string_view text);

}  // namespace rung
