#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ast.h"

namespace rung {

/// An expression in postorder: sizes follow from what stands before a node.
using Expression = std::vector<AstNode>;
void push_leaf(Expression& nodes, AstOp op, std::string_view text,
               SourceRange where);
void push_unary(Expression& nodes, AstOp op, SourceRange where);
/// Joins the two operands that stand at the end.
void push_binary(Expression& nodes, AstOp op, SourceRange where);
/// A conversion, `to_word`, `to_bit` or `wrap16`, of the operand before it.
void push_conversion(Expression& nodes, std::string_view name,
                     SourceRange where);
/// Appends an operand that was built apart.
void push_all(Expression& nodes, const Expression& operand);

/// What a cell is, for those who make one.
struct CellShape {
  bool word = false;
  std::int64_t low = 0;
  std::int64_t high = 1;
};
inline constexpr CellShape kBitCell = {};
inline constexpr CellShape kInt16Cell = {true, -32'768, 32'767};

/// Writes an Ast whose cells and elements are all declared: statements, which
/// may stand behind conditions, become assignments.
///
/// While guard() names a bit, a statement has an effect only where that bit is
/// true: `x := e` is `x := g AND e OR NOT g AND x`, and an element's call in
/// `e` is not executed where `g` is false, for the Ast is one that
/// short-circuits. Guards are bits that are written once a scan, above the
/// statement. In what is assigned to a word no element may be called.
class StatementWriter {
 public:
  /// Sets `ast.evaluation`.
  explicit StatementWriter(Ast& ast);

  /// Text that the Ast may point into.
  std::string_view keep_text(std::string text);

  /// A cell that the text declares or names; its place in Ast::declarations.
  std::uint32_t declare(std::string_view name, CellShape shape,
                        AstDeclaration::Kind role, SourceRange where);
  /// A cell that the text does not name: `prefix.1`.
  std::string_view make(std::string_view prefix, CellShape shape,
                        SourceRange where);
  /// A timer, counter, edge or latch; its index.
  std::uint32_t element(std::string_view kind, std::string_view instance,
                        SourceRange where);

  std::string_view guard() const { return guard_; }
  void set_guard(std::string_view bit) { guard_ = bit; }

  void assign(std::string_view target, bool word, SourceRange target_where,
              const Expression& value, SourceRange where);
  /// A fresh cell with this value, whatever the guard is.
  std::string_view keep(std::string_view prefix, CellShape shape,
                        const Expression& value, SourceRange where);

  /// The call of an element's operation, to stand in an expression. `preset`
  /// is there if the operation has a time (ms) or a count that is a constant.
  Expression call(std::string_view operation, const Expression& operands,
                  std::uint32_t index, std::optional<std::int64_t> preset,
                  SourceRange where);

 private:
  void emit(std::string_view target, SourceRange target_where,
            const Expression& value, SourceRange where);

  Ast* ast_;
  std::string_view guard_;
  std::uint32_t made_ = 0;
  std::uint32_t elements_ = 0;
};

}  // namespace rung
