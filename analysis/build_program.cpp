#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "analysis/build_declared.h"
#include "analysis/build_program_expression.h"
#include "analysis/build_program_names.h"
#include "analysis/program.h"
#include "frontend/error_limit.h"

namespace rung {
namespace {

using build::ExpressionBuilder;
using build::NameClass;
using build::Symbol;
using build::SymbolTable;

struct Range {
  std::int64_t low = 0;
  std::int64_t high = 1;
};
constexpr Range kAnalogPin = {0, 1023};
template <class Integer>
constexpr Range kRangeOf = {std::numeric_limits<Integer>::min(),
                            std::numeric_limits<Integer>::max()};

Range range_of(const Symbol& symbol, std::string_view dialect) {
  if (!symbol.is_word) return {};
  const bool input = symbol.name_class == NameClass::WordInput;
  if (dialect == "yun") return input ? kAnalogPin : kRangeOf<std::int16_t>;
  return input ? kRangeOf<std::int16_t> : kRangeOf<std::int32_t>;
}

CellRole role_of(const Symbol& symbol) {
  const bool by_plant = symbol.plant_written != nullptr;
  switch (symbol.name_class) {
    case NameClass::BitInput:
    case NameClass::WordInput:
      return CellRole::Input;
    case NameClass::BitPin:
      return symbol.written != nullptr ? CellRole::Output : CellRole::Input;
    case NameClass::BitOutput:
    case NameClass::WordOutput:
      return by_plant ? CellRole::Input : CellRole::Output;
    case NameClass::Memory:
    case NameClass::Unknown:
      return by_plant ? CellRole::Input : CellRole::Memory;
  }
  return CellRole::Memory;
}

/// Is the value a truth value and no number, whatever its operands are?
bool gives_truth(AstOp op) {
  switch (op) {
    case AstOp::Bool:
    case AstOp::Not:
    case AstOp::Equal:
    case AstOp::NotEqual:
    case AstOp::Less:
    case AstOp::LessEqual:
    case AstOp::Greater:
    case AstOp::GreaterEqual:
    case AstOp::Call:
      return true;
    case AstOp::Name:
    case AstOp::Number:
    case AstOp::String:
    case AstOp::Negate:
    case AstOp::And:
    case AstOp::Or:
    case AstOp::Xor:
    case AstOp::Add:
    case AstOp::Subtract:
    case AstOp::Multiply:
    case AstOp::Divide:
      return false;
  }
  return false;
}

class ProgramBuilder {
 public:
  ProgramBuilder(const Ast& ast, const BuildOptions& options,
                 ErrorLimit& errors)
      : ast_(&ast),
        errors_(&errors),
        names_(ast, errors),
        expressions_(ast, names_, program_, errors) {
    program_.file = ast.file;
    program_.language = ast.language;
    program_.dialect = ast.dialect;
    program_.evaluation =
        ast.dialect == "sim" ? Evaluation::ShortCircuit : Evaluation::Strict;
    program_.scan = options.scan;
    program_.annotations = ast.annotations;
    program_.comments = ast.comments;
  }
  Program run();

 private:
  void add_cells();
  void add_cell(Symbol& symbol);
  void check_writers(const Symbol& symbol);
  void set_initial(const Symbol& symbol);
  void note_plant_types();
  void add_rungs();
  void add_plant();
  AstExpression copy_nodes(const AstExpression& expression);

