#include "dump.h"

#include <array>

#include "frontend/script/reader.h"

namespace rung::test {
namespace {

std::string_view spelling(NodeOp op) {
  switch (op) {
    case NodeOp::Constant:
    case NodeOp::Read:
    case NodeOp::Call:
    case NodeOp::Branch:
      return "";
    case NodeOp::Not:
      return "!";
    case NodeOp::And:
      return "&&";
    case NodeOp::Or:
      return "||";
    case NodeOp::Xor:
      return "^";
    case NodeOp::Equal:
      return "==";
    case NodeOp::NotEqual:
      return "!=";
    case NodeOp::Less:
      return "<";
    case NodeOp::LessEqual:
      return "<=";
    case NodeOp::Greater:
      return ">";
    case NodeOp::GreaterEqual:
      return ">=";
    case NodeOp::Add:
      return "+";
    case NodeOp::Subtract:
      return "-";
    case NodeOp::Multiply:
      return "*";
    case NodeOp::Divide:
      return "/";
    case NodeOp::Negate:
      return "neg";
    case NodeOp::Wrap16:
    case NodeOp::Wrap:
      return "wrap";
    case NodeOp::ToWord:
      return "word";
    case NodeOp::ToBit:
      return "bit";
  }
  return "";
}

std::string dump_node(const Program& program, std::uint32_t index) {
  const Node& node = program.nodes[index];
  switch (node.op) {
    case NodeOp::Constant:
      if (node.type == Type::Bit) return node.value != 0 ? "true" : "false";
      return std::to_string(node.value);
    case NodeOp::Read:
      return program.cells[node.cell].name;
    case NodeOp::Call: {
      const ElementCall& call = program.calls[node.call];
      std::string text(call.operation->name);
      text += ":" + program.instances[call.instance].name;
      return text + "/" + std::to_string(call.parameter);
    }
    case NodeOp::Branch:
      return (node.skip_when ? "?true+" : "?false+") +
             std::to_string(node.target - index);
    default:
      return std::string(spelling(node.op));
  }
}

}  // namespace

void read(std::string_view text, std::string_view dialect, Read& out) {
  const FileId file = out.sources.add("test.txt", std::string(text));
  DiagnosticList list;
  out.ast = read_script(out.sources, file, dialect, list);
  out.diagnostics = list.take();
}

void build(std::string_view text, std::string_view dialect, Built& out) {
  read(text, dialect, out.read);
  DiagnosticList list;
  out.program = build_program(out.read.ast, {}, list);
  out.diagnostics = out.read.diagnostics;
  for (Diagnostic& item : list.take()) out.diagnostics.push_back(item);
}

std::string codes(const SourceSet& sources,
                  const std::vector<Diagnostic>& diagnostics, bool with_text) {
  std::string text;
  for (const Diagnostic& item : diagnostics) {
    if (!text.empty()) text += ' ';
    text += item.code;
    if (with_text) text += "[" + std::string(sources.text(item.where)) + "]";
  }
  return text;
}

std::string dump(const Ast& ast, const AstExpression& expression) {
  std::vector<std::string> stack;
  for (std::uint32_t i = expression.begin; i < expression.end; ++i) {
    const AstNode& node = ast.nodes[i];
    if (node.arguments == 0 && node.op != AstOp::Call) {
      stack.emplace_back(node.text);
      continue;
    }
    std::string text = "(" + std::string(node.text);
    for (std::size_t k = stack.size() - node.arguments; k < stack.size(); ++k) {
      text += " " + stack[k];
    }
    stack.resize(stack.size() - node.arguments);
    stack.push_back(text + ")");
  }
  return stack.size() == 1 ? stack[0] : "(not one expression)";
}

std::string dump(const Program& program, RungId rung) {
  std::string text;
  const Rung& it = program.rungs[rung];
  for (std::uint32_t i = it.begin; i < it.end; ++i) {
    if (i != it.begin) text += ' ';
    text += dump_node(program, i);
  }
  return text;
}

std::string dump_rungs(const Program& program) {
  std::string text;
  for (const RungId id : ids_of(program.rungs)) {
    if (!text.empty()) text += " | ";
    text += program.cells[program.rungs[id].target].name + " = ";
    text += dump(program, id);
  }
  return text;
}

std::string dump_cells(const Program& program) {
  constexpr std::array<std::string_view, 3> kRoles = {"in", "out", "memory"};
  std::string text;
  for (const Cell& cell : program.cells) {
    if (!text.empty()) text += ' ';
    text += cell.name + ":";
    text += kRoles[static_cast<std::size_t>(cell.role)];
    if (cell.type == Type::Word) {
      text += "[" + std::to_string(cell.low) + ".." +
              std::to_string(cell.high) + "]";
    }
    if (cell.initial != 0) text += "=" + std::to_string(cell.initial);
    if (cell.plant_written) text += "*";
  }
  return text;
}

}  // namespace rung::test
