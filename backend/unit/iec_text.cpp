#include "backend/unit/iec_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rung::backend {
namespace {

std::string declaration(const Variable& variable) {
  std::string text = "  " + variable.name;
  text += variable.type == Type::Bit ? " : BOOL" : " : INT";
  if (variable.initial != 0) {
    text += " := ";
    text +=
        variable.type == Type::Bit ? "TRUE" : std::to_string(variable.initial);
  }
  text += ';';
  const bool renamed =
      !variable.source.empty() && variable.source != variable.name;
  if (renamed) text += " " + iec_comment(variable.source);
  return text + '\n';
}

bool same(const Terms& a, const Terms& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Term& x, const Term& y) {
                      return x.op == y.op && x.value == y.value &&
                             x.cell == y.cell && x.size == y.size;
                    });
}

/// Does the statement change what `terms` read?
bool changes(const Unit& unit, const Statement& statement, const Terms& terms) {
  return std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
    if (term.op != NodeOp::Read) return false;
    if (statement.target.has_value()) return term.cell == statement.target;
    return unit.variables[term.cell].block == statement.block;
  });
}

}  // namespace

std::string iec_comment(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    const bool mark = !plain.empty() && ((plain.back() == '*' && c == ')') ||
                                         (plain.back() == '(' && c == '*'));
    if (mark) plain += ' ';
    plain += c;
  }
  return "(* " + plain + " *)";
}

std::string iec_time(std::int64_t milliseconds) {
  const std::int64_t seconds = milliseconds / 1000;
  const std::int64_t rest = milliseconds % 1000;
  std::string text = "T#";
  if (seconds != 0) text += std::to_string(seconds) + "s";
  if (rest != 0 || seconds == 0) text += std::to_string(rest) + "ms";
  return text;
}

std::string_view iec_function(NodeOp op) {
  switch (op) {
    case NodeOp::And:
      return "AND";
    case NodeOp::Or:
      return "OR";
    case NodeOp::Xor:
      return "XOR";
    case NodeOp::Equal:
      return "EQ";
    case NodeOp::NotEqual:
      return "NE";
    case NodeOp::Less:
      return "LT";
    case NodeOp::LessEqual:
      return "LE";
    case NodeOp::Greater:
      return "GT";
    case NodeOp::GreaterEqual:
      return "GE";
    case NodeOp::Add:
      return "ADD";
    case NodeOp::Subtract:
    case NodeOp::Negate:
      return "SUB";
    case NodeOp::Multiply:
      return "MUL";
    default:
      return "DIV";
  }
}

std::string iec_head(const Unit& unit, const PropertyLines& properties) {
  std::string text;
  for (const std::string& line : properties.comments) {
    text += iec_comment("of the source: " + line) + '\n';
  }
  text += "PROGRAM " + unit.name + '\n';
  for (const std::string& line : properties.lines) {
    // Where the line holds the end of a comment, the other kind has none.
    const bool block = line.find("*)") == std::string::npos;
    text += block ? "(*@ " + line + " *)\n" : "//@ " + line + '\n';
  }
  constexpr std::array<std::pair<CellRole, std::string_view>, 3> kSections = {
      {{CellRole::Input, "VAR_INPUT\n"},
       {CellRole::Output, "VAR_OUTPUT\n"},
       {CellRole::Memory, "VAR\n"}}};
  for (const auto& [role, word] : kSections) {
    std::string lines;
    for (const Variable& variable : unit.variables) {
      if (variable.role != role || variable.block.has_value()) continue;
      lines += declaration(variable);
    }
    for (const Block& block : unit.blocks) {
      if (role != CellRole::Memory) break;
      lines += "  " + block.name + " : " + std::string(block.type) + ";";
      if (block.source != block.name) lines += " " + iec_comment(block.source);
      lines += '\n';
    }
    if (!lines.empty()) text += std::string(word) + lines + "END_VAR\n";
  }
  return text;
}

void merge_pins(Unit& unit) {
  std::vector<Statement> kept;
  std::size_t first = 0;  // in `kept`: the assignments to pins of one block
  for (Statement& statement : unit.statements) {
    const bool call = !statement.target.has_value();
    const BlockId block =
        call ? statement.block : unit.variables[statement.target].block;
    const bool goes_on =
        block.has_value() && first < kept.size() &&
        unit.variables[kept[first].target].block == block &&
        same(kept[first].guard, statement.guard) &&
        std::none_of(kept.begin() + static_cast<std::ptrdiff_t>(first),
                     kept.end(), [&](const Statement& pin) {
                       return changes(unit, pin, statement.value) ||
                              changes(unit, pin, statement.guard);
                     });
    if (call && goes_on) {
      std::vector<Argument> arguments;
      for (std::size_t i = first; i < kept.size(); ++i) {
        arguments.push_back({kept[i].target, std::move(kept[i].value)});
      }
      for (Argument& argument : statement.arguments) {
        arguments.push_back(std::move(argument));
      }
      statement.arguments = std::move(arguments);
      kept.resize(first);
    }
    const bool to_pin = !call && block.has_value();
    if (!to_pin) {
      kept.push_back(std::move(statement));
      first = kept.size();
      continue;
    }
    if (!goes_on) first = kept.size();
    kept.push_back(std::move(statement));
  }
  unit.statements = std::move(kept);
}

std::size_t guarded_run(const Unit& unit, std::size_t at) {
  const Terms& guard = unit.statements[at].guard;
  std::size_t end = at + 1;
  while (end < unit.statements.size() &&
         same(unit.statements[end].guard, guard) &&
         unit.statements[end].rung == unit.statements[at].rung &&
         !changes(unit, unit.statements[end - 1], guard)) {
    ++end;
  }
  return end - at;
}

Written finish_written(const Unit& unit, std::string text) {
  Written written;
  written.text = std::move(text);
  for (const Variable& variable : unit.variables) {
    if (variable.source.empty()) continue;
    written.signals.emplace_back(variable.source, variable.name);
  }
  for (const Block& block : unit.blocks) {
    if (block.source.empty()) continue;
    written.elements.emplace_back(block.source, block.name);
  }
  written.relations = unit.relations;
  return written;
}

}  // namespace rung::backend
