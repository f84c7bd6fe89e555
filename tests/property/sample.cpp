#include "sample.h"

#include <algorithm>
#include <utility>

namespace rung {

CellId SampleProgram::cell(std::string name, CellRole role, Type type) {
  Cell cell = {.name = std::move(name), .type = type, .role = role};
  if (type == Type::Word) {
    cell.low = -32768;
    cell.high = 32767;
  }
  return program.cells.add(std::move(cell));
}

CellId SampleProgram::find(std::string_view name) const {
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].name == name) return id;
  }
  return {};
}

std::uint32_t SampleProgram::node(Node value) {
  program.nodes.push_back(value);
  return static_cast<std::uint32_t>(program.nodes.size() - 1);
}

std::uint32_t SampleProgram::read(std::string_view name) {
  const CellId id = find(name);
  return node({.op = NodeOp::Read, .type = program.cells[id].type, .cell = id});
}

void SampleProgram::rung(std::string_view target, std::uint32_t begin) {
  program.rungs.add({.target = find(target),
                     .begin = begin,
                     .end = static_cast<std::uint32_t>(program.nodes.size())});
}

std::uint32_t SampleProgram::call(std::string_view name, std::int64_t parameter,
                                  std::vector<std::uint32_t> arguments) {
  const FoundOperation found = find_operation("sim", name);
  const InstanceId instance =
      program.instances.add({.kind = found.kind,
                             .name = std::string(name) + "(0)",
                             .clock_cap = parameter + 1,
                             .largest_parameter = parameter});
  const CallId id = program.calls.add({.instance = instance,
                                       .operation = found.operation,
                                       .parameter = parameter,
                                       .arguments = std::move(arguments)});
  return node({.op = NodeOp::Call, .call = id});
}

SampleProgram::SampleProgram() {
  program.dialect = "sim";
  for (const char* const name : {"I0", "I1", "I2"}) {
    cell(name, CellRole::Input);
  }
  cell("IW0", CellRole::Input, Type::Word);
  for (const char* const name : {"Q0", "Q1", "Q2", "Q3", "Q4"}) {
    cell(name, CellRole::Output);
  }
  cell("QW0", CellRole::Output, Type::Word);
  cell("M0", CellRole::Memory);
  cell("M1", CellRole::Memory);

  const std::uint32_t either =
      node({.op = NodeOp::Or, .a = read("I0"), .b = read("Q0")});
  const std::uint32_t no_stop = node({.op = NodeOp::Not, .a = read("I1")});
  node({.op = NodeOp::And, .a = either, .b = no_stop});
  rung("Q0", 0);
  rung("Q1", read("I1"));
  rung("Q2", read("I2"));
  std::uint32_t begin = read("I0");
  call("T", 500, {begin});
  rung("Q3", begin);
  begin = read("I1");
  const std::uint32_t down = node({.op = NodeOp::Constant});
  call("C", 3, {begin, down, read("I2")});
  rung("M0", begin);
  rung("QW0", read("IW0"));
  rung("Q4", read("M1"));
}

ReadLines::ReadLines(const std::string& lines, std::string_view initial) {
  if (!initial.empty()) {
    sample.program.cells[sample.find(initial)].initial = 1;
  }
  const FileId file = sources.add("lines.rung", lines);
  const std::string_view text = sources[file].text();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end > begin) {
      sample.program.annotations.push_back(
          {text.substr(begin, end - begin),
           {file, static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(end)}});
    }
    begin = end + 1;
  }
  set = read_properties(sample.program, {}, sources, found);
}

std::string ReadLines::error() const {
  if (found.items().size() != 1) {
    return std::to_string(found.items().size()) + " errors";
  }
  const Diagnostic& only = found.items().front();
  return std::string(only.code) + " [" + std::string(sources.text(only.where)) +
         "] " + only.message;
}

Interpreter::Interpreter(const TransitionSystem& ts)
    : ts_(ts), vars_(ts.vars.size(), 0), values_(ts.exprs.size(), 0) {
  for (const State& state : ts.states) vars_[state.var.index()] = state.init;
}

void Interpreter::scan(std::int64_t dt,
                       const std::vector<std::int64_t>& inputs) {
  if (started_) {
    for (const State& state : ts_.states) {
      vars_[state.var.index()] = value(state.next);
    }
  }
  started_ = true;
  std::size_t next = 0;
  for (const VarId var : ids_of(ts_.vars)) {
    if (ts_.vars[var].role == VarRole::Input)
      vars_[var.index()] = inputs[next++];
  }
  vars_[ts_.dt.index()] = dt;
  for (std::uint32_t i = 0; i < values_.size(); ++i) {
    values_[i] = compute(ts_.exprs[ExprId(i)]);
  }
}

std::int64_t Interpreter::compute(const Expr& expr) const {
  const auto of = [&](ExprId id) { return id.has_value() ? value(id) : 0; };
  const std::int64_t a = of(expr.a);
  const std::int64_t b = of(expr.b);
  switch (expr.op) {
    case ExprOp::Constant:
      return expr.value;
    case ExprOp::Variable:
      return vars_[expr.var.index()];
    case ExprOp::Not:
      return a == 0 ? 1 : 0;
    case ExprOp::And:
      return a & b;
    case ExprOp::Xor:
      return a ^ b;
    case ExprOp::Equal:
      return a == b ? 1 : 0;
    case ExprOp::Less:
      return a < b ? 1 : 0;
    case ExprOp::Add:
      return a + b;
    case ExprOp::Multiply:
      return a * b;
    case ExprOp::Divide:
      return a / b;
    case ExprOp::Wrap16:
      return static_cast<std::int16_t>(a);
    case ExprOp::Ite:
      return a != 0 ? b : of(expr.c);
  }
  return 0;
}

}  // namespace rung
