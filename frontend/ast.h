#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// What every reader produces: assignments in scan order, uninterpreted.
/// Names, element calls and types are resolved later, by analysis/.
///
/// All string views point into the text of the file, which outlives the Ast,
/// into static storage, or into Ast::made_names.

enum class AstOp : std::uint8_t {
  Name,    // text
  Number,  // text, as written: "20", "0.5", "1e3", "0x1F"
  Bool,    // text: "true" or "false"
  String,  // text, without the quotes
  Not,
  Negate,
  And,
  Or,
  Xor,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Call,  // text is the callee's name; `arguments` operands
};

/// Expressions are stored in postorder: the operands of a node stand right
/// before it, each as one contiguous run of nodes. So every walk is a loop over
/// an array, and depth costs no stack.
struct AstNode {
  AstOp op = AstOp::Name;
  std::uint32_t arguments = 0;  // how many operands
  std::uint32_t size = 1;       // nodes in this subtree, itself included
  SourceRange where;
  std::string_view text;
};

/// A run of Ast::nodes that is one expression; its root is the last node.
struct AstExpression {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  bool has_value() const { return begin != end; }
  std::uint32_t root() const { return end - 1; }
};

struct AstAssignment {
  std::string_view target;
  SourceRange target_where;
  AstExpression value;
  SourceRange where;  // target to the last character of the value
};

/// A statement of the plant (the `//Sim` section), in order. If/Else/End are
/// brackets: each If has one End and at most one Else between them.
struct AstPlantStatement {
  enum class Kind : std::uint8_t { Assign, If, Else, End, IgnoredCall };
  Kind kind = Kind::Assign;
  std::string_view target;  // of Assign; the callee's name of IgnoredCall
  SourceRange target_where;
  AstExpression value;  // of Assign; the condition of If
  SourceRange where;
};

/// One property line: the text after `//@`, trimmed. Not parsed by readers.
struct AstAnnotation {
  std::string_view text;
  SourceRange where;  // of `text`
};

/// Ordinary comments, for rules about commented-out logic and for suppression.
struct AstComment {
  std::string_view text;  // without the comment marks
  SourceRange where;
};

/// How `&&` and `||` evaluate their right operand. Where it matters (a timer
/// or a counter in the right operand) the two differ.
enum class Evaluation : std::uint8_t { Strict, ShortCircuit };

/// A cell or the state of an element that the text itself declares (postfix,
/// the languages of IEC 61131-3): there nothing is inferred from use.
struct AstDeclaration {
  enum class Kind : std::uint8_t { Input, Output, Memory, Element };
  Kind kind = Kind::Memory;
  bool word = false;      // of a cell: a word, else a bit
  std::string_view name;  // a cell's name; an element's kind ("timer-yun")
  std::int64_t initial = 0;
  std::int64_t low = 0;
  std::int64_t high = 1;
  std::int64_t index = 0;          // of an element: the 0 of T(0)
  std::string_view instance = {};  // of an element that has a name: `timer1`
  bool made = false;               // a cell that the text does not name
  bool initialised = false;        // the text says its initial value
  SourceRange where;
};

struct Ast {
  FileId file;
  std::string_view language;  // "script", "postfix", ...: static storage
  /// Of element_kinds(): "yun", "sim", "iec", or empty: static storage.
  std::string_view dialect;
  /// The preset of semantics_presets(); empty: the one named as the dialect.
  std::string_view semantics;
  std::vector<AstNode> nodes;
  std::vector<AstAssignment> rungs;     // in scan order
  std::vector<AstAssignment> initials;  // `//Var`: values before the first scan
  std::vector<AstPlantStatement> plant;
  std::vector<AstAnnotation> annotations;
  std::vector<AstComment> comments;

  // What only a text says that declares everything.
  std::vector<AstDeclaration> declarations;
  std::vector<std::shared_ptr<const std::string>> made_names;
  Evaluation evaluation = Evaluation::Strict;
  std::int64_t scan_min_ms = 1;
  std::int64_t scan_max_ms = 100;
};

}  // namespace rung
