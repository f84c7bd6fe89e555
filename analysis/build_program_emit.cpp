// ExpressionBuilder, the second way up: the nodes of the program.

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "analysis/build_program_expression.h"

namespace rung::build {

namespace {

/// Of comparisons and arithmetic.
NodeOp node_op(AstOp op) {
  constexpr std::array<std::pair<AstOp, NodeOp>, 10> kOps = {{
      {AstOp::Equal, NodeOp::Equal},
      {AstOp::NotEqual, NodeOp::NotEqual},
      {AstOp::Less, NodeOp::Less},
      {AstOp::LessEqual, NodeOp::LessEqual},
      {AstOp::Greater, NodeOp::Greater},
      {AstOp::GreaterEqual, NodeOp::GreaterEqual},
      {AstOp::Add, NodeOp::Add},
      {AstOp::Subtract, NodeOp::Subtract},
      {AstOp::Multiply, NodeOp::Multiply},
      {AstOp::Divide, NodeOp::Divide},
  }};
  const auto* const row =
      std::find_if(kOps.begin(), kOps.end(),
                   [op](const auto& entry) { return entry.first == op; });
  assert(row != kOps.end());
  return row->second;
}

}  // namespace

bool ExpressionBuilder::build(const AstExpression& expression, Type type) {
  begin_ = expression.begin;
  end_ = expression.end;
  failed_ = false;
  find_values();
  if (!failed_) find_uses(type);
  if (!failed_) emit();
  return !failed_;
}

void ExpressionBuilder::emit() {
  results_.assign(end_ - begin_, 0);
  branches_.assign(end_ - begin_, 0);
  for (std::uint32_t node = begin_; node < end_; ++node) {
    if (use(node).skip) continue;
    if (value(node).constant) {
      emit_constant(node);
    } else {
      emit_node(node);
      emit_conversions(node);
    }
    emit_suffix(node);
    if (use(node).branch != 0) emit_branch(node);
  }
}

std::uint32_t ExpressionBuilder::append(NodeOp op, Type type,
                                        const SourceRange& where,
                                        std::uint32_t a, std::uint32_t b) {
  program_->nodes.push_back(
      {.op = op, .type = type, .a = a, .b = b, .where = where});
  return static_cast<std::uint32_t>(program_->nodes.size() - 1);
}

std::uint32_t ExpressionBuilder::append_constant(Type type, std::int64_t value,
                                                 const SourceRange& where) {
  const std::uint32_t at = append(NodeOp::Constant, type, where);
  program_->nodes[at].value = value;
  return at;
}

void ExpressionBuilder::emit_constant(std::uint32_t node) {
  const Value& number = value(node);
  const bool bit =
      use(node).as == Use::As::Bit ||
      (use(node).as == Use::As::Itself && number.type == Type::Bit);
  results_[node - begin_] =
      bit ? append_constant(Type::Bit, number.low != 0 ? 1 : 0,
                            ast_node(node).where)
          : append_constant(Type::Word, number.low * use(node).factor,
                            ast_node(node).where);
}

void ExpressionBuilder::emit_node(std::uint32_t node) {
  const AstNode& ast = ast_node(node);
  std::uint32_t& result = results_[node - begin_];
  switch (ast.op) {
    case AstOp::Name: {
      result = append(NodeOp::Read, value(node).type, ast.where);
      program_->nodes[result].cell = names_->of_node(node).cell;
      break;
    }
    case AstOp::Number:
    case AstOp::Bool:
    case AstOp::String:
      break;  // constants; a text is never a value
    case AstOp::Not:
      result = append(NodeOp::Not, Type::Bit, ast.where, result_of(node - 1));
      break;
    case AstOp::Negate:
      result =
          append(NodeOp::Negate, Type::Word, ast.where, result_of(node - 1));
      result = wrapped(result, node);
      break;
    case AstOp::Call:
      emit_call(node);
      break;
    case AstOp::And:
    case AstOp::Or:
    case AstOp::Xor:
      emit_choice(node);
      break;
    case AstOp::Equal:
    case AstOp::NotEqual:
    case AstOp::Less:
    case AstOp::LessEqual:
    case AstOp::Greater:
    case AstOp::GreaterEqual:
      emit_comparison(node);
      break;
    case AstOp::Add:
    case AstOp::Subtract:
    case AstOp::Multiply:
    case AstOp::Divide:
      emit_arithmetic(node);
      break;
  }
}

void ExpressionBuilder::emit_choice(std::uint32_t node) {
  const AstOp op = ast_node(node).op;
  const NodeOp kind = op == AstOp::And  ? NodeOp::And
                      : op == AstOp::Or ? NodeOp::Or
                                        : NodeOp::Xor;
  const std::uint32_t result =
      append(kind, Type::Bit, ast_node(node).where, result_of(left_of(node)),
             result_of(right_of(node)));
  results_[node - begin_] = result;
  if (const std::uint32_t marker = branches_[node - begin_]) {
    program_->nodes[marker].target = result;
    program_->nodes[marker].skip_when = op == AstOp::Or;
  }
}

/// Two bits are equal when they do not differ.
void ExpressionBuilder::emit_comparison(std::uint32_t node) {
  const SourceRange& where = ast_node(node).where;
  const AstOp op = ast_node(node).op;
  const std::uint32_t a = result_of(left_of(node));
  const std::uint32_t b = result_of(right_of(node));
  std::uint32_t& result = results_[node - begin_];
  if (program_->nodes[a].type == Type::Word) {
    result = append(node_op(op), Type::Bit, where, a, b);
    return;
  }
  result = append(NodeOp::Xor, Type::Bit, where, a, b);
  if (op == AstOp::Equal) {
    result = append(NodeOp::Not, Type::Bit, where, result);
  }
}

void ExpressionBuilder::emit_arithmetic(std::uint32_t node) {
  const AstOp op = ast_node(node).op;
  std::uint32_t& result = results_[node - begin_];
  result = result_of(left_of(node));
  // The sim dialect divides by scaling; see use_arithmetic.
  if (op == AstOp::Divide && !is_yun()) return;
  result = append(node_op(op), Type::Word, ast_node(node).where, result,
                  result_of(right_of(node)));
  result = wrapped(result, node);
}

/// The controller's words wrap; where the bounds say that they cannot, there
/// is nothing to wrap.
std::uint32_t ExpressionBuilder::wrapped(std::uint32_t result,
                                         std::uint32_t node) {
  if (!value(node).wraps) return result;
  return append(NodeOp::Wrap16, Type::Word, ast_node(node).where, result);
}

void ExpressionBuilder::emit_call(std::uint32_t node) {
  const ResolvedCall& call = call_of(node);
  const SourceRange& where = ast_node(node).where;
  std::uint32_t& result = results_[node - begin_];
  const auto argument = [&](std::size_t i) {
    return result_of(call.arguments[i]);
  };
  if (call.kind == ResolvedCall::Kind::Orn) {
    result = append(NodeOp::And, Type::Bit, where, argument(1), argument(2));
    return;
  }
  if (call.kind == ResolvedCall::Kind::Cmp) {
    const std::string_view op = ast_node(call.arguments[1]).text;
    const NodeOp compare = op == "="   ? NodeOp::Equal
                           : op == ">" ? NodeOp::Greater
                                       : NodeOp::Less;
    result = append(compare, Type::Bit, where, argument(0), argument(2));
    if (op == "=" || op == ">" || op == "<") return;
    // Any other operator: both operands are evaluated, the result is false.
    const std::uint32_t no = append_constant(Type::Bit, 0, where);
    result = append(NodeOp::And, Type::Bit, where, result, no);
    return;
  }
  ElementCall element;
  element.instance = instance(call, where);
  element.operation = call.found.operation;
  element.parameter = call.parameter;
  element.where = where;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (!use(call.arguments[i]).skip) element.arguments.push_back(argument(i));
  }
  result = append(NodeOp::Call, Type::Bit, where);
  program_->nodes[result].call = program_->calls.add(std::move(element));
}

