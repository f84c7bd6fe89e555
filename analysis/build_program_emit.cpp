// ExpressionBuilder, the second way up: the nodes of the program.

#include <algorithm>
#include <string>
#include <utility>

#include "analysis/build_program_expression.h"

namespace rung::build {

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
      result = append(NodeOp::Not, Type::Bit, ast.where,
                      results_[node - 1 - begin_]);
      break;
    case AstOp::Negate:
      result = append(NodeOp::Negate, Type::Word, ast.where,
                      results_[node - 1 - begin_]);
      result = wrapped(result, node);
      break;
    case AstOp::Call:
      emit_call(node);
      break;
    default:
      emit_operator(node);
      break;
  }
}

void ExpressionBuilder::emit_operator(std::uint32_t node) {
  const AstNode& ast = ast_node(node);
  const std::uint32_t a = results_[left_of(node) - begin_];
  std::uint32_t& result = results_[node - begin_];
  if (ast.op == AstOp::Divide && !is_yun()) {
    result = a;  // scaled; see use_arithmetic
    return;
  }
  const std::uint32_t b = results_[right_of(node) - begin_];
  const auto bit = [&](NodeOp op) {
    result = append(op, Type::Bit, ast.where, a, b);
  };
  const auto word = [&](NodeOp op) {
    result = wrapped(append(op, Type::Word, ast.where, a, b), node);
  };
  switch (ast.op) {
    case AstOp::And:
    case AstOp::Or:
      bit(ast.op == AstOp::And ? NodeOp::And : NodeOp::Or);
      if (const std::uint32_t marker = branches_[node - begin_]) {
        program_->nodes[marker].target = result;
        program_->nodes[marker].skip_when = ast.op == AstOp::Or;
      }
      break;
    case AstOp::Xor:
      bit(NodeOp::Xor);
      break;
    case AstOp::Equal:
    case AstOp::NotEqual:
      result = emit_equality(ast.op, a, b, ast.where);
      break;
    case AstOp::Less:
      bit(NodeOp::Less);
      break;
    case AstOp::LessEqual:
      bit(NodeOp::LessEqual);
      break;
    case AstOp::Greater:
      bit(NodeOp::Greater);
      break;
    case AstOp::GreaterEqual:
      bit(NodeOp::GreaterEqual);
      break;
    case AstOp::Add:
      word(NodeOp::Add);
      break;
    case AstOp::Subtract:
      word(NodeOp::Subtract);
      break;
    case AstOp::Multiply:
      word(NodeOp::Multiply);
      break;
    case AstOp::Divide:
      word(NodeOp::Divide);
      break;
    default:
      break;
  }
}

std::uint32_t ExpressionBuilder::emit_equality(AstOp op, std::uint32_t a,
                                               std::uint32_t b,
                                               const SourceRange& where) {
  const bool equal = op == AstOp::Equal;
  if (program_->nodes[a].type == Type::Word) {
    return append(equal ? NodeOp::Equal : NodeOp::NotEqual, Type::Bit, where, a,
                  b);
  }
  const std::uint32_t differ = append(NodeOp::Xor, Type::Bit, where, a, b);
  return equal ? append(NodeOp::Not, Type::Bit, where, differ) : differ;
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
    return results_[call.arguments[i] - begin_];
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
  std::string name =
      std::string(kind->letter) + "(" + std::to_string(call.index) + ")";
  const auto [at, added] = instances_.emplace(name, InstanceId());
  if (added) {
    Instance instance;
    instance.kind = kind;
    instance.index = call.index;
    instance.name = std::move(name);
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
                    results_[first - begin_], result);
  }
}

/// The marker behind the left operand; the And or Or above fills in the rest.
void ExpressionBuilder::emit_branch(std::uint32_t node) {
  const std::uint32_t marker = append(
      NodeOp::Branch, Type::Bit, ast_node(node).where, results_[node - begin_]);
  branches_[use(node).branch - begin_] = marker;
}

}  // namespace rung::build
