#include "frontend/statements.h"

#include <memory>
#include <utility>

namespace rung {
namespace {

std::string_view sign_of(AstOp op) {
  switch (op) {
    case AstOp::Not:
      return "!";
    case AstOp::And:
      return "&&";
    case AstOp::Or:
      return "||";
    case AstOp::Xor:
      return "^";
    case AstOp::Equal:
      return "==";
    case AstOp::NotEqual:
      return "!=";
    case AstOp::Less:
      return "<";
    case AstOp::LessEqual:
      return "<=";
    case AstOp::Greater:
      return ">";
    case AstOp::GreaterEqual:
      return ">=";
    case AstOp::Add:
      return "+";
    case AstOp::Negate:
    case AstOp::Subtract:
      return "-";
    case AstOp::Multiply:
      return "*";
    case AstOp::Divide:
      return "/";
    case AstOp::Name:
    case AstOp::Number:
    case AstOp::Bool:
    case AstOp::String:
    case AstOp::Call:
      return {};
  }
  return {};
}

/// `g AND then OR NOT g AND otherwise`; for words the same with `*` and `+`.
Expression chosen(std::string_view guard, bool word, const Expression& then,
                  std::string_view otherwise, SourceRange otherwise_where,
                  SourceRange where) {
  const AstOp times = word ? AstOp::Multiply : AstOp::And;
  Expression nodes;
  nodes.reserve(then.size() + 9);
  push_leaf(nodes, AstOp::Name, guard, where);
  if (word) push_conversion(nodes, "to_word", where);
  push_all(nodes, then);
  push_binary(nodes, times, where);
  push_leaf(nodes, AstOp::Name, guard, where);
  push_unary(nodes, AstOp::Not, where);
  if (word) push_conversion(nodes, "to_word", where);
  push_leaf(nodes, AstOp::Name, otherwise, otherwise_where);
  push_binary(nodes, times, where);
  push_binary(nodes, word ? AstOp::Add : AstOp::Or, where);
  return nodes;
}

AstDeclaration cell_declaration(std::string_view name, CellShape shape,
                                AstDeclaration::Kind role, SourceRange where) {
  AstDeclaration declaration;
  declaration.kind = role;
  declaration.word = shape.word;
  declaration.name = name;
  declaration.low = shape.low;
  declaration.high = shape.high;
  declaration.where = where;
  return declaration;
}

}  // namespace

void push_leaf(Expression& nodes, AstOp op, std::string_view text,
               SourceRange where) {
  nodes.push_back({.op = op, .where = where, .text = text});
}

void push_unary(Expression& nodes, AstOp op, SourceRange where) {
  const std::uint32_t size = nodes.back().size + 1;
  nodes.push_back({.op = op,
                   .arguments = 1,
                   .size = size,
                   .where = where,
                   .text = sign_of(op)});
}

void push_binary(Expression& nodes, AstOp op, SourceRange where) {
  const std::uint32_t right = nodes.back().size;
  const std::uint32_t left = nodes[nodes.size() - 1 - right].size;
  nodes.push_back({.op = op,
                   .arguments = 2,
                   .size = left + right + 1,
                   .where = where,
                   .text = sign_of(op)});
}

void push_conversion(Expression& nodes, std::string_view name,
                     SourceRange where) {
  push_unary(nodes, AstOp::Call, where);
  nodes.back().text = name;
}

void push_all(Expression& nodes, const Expression& operand) {
  nodes.insert(nodes.end(), operand.begin(), operand.end());
}

StatementWriter::StatementWriter(Ast& ast) : ast_(&ast) {
  ast.evaluation = Evaluation::ShortCircuit;
}

std::string_view StatementWriter::keep_text(std::string text) {
  ast_->made_names.push_back(
      std::make_shared<const std::string>(std::move(text)));
  return *ast_->made_names.back();
}

std::uint32_t StatementWriter::declare(std::string_view name, CellShape shape,
                                       AstDeclaration::Kind role,
                                       SourceRange where) {
  ast_->declarations.push_back(cell_declaration(name, shape, role, where));
  return static_cast<std::uint32_t>(ast_->declarations.size() - 1);
}

std::string_view StatementWriter::make(std::string_view prefix, CellShape shape,
                                       SourceRange where) {
  const std::string_view name =
      keep_text(std::string(prefix) + "." + std::to_string(++made_));
  const std::uint32_t place =
      declare(name, shape, AstDeclaration::Kind::Memory, where);
  ast_->declarations[place].made = true;
  return name;
}

std::uint32_t StatementWriter::element(std::string_view kind,
                                       std::string_view instance,
                                       SourceRange where) {
  AstDeclaration declaration;
  declaration.kind = AstDeclaration::Kind::Element;
  declaration.name = kind;
  declaration.index = elements_;
  declaration.instance = instance;
  declaration.where = where;
  ast_->declarations.push_back(declaration);
  return elements_++;
}

void StatementWriter::emit(std::string_view target, SourceRange target_where,
                           const Expression& value, SourceRange where) {
  const auto begin = static_cast<std::uint32_t>(ast_->nodes.size());
  ast_->nodes.insert(ast_->nodes.end(), value.begin(), value.end());
  const auto end = static_cast<std::uint32_t>(ast_->nodes.size());
  ast_->rungs.push_back({.target = target,
                         .target_where = target_where,
                         .value = {begin, end},
                         .where = where});
}

std::string_view StatementWriter::keep(std::string_view prefix, CellShape shape,
                                       const Expression& value,
                                       SourceRange where) {
  const std::string_view name = make(prefix, shape, where);
  emit(name, where, value, where);
  return name;
}

void StatementWriter::assign(std::string_view target, bool word,
                             SourceRange target_where, const Expression& value,
                             SourceRange where) {
  if (guard_.empty()) return emit(target, target_where, value, where);
  emit(target, target_where,
       chosen(guard_, word, value, target, target_where, where), where);
}

Expression StatementWriter::call(std::string_view operation,
                                 const Expression& operands,
                                 std::uint32_t index,
                                 std::optional<std::int64_t> preset,
                                 SourceRange where) {
  Expression nodes = operands;
  std::uint32_t count = 0;
  for (std::size_t left = nodes.size(); left > 0; ++count) {
    left -= nodes[left - 1].size;
  }
  push_leaf(nodes, AstOp::Number, keep_text(std::to_string(index)), where);
  ++count;
  if (preset) {
    push_leaf(nodes, AstOp::Number, keep_text(std::to_string(*preset)), where);
    ++count;
  }
  const auto size = static_cast<std::uint32_t>(nodes.size() + 1);
  nodes.push_back({.op = AstOp::Call,
                   .arguments = count,
                   .size = size,
                   .where = where,
                   .text = operation});
  return nodes;
}

}  // namespace rung
