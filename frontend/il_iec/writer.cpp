#include "frontend/il_iec/writer.h"

#include <utility>

#include "frontend/il_iec/token.h"

namespace rung::il_iec {
void Writer::emit(std::string_view target, SourceRange target_where,
                  const Expression& value, SourceRange where) {
  const auto begin = static_cast<std::uint32_t>(ast_->nodes.size());
  ast_->nodes.insert(ast_->nodes.end(), value.begin(), value.end());
  const auto end = static_cast<std::uint32_t>(ast_->nodes.size());
  ast_->rungs.push_back({.target = target,
                         .target_where = target_where,
                         .value = {begin, end},
                         .where = where});
}

std::string_view Writer::keep(std::string_view prefix, Kind kind,
                              const Expression& value, SourceRange where) {
  const std::string_view name = names_->make(prefix, kind, where);
  emit(name, where, value, where);
  return name;
}

void Writer::assign(Cell& target, SourceRange target_where,
                    const Expression& value, SourceRange where) {
  target.written = true;
  if (guard_.empty()) return emit(target.name, target_where, value, where);
  if (target.kind == Kind::Time) {
    errors_->error("RP045", target_where,
                   "a TIME is assigned behind a condition: that is not "
                   "supported");
    return;
  }
  const bool word = target.kind == Kind::Int;
  const AstOp times = word ? AstOp::Multiply : AstOp::And;
  Expression nodes;
  nodes.reserve(value.size() + 10);
  push_leaf(nodes, AstOp::Name, guard_, where);
  if (word) push_conversion(nodes, "to_word", where);
  nodes.insert(nodes.end(), value.begin(), value.end());
  push_binary(nodes, times, where);
  push_leaf(nodes, AstOp::Name, guard_, where);
  push_unary(nodes, AstOp::Not, where);
  if (word) push_conversion(nodes, "to_word", where);
  push_leaf(nodes, AstOp::Name, target.name, target_where);
  push_binary(nodes, times, where);
  push_binary(nodes, word ? AstOp::Add : AstOp::Or, where);
  // One of the two is 0, so this changes nothing: it says that the sum fits.
  if (word) push_conversion(nodes, "wrap16", where);
  emit(target.name, target_where, nodes, where);
}

Expression Writer::call_of(const Instance& instance, std::string_view operation,
                           bool operands, bool preset, SourceRange where) {
  Expression nodes;
  if (operands) {
    for (const Pin& pin : instance.block->inputs) {
      if (pin.name == "PT") continue;
      push_leaf(nodes, AstOp::Name, names_->pin(instance, pin, where).name,
                where);
    }
  }
  push_leaf(nodes, AstOp::Number, names_->keep(std::to_string(instance.index)),
            where);
  if (preset) {
    push_leaf(nodes, AstOp::Number,
              names_->keep(std::to_string(instance.preset.value_or(0))), where);
  }
  const auto count = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back({.op = AstOp::Call,
                   .arguments = count,
                   .size = count + 1,
                   .where = where,
                   .text = operation});
  return nodes;
}

void Writer::output(const Instance& instance, const Pin& pin,
                    SourceRange where) {
  const Block& block = *instance.block;
  const bool timed = block.inputs.back().name == "PT";
  const bool first = pin.name == block.outputs.front().name;
  if (!first && !mentioned_.contains(std::string(pin.name))) return;
  if (pin.kind == Kind::Time && !guard_.empty()) {
    errors_->error("RP045", where,
                   quoted_excerpt(std::string(instance.name) + ".ET") +
                       " of a call that a condition may skip is not supported");
    return;
  }
  const std::string_view operation =
      first
          ? block.name
          : names_->keep(std::string(block.name) + "." + std::string(pin.name));
  Cell& cell = names_->pin(instance, pin, where);
  assign(cell, where,
         call_of(instance, operation, first,
                 timed && (first || pin.name == "ET"), where),
         where);
}

void Writer::call(Instance& instance, SourceRange where) {
  for (const Pin& pin : instance.block->outputs) output(instance, pin, where);
}

}  // namespace rung::il_iec
