#pragma once

#include <cstdint>
#include <vector>

#include "analysis/program.h"

namespace rung {

/// Runs the `//Sim` section: Javascript's doubles, with true as 1 and false as
/// 0. Names of cells are the program's; all others are variables of the plant,
/// 0 until they are assigned.
///
/// An input gets the whole part of the number that the plant assigns (a bit:
/// whether it is neither 0 nor NaN), while the plant itself goes on with the
/// number. It is not clipped to the input's declared range.
class PlantMachine {
 public:
  explicit PlantMachine(const Program& program);

  bool empty() const { return statements_.empty(); }

  /// Variables 0, then the `//Var` values.
  void reset(std::vector<std::int64_t>& cells);

  /// One pass over the statements; reads and writes `cells` by CellId index.
  void run(std::vector<std::int64_t>& cells);

 private:
  enum class StepKind : std::uint8_t { Assign, JumpIfFalse, Jump };
  struct Step {
    StepKind kind = StepKind::Assign;
    std::uint32_t slot = 0;    // Assign
    std::uint32_t target = 0;  // jumps
    AstExpression value;       // a run of operations_
  };
  struct Operation {
    AstOp op = AstOp::Number;
    std::uint32_t slot = 0;  // Name
    std::uint32_t arguments = 0;
    double number = 0;  // Number, Bool
  };
  struct Slot {
    CellId cell;  // no value: a variable of the plant
    Type type = Type::Word;
    double value = 0;
  };
  class Compiler;

  void execute(const std::vector<Step>& steps,
               std::vector<std::int64_t>& cells);
  void load(const std::vector<std::int64_t>& cells);
  double evaluate(const AstExpression& expression);
  void apply(const Operation& operation);

  std::vector<Operation> operations_;
  std::vector<Step> initials_;
  std::vector<Step> statements_;
  std::vector<Slot> slots_;
  std::vector<double> stack_;
};

}  // namespace rung