  const Ast* ast_;
  ErrorLimit* errors_;
  Program program_;
  SymbolTable names_;
  ExpressionBuilder expressions_;
};

Program ProgramBuilder::run() {
  add_cells();
  note_plant_types();
  add_rungs();
  add_plant();
  expressions_.finish();
  return std::move(program_);
}

void ProgramBuilder::add_cells() {
  for (Symbol& symbol : names_.symbols()) {
    if (symbol.in_rungs) add_cell(symbol);
  }
  for (const Symbol& symbol : names_.symbols()) {
    if (symbol.in_rungs && symbol.initial != nullptr) set_initial(symbol);
  }
}

void ProgramBuilder::add_cell(Symbol& symbol) {
  check_writers(symbol);
  const Range range = range_of(symbol, ast_->dialect);
  symbol.cell =
      program_.cells.add({.name = std::string(symbol.name),
                          .type = symbol.is_word ? Type::Word : Type::Bit,
                          .role = role_of(symbol),
                          .low = range.low,
                          .high = range.high,
                          .where = symbol.where,
                          .plant_written = symbol.plant_written != nullptr});
}

void ProgramBuilder::check_writers(const Symbol& symbol) {
  if (symbol.written == nullptr) return;
  const std::string name = "`" + std::string(symbol.name) + "`";
  if (symbol.name_class == NameClass::BitInput ||
      symbol.name_class == NameClass::WordInput) {
    errors_->error("RP021", symbol.written->target_where,
                   name + " is an input: a rung cannot assign it");
  } else if (symbol.plant_written != nullptr) {
    errors_->error(
        "RP023", symbol.written->target_where,
        name +
            " is assigned by a rung and by the plant: give one of them "
            "another name",
        {{symbol.plant_written->target_where, "the plant assigns it here"}});
  }
}

void ProgramBuilder::set_initial(const Symbol& symbol) {
  const auto value = expressions_.constant(symbol.initial->value);
  Cell& cell = program_.cells[symbol.cell];
  if (value && value->is_whole() && value->numerator >= cell.low &&
      value->numerator <= cell.high) {
    cell.initial = value->numerator;
    cell.initialised = true;
    const AstNode& root = ast_->nodes[symbol.initial->value.root()];
    if ((root.op == AstOp::Bool) != (cell.type == Type::Bit)) {
      expressions_.note_mixed(symbol.initial->where);
    }
    return;
  }
  const std::string range = cell.type == Type::Bit
                                ? "`true` or `false`"
                                : "a whole number from " +
                                      std::to_string(cell.low) + " to " +
                                      std::to_string(cell.high);
  errors_->error("RP037", symbol.initial->where,
                 "the initial value of `" + cell.name + "` must be " + range);
}

/// Where the plant gives a bit a number, or a word something else, `===`
/// cannot be decided by the types.
void ProgramBuilder::note_plant_types() {
  for (const AstPlantStatement& statement : ast_->plant) {
    if (statement.kind != AstPlantStatement::Kind::Assign) continue;
    const Symbol& symbol = names_.named(statement.target);
    if (!symbol.in_rungs) continue;
    const AstOp op = ast_->nodes[statement.value.root()].op;
    const bool choice = op == AstOp::And || op == AstOp::Or;
    if (choice || gives_truth(op) == symbol.is_word) {
      expressions_.note_mixed(statement.where);
    }
  }
}

void ProgramBuilder::add_rungs() {
  program_.rungs.reserve(ast_->rungs.size());
  program_.nodes.reserve(ast_->nodes.size());
  for (const AstAssignment& rung : ast_->rungs) {
    const CellId target = names_.named(rung.target).cell;
    const auto begin = static_cast<std::uint32_t>(program_.nodes.size());
    if (!expressions_.build(rung.value, program_.cells[target].type)) continue;
    program_.rungs.add(
        {.target = target,
         .begin = begin,
         .end = static_cast<std::uint32_t>(program_.nodes.size()),
         .target_where = rung.target_where,
         .where = rung.where});
  }
}

AstExpression ProgramBuilder::copy_nodes(const AstExpression& expression) {
  auto& nodes = program_.plant.nodes;
  const auto begin = static_cast<std::uint32_t>(nodes.size());
  nodes.insert(nodes.end(), ast_->nodes.begin() + expression.begin,
               ast_->nodes.begin() + expression.end);
  return {begin, static_cast<std::uint32_t>(nodes.size())};
}

void ProgramBuilder::add_plant() {
  for (const AstAssignment& initial : ast_->initials) {
    if (names_.named(initial.target).in_rungs) continue;
    program_.plant.initials.push_back({AstPlantStatement::Kind::Assign,
                                       std::string(initial.target),
                                       copy_nodes(initial.value)});
  }
  for (const AstPlantStatement& statement : ast_->plant) {
    program_.plant.statements.push_back({statement.kind,
                                         std::string(statement.target),
                                         copy_nodes(statement.value)});
  }
}

}  // namespace

Program build_program(const Ast& ast, const BuildOptions& options,
                      DiagnosticSink& sink) {
  if (ast.language != "script") return build_declared(ast, sink);
  ErrorLimit errors(sink);
  Program program = ProgramBuilder(ast, options, errors).run();
  errors.finish();
  return program;
}

CellId find_cell(const Program& program, std::string_view name) {
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].name == name) return id;
  }
  return {};
}

}  // namespace rung
