#include "analysis/simulator_plant.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace rung {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// As the reader takes numbers: decimal with an exponent, or 0x and digits.
double number_of(std::string_view text) {
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const char* const begin = text.data() + (hex ? 2 : 0);
  const char* const end = text.data() + text.size();
  if (hex) {
    std::uint64_t whole = 0;
    const auto result = std::from_chars(begin, end, whole, 16);
    return result.ec == std::errc() ? static_cast<double>(whole) : kNaN;
  }
  double number = kNaN;
  std::from_chars(begin, end, number);
  return number;
}

bool truthy(double x) { return x != 0 && !std::isnan(x); }

// Javascript's numbers as the program's integers.
std::int64_t to_cell(double x, Type type) {
  if (type == Type::Bit) return truthy(x) ? 1 : 0;
  if (std::isnan(x)) return 0;
  constexpr double kLimit = 4611686018427387904.0;  // 2^62
  return static_cast<std::int64_t>(
      std::trunc(std::fmin(kLimit, std::fmax(-kLimit, x))));
}

double binary(AstOp op, double a, double b) {
  switch (op) {
    case AstOp::And:
      return truthy(a) ? b : a;
    case AstOp::Or:
      return truthy(a) ? a : b;
    case AstOp::Xor:
      return truthy(a) != truthy(b) ? 1 : 0;
    case AstOp::Equal:
      return a == b ? 1 : 0;
    case AstOp::NotEqual:
      return a != b ? 1 : 0;
    case AstOp::Less:
      return a < b ? 1 : 0;
    case AstOp::LessEqual:
      return a <= b ? 1 : 0;
    case AstOp::Greater:
      return a > b ? 1 : 0;
    case AstOp::GreaterEqual:
      return a >= b ? 1 : 0;
    case AstOp::Add:
      return a + b;
    case AstOp::Subtract:
      return a - b;
    case AstOp::Multiply:
      return a * b;
    case AstOp::Divide:
      return a / b;
    case AstOp::Name:
    case AstOp::Number:
    case AstOp::Bool:
    case AstOp::String:
    case AstOp::Not:
    case AstOp::Negate:
    case AstOp::Call:
      break;  // not binary: PlantMachine::apply has them
  }
  return kNaN;
}

}  // namespace

class PlantMachine::Compiler {
 public:
  Compiler(const Program& program, PlantMachine& machine)
      : program_(program), machine_(machine) {
    const Plant& plant = program.plant;
    if (plant.statements.empty() && plant.initials.empty()) return;
    for (const CellId cell : ids_of(program.cells)) {
      cells_.emplace(program.cells[cell].name, cell);
    }
    for (const AstNode& node : plant.nodes) {
      machine.operations_.push_back(operation_of(node));
    }
    compile(plant.initials, machine.initials_);
    compile(plant.statements, machine.statements_);
  }

 private:
  Operation operation_of(const AstNode& node) {
    Operation operation;
    operation.op = node.op;
    operation.arguments = node.arguments;
    if (node.op == AstOp::Name) operation.slot = slot_of(node.text);
    if (node.op == AstOp::Number) operation.number = number_of(node.text);
    if (node.op == AstOp::Bool) operation.number = node.text == "true" ? 1 : 0;
    return operation;
  }

  std::uint32_t slot_of(std::string_view name) {
    const auto next = static_cast<std::uint32_t>(machine_.slots_.size());
    const auto [found, added] = names_.emplace(name, next);
    if (!added) return found->second;
    Slot slot;
    if (const auto cell = cells_.find(name); cell != cells_.end()) {
      slot.cell = cell->second;
      slot.type = program_.cells[slot.cell].type;
    }
    machine_.slots_.push_back(slot);
    return next;
  }

  void compile(const std::vector<PlantStatement>& statements,
               std::vector<Step>& steps) {
    std::vector<std::uint32_t> open;  // steps that jump to what follows
    const auto here = [&steps] {
      return static_cast<std::uint32_t>(steps.size());
    };
    for (const PlantStatement& statement : statements) {
      switch (statement.kind) {
        case AstPlantStatement::Kind::Assign:
          steps.push_back({StepKind::Assign, slot_of(statement.target), 0,
                           statement.value});
          break;
        case AstPlantStatement::Kind::If:
          open.push_back(here());
          steps.push_back({StepKind::JumpIfFalse, 0, 0, statement.value});
          break;
        case AstPlantStatement::Kind::Else:
          steps.push_back({StepKind::Jump, 0, 0, {}});
          steps[open.back()].target = here();
          open.back() = here() - 1;
          break;
        case AstPlantStatement::Kind::End:
          steps[open.back()].target = here();
          open.pop_back();
          break;
        case AstPlantStatement::Kind::IgnoredCall:
          break;  // draws
      }
    }
  }

  const Program& program_;
  PlantMachine& machine_;
  std::unordered_map<std::string_view, CellId> cells_;
  std::unordered_map<std::string_view, std::uint32_t> names_;
};

PlantMachine::PlantMachine(const Program& program) { Compiler(program, *this); }

void PlantMachine::reset(std::vector<std::int64_t>& cells) {
  for (Slot& slot : slots_) slot.value = 0;
  if (!initials_.empty()) execute(initials_, cells);
}

void PlantMachine::run(std::vector<std::int64_t>& cells) {
  execute(statements_, cells);
}

// A cell keeps the plant's own number as long as nobody else changed it.
void PlantMachine::load(const std::vector<std::int64_t>& cells) {
  for (Slot& slot : slots_) {
    if (!slot.cell.has_value()) continue;
    const std::int64_t value = cells[slot.cell.index()];
    if (to_cell(slot.value, slot.type) != value) {
      slot.value = static_cast<double>(value);
    }
  }
}

void PlantMachine::execute(const std::vector<Step>& steps,
                           std::vector<std::int64_t>& cells) {
  load(cells);
  std::uint32_t at = 0;
  while (at < steps.size()) {
    const Step& step = steps[at++];
    if (step.kind == StepKind::Jump) {
      at = step.target;
      continue;
    }
    const double value = evaluate(step.value);
    if (step.kind == StepKind::JumpIfFalse) {
      if (!truthy(value)) at = step.target;
      continue;
    }
    Slot& slot = slots_[step.slot];
    slot.value = value;
    if (slot.cell.has_value()) {
      cells[slot.cell.index()] = to_cell(value, slot.type);
    }
  }
}

double PlantMachine::evaluate(const AstExpression& expression) {
  stack_.clear();
  for (std::uint32_t i = expression.begin; i < expression.end; ++i) {
    apply(operations_[i]);
  }
  return stack_.empty() ? 0 : stack_.back();
}

// `&&` and `||` need no branch: nothing in a plant's expression has an effect.
void PlantMachine::apply(const Operation& operation) {
  if (operation.op == AstOp::Name) {
    stack_.push_back(slots_[operation.slot].value);
  } else if (operation.op == AstOp::Number || operation.op == AstOp::Bool) {
    stack_.push_back(operation.number);
  } else if (operation.op == AstOp::Not) {
    stack_.back() = truthy(stack_.back()) ? 0 : 1;
  } else if (operation.op == AstOp::Negate) {
    stack_.back() = -stack_.back();
  } else if (operation.op == AstOp::String || operation.op == AstOp::Call) {
    // The reader refuses both here; were one let through, it is no number.
    stack_.resize(stack_.size() - operation.arguments);
    stack_.push_back(kNaN);
  } else {
    const double b = stack_.back();
    stack_.pop_back();
    stack_.back() = binary(operation.op, stack_.back(), b);
  }
}

}  // namespace rung