InstanceId ExpressionBuilder::instance(const ResolvedCall& call,
                                       const SourceRange& where) {
  const ElementKind* const kind = call.found.kind;
  const auto [at, added] =
      instances_.emplace(InstanceKey{kind, call.index}, InstanceId());
  if (added) {
    Instance instance;
    instance.kind = kind;
    instance.index = call.index;
    instance.name =
        std::string(kind->letter) + "(" + std::to_string(call.index) + ")";
    instance.where = where;
    at->second = program_->instances.add(std::move(instance));
  }
  Instance& found = program_->instances[at->second];
  found.largest_parameter = std::max(found.largest_parameter, call.parameter);
  found.clock_cap = found.largest_parameter + 1;
  return at->second;
}

/// From what the node gives to what the operator above takes.
void ExpressionBuilder::emit_conversions(std::uint32_t node) {
  const Use& used = use(node);
  const SourceRange& where = ast_node(node).where;
  std::uint32_t& result = results_[node - begin_];
  const Type type = value(node).type;
  if (used.as == Use::As::Bit && type == Type::Word) {
    result = append(NodeOp::ToBit, Type::Bit, where, result);
  }
  if (used.as != Use::As::Word) return;
  if (type == Type::Bit) {
    result = append(NodeOp::ToWord, Type::Word, where, result);
  }
  if (used.factor == -1) {
    result = append(NodeOp::Negate, Type::Word, where, result);
  } else if (used.factor != 1) {
    const std::uint32_t factor =
        append_constant(Type::Word, used.factor, where);
    result = append(NodeOp::Multiply, Type::Word, where, result, factor);
  }
}

/// ORN(a, b, c) is (a || b) && !c: the Or stands behind b, the Not behind c.
void ExpressionBuilder::emit_suffix(std::uint32_t node) {
  const SourceRange& where = ast_node(node).where;
  std::uint32_t& result = results_[node - begin_];
  if (use(node).suffix == Use::Suffix::OrnNot) {
    result = append(NodeOp::Not, Type::Bit, where, result);
  }
  if (use(node).suffix == Use::Suffix::OrnOr) {
    const std::uint32_t first = node - ast_node(node).size;
    result = append(NodeOp::Or, Type::Bit, cover(ast_node(first).where, where),
                    result_of(first), result);
  }
}

/// The marker behind the left operand; the And or Or above fills in the rest.
void ExpressionBuilder::emit_branch(std::uint32_t node) {
  const std::uint32_t marker = append(
      NodeOp::Branch, Type::Bit, ast_node(node).where, results_[node - begin_]);
  branches_[use(node).branch - begin_] = marker;
}

}  // namespace rung::build
