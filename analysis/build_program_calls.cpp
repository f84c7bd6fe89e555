#include "analysis/build_program_calls.h"

#include <algorithm>
#include <string>

#include "analysis/build_program_names.h"
#include "base/text.h"

namespace rung::build {
namespace {

constexpr std::int64_t kMaxMilliseconds = std::int64_t{1} << 40;
constexpr std::int64_t kMaxInt16 = 32'767;
constexpr std::int64_t kMaxInt32 = 2'147'483'647;

std::string backticked(std::string_view text) {
  return "`" + std::string(text) + "`";
}

std::string_view other_dialect(std::string_view dialect) {
  return dialect == "yun" ? "sim" : "yun";
}

bool is_function(std::string_view dialect, std::string_view name) {
  const auto names = function_names(dialect);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void report_unknown_function(const Ast& ast, const AstNode& node,
                             ErrorLimit& errors) {
  if (errors.is_full()) {
    errors.error("RP024", node.where, {});
    return;
  }
  const SourceRange where = {
      node.where.file, node.where.begin,
      node.where.begin + static_cast<std::uint32_t>(node.text.size())};
  const std::string_view other = other_dialect(ast.dialect);
  const std::string name = backticked(node.text);
  const std::string dialect(ast.dialect);
  if (is_function(other, node.text)) {
    errors.error("RP024", where,
                 name + " is a function of the " + std::string(other) +
                     " dialect: this script is of the " + dialect + " dialect");
    return;
  }
  std::string known;
  for (const std::string_view function : function_names(ast.dialect)) {
    known += (known.empty() ? "" : " ") + std::string(function);
  }
  errors.error("RP024", where,
               name + " is no function of the " + dialect + " dialect" +
                   did_you_mean(node.text, function_names(ast.dialect)) +
                   ": functions are " + known);
}

/// How a call of an element is written: `T(n, d, v)`.
std::string usage(const ElementOperation& operation) {
  std::string text(operation.name);
  char separator = '(';
  for (const ElementParameter& parameter : operation.parameters) {
    text += separator;
    if (separator == ',') text += ' ';
    text += parameter.name;
    separator = ',';
  }
  return text + ")";
}

}  // namespace

ResolvedCall resolve_call(const Ast& ast, std::uint32_t node,
                          ErrorLimit& errors) {
  using enum ResolvedCall::Kind;
  const AstNode& call = ast.nodes[node];
  ResolvedCall resolved;
  resolved.arguments.resize(call.arguments);
  for (std::uint32_t i = call.arguments, at = node - 1; i > 0; --i) {
    resolved.arguments[i - 1] = at;
    at -= ast.nodes[at].size;
  }
  const bool yun = ast.dialect == "yun";
  std::size_t expected = 3;
  std::string form = call.text == "ORN" ? "ORN(a, b, c)" : "Cmp(a, \"<\", b)";
  if (yun && call.text == "ORN") {
    resolved.kind = Orn;
  } else if (yun && call.text == "Cmp") {
    resolved.kind = Cmp;
  } else {
    resolved.found = script_operation(ast.dialect, call.text);
    if (resolved.found.kind == nullptr) {
      report_unknown_function(ast, call, errors);
      return resolved;
    }
    resolved.kind = Element;
    expected = resolved.found.operation->parameters.size();
    form = usage(*resolved.found.operation);
  }
  if (call.arguments != expected) {
    errors.error("RP025", call.where,
                 backticked(call.text) + " takes " + std::to_string(expected) +
                     " arguments and is given " +
                     std::to_string(call.arguments) + ": " + backticked(form));
    resolved.kind = Wrong;
  }
  return resolved;
}

std::int64_t check_index(const Ast& ast, const AstNode& node,
                         ErrorLimit& errors) {
  const std::int64_t largest = ast.dialect == "yun" ? kMaxInt16 : kMaxInt32;
  if (node.op == AstOp::Number) {
    const auto value = parse_number(node.text);
    if (value && value->is_whole() && value->numerator <= largest) {
      return value->numerator;
    }
  }
  errors.error("RP026", node.where,
               "the index of an element must be a whole number from 0 to " +
                   std::to_string(largest));
  return 0;
}

std::int64_t check_seconds(const AstNode& node, ConstantArgument value,
                           SecondsRounding rounding, ErrorLimit& errors) {
  const auto scaled = value ? multiply(*value, {1000, 1}) : std::nullopt;
  if (!scaled || scaled->numerator < 0 ||
      floor_of(*scaled) >= kMaxMilliseconds) {
    errors.error("RP027", node.where,
                 "a time must be a constant number of seconds, from 0 to " +
                     std::to_string(kMaxMilliseconds / 1000));
    return 0;
  }
  return rounding == SecondsRounding::Floor ? floor_of(*scaled)
                                            : ceiling_of(*scaled);
}

std::int64_t check_count(const Ast& ast, const AstNode& node,
                         ConstantArgument value, ErrorLimit& errors) {
  // The sim counter's own bound, 50 * count + 1, has to be an integer of 32
  // bits too.
  const std::int64_t largest =
      ast.dialect == "yun" ? kMaxInt16 : (kMaxInt32 - 1) / 50;
  if (value && value->is_whole() && value->numerator >= 0 &&
      value->numerator <= largest) {
    return value->numerator;
  }
  errors.error("RP028", node.where,
               "a count must be a constant whole number from 0 to " +
                   std::to_string(largest));
  return 0;
}

}  // namespace rung::build
