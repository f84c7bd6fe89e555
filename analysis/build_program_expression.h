#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "analysis/build_program_calls.h"
#include "analysis/build_program_names.h"
#include "analysis/build_program_number.h"
#include "analysis/program.h"
#include "frontend/error_limit.h"

namespace rung::build {

/// What is known of an expression's value before it is executed.
///
/// The sim dialect computes with doubles. A value here is
/// `number / denominator`, where `number` is an integer expression with bounds
/// [low, high]: so fractions are carried exactly, up to the comparison that
/// uses them.
struct Value {
  enum class Precision : std::uint8_t {
    Exact,    // a double holds it: the denominator is a power of two
    Rounded,  // the double nearest to it: one division, or a decimal
    Inexact,  // further rounded: no use but as a time
  };
  Type type = Type::Bit;
  Precision precision = Precision::Exact;
  bool constant = false;  // then low == high
  bool calls = false;     // an element is called inside
  bool wraps = false;     // yun: [low, high] is the range after wrapping
  std::int64_t low = 0;
  std::int64_t high = 1;
  std::int64_t denominator = 1;
};

/// What the operator above makes of a node.
struct Use {
  enum class As : std::uint8_t { Itself, Bit, Word };
  enum class Suffix : std::uint8_t { None, OrnOr, OrnNot };
  As as = As::Itself;
  Suffix suffix = Suffix::None;  // ORN: what stands behind this operand
  bool skip = false;             // folded, or an operand that is no value
  bool truth_only = false;       // only whether it is true matters
  std::uint32_t branch = 0;      // left operand of this short-circuit node
  std::int64_t factor = 1;       // of the number, so that two can be compared
};

/// Checks one expression of the Ast and appends its nodes to a program:
/// upwards for what the values are, downwards for how they are used, and
/// upwards again to write the nodes. Three loops; no recursion.
class ExpressionBuilder {
 public:
  ExpressionBuilder(const Ast& ast, const SymbolTable& names, Program& program,
                    ErrorLimit& errors)
      : ast_(&ast), names_(&names), program_(&program), errors_(&errors) {}

  /// Appends `expression` as a value of `type`; false when it has errors
  /// (which are reported): then nothing is appended.
  bool build(const AstExpression& expression, Type type);

  /// The value of an expression that must be constant; nothing when it is not
  /// (which is not reported).
  std::optional<Fraction> constant(const AstExpression& expression);

  /// Errors that need the whole program: `===` where a number stands for a
  /// bit somewhere.
  void finish();
  /// A bit cell is given a number, or a word cell a truth value.
  void note_mixed(const SourceRange& where);

 private:
  // build_program_values.cpp: upwards
  void find_values();
  Value value_of(std::uint32_t node);
  Value name_value(std::uint32_t node) const;
  Value number_value(std::uint32_t node);
  Value negated(std::uint32_t node);
  Value arithmetic(std::uint32_t node);
  Value folded(std::uint32_t node, const Value& left, const Value& right);
  Value sum(std::uint32_t node, Value left, Value right);
  Value product(std::uint32_t node, const Value& left, const Value& right);
  Value quotient(std::uint32_t node, const Value& left, const Value& right);
  Value bounded(std::uint32_t node, Wide low, Wide high, Value value);
  Value comparison(std::uint32_t node);
  Value call_value(std::uint32_t node);
  void check_element_call(ResolvedCall& call);
  ConstantArgument constant_argument(std::uint32_t node) const;

  // build_program_uses.cpp: downwards
  void find_uses(Type type);
  void use_operands(std::uint32_t node);
  void use_comparison(std::uint32_t node);
  void use_arithmetic(std::uint32_t node);
  void use_call(std::uint32_t node);
  void check_use(std::uint32_t node);
  void check_as_bit(std::uint32_t node);
  void check_controller_word(std::uint32_t node);
  void check_cmp_operator(std::uint32_t node);
  Use& use(std::uint32_t node) { return uses_[node - begin_]; }
  const Use& use(std::uint32_t node) const { return uses_[node - begin_]; }

  // build_program_emit.cpp: upwards
  void emit();
  void emit_node(std::uint32_t node);
  void emit_constant(std::uint32_t node);
  void emit_choice(std::uint32_t node);
  void emit_comparison(std::uint32_t node);
  void emit_arithmetic(std::uint32_t node);
  std::uint32_t wrapped(std::uint32_t result, std::uint32_t node);
  void emit_call(std::uint32_t node);
  void emit_conversions(std::uint32_t node);
  void emit_suffix(std::uint32_t node);
  void emit_branch(std::uint32_t node);
  std::uint32_t append(NodeOp op, Type type, const SourceRange& where,
                       std::uint32_t a = 0, std::uint32_t b = 0);
  std::uint32_t append_constant(Type type, std::int64_t value,
                                const SourceRange& where);
  InstanceId instance(const ResolvedCall& call, const SourceRange& where);

  const AstNode& ast_node(std::uint32_t node) const {
    return ast_->nodes[node];
  }
  Value& value(std::uint32_t node) { return values_[node - begin_]; }
  const Value& value(std::uint32_t node) const {
    return values_[node - begin_];
  }
  std::uint32_t right_of(std::uint32_t node) const { return node - 1; }
  std::uint32_t left_of(std::uint32_t node) const {
    return node - 1 - ast_node(node - 1).size;
  }
  std::uint32_t result_of(std::uint32_t node) const {
    return results_[node - begin_];
  }
  bool is_yun() const { return ast_->dialect == "yun"; }
  bool folds(std::uint32_t node) const {
    return value(node).constant && value(node).type == Type::Word;
  }
  const ResolvedCall& call_of(std::uint32_t node) const {
    return calls_[call_index_[node - begin_]];
  }
  void error(std::string_view code, std::uint32_t node, std::string message);

  const Ast* ast_;
  const SymbolTable* names_;
  Program* program_;
  ErrorLimit* errors_;
  bool failed_ = false;

  // Of the expression at hand; by node - begin_.
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
  std::vector<Value> values_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> results_;     // index in Program::nodes
  std::vector<std::uint32_t> branches_;    // marker of an And or Or; 0: none
  std::vector<std::uint32_t> call_index_;  // into calls_
  std::vector<ResolvedCall> calls_;

  // Of the program.
  struct InstanceKey {
    const ElementKind* kind;
    std::int64_t index;
    bool operator==(const InstanceKey&) const = default;
  };
  struct InstanceHash {
    std::size_t operator()(const InstanceKey& key) const {
      return std::hash<const void*>()(key.kind) ^
             (std::hash<std::int64_t>()(key.index) << 1U);
    }
  };
  std::unordered_map<InstanceKey, InstanceId, InstanceHash> instances_;
  std::vector<SourceRange> strict_;
  SourceRange mixed_;
};

}  // namespace rung::build
