#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/expr.h"
#include "analysis/formula.h"
#include "analysis/program.h"

namespace rung {

enum class VarRole : std::uint8_t {
  State,
  Input,   // an input cell's sample of this scan
  Dt,      // ms since the scan before, in the scan interval
  Choice,  // a free bit of the encoding (`any` of an element)
  Freeze,  // a bit: from the next scan on time stands still, inputs are held
};

/// Bits have low 0 and high 1. A word variable never leaves [low, high]: of
/// inputs that is an assumption, of states a consequence of init and next.
struct Variable {
  std::string name;  // as properties and certificates print it
  VarRole role = VarRole::State;
  Type type = Type::Bit;
  std::int64_t low = 0;
  std::int64_t high = 1;
  CellId cell;              // of an input, and of a state that holds a cell
  std::uint32_t state = 0;  // of a state: its index in `states`
  ExprId expr;              // the term that is this variable
};

/// A state variable: its value at the end of a scan.
struct State {
  VarId var;
  std::int64_t init = 0;  // before the first scan
  ExprId next;            // over state variables and inputs of the scan
  /// Clocks grow by dt when a scan begins, while `running` (a term over the
  /// state before the scan), and saturate at `cap`. `next` includes that.
  bool clock = false;
  ExprId running;
  std::int64_t cap = 0;
};

/// A value that left the range the encoding gives it (a word cell of the sim
/// dialect past 32 bits): from such a scan on the encoding is not the program.
/// An engine must not call a property proved while a fault in its cone is not
/// proved unreachable.
struct Fault {
  ExprId condition;  // over state and inputs; true in the scan of the fault
  CellId cell;
  SourceRange where;
};

/// Init and step of a program, one scan a step. A property of a scan's end is
/// a term over the state before the scan and the inputs of the scan.
struct TransitionSystem {
  ExprArena exprs;
  Arena<VarId, Variable> vars;
  std::vector<State> states;
  VarId dt;
  ScanInterval scan;
  /// By CellId: the cell's value at the scan's end and at its beginning (after
  /// the inputs were sampled, before the first rung).
  std::vector<ExprId> cell_end;
  std::vector<ExprId> cell_begin;
  /// By RungId: the value of the rung's expression when it was executed.
  std::vector<ExprId> rung_value;
  /// By node of the program: its value when it was executed (a Branch has
  /// none).
  std::vector<ExprId> node_value;
  /// By CallId: the result of the call (false where it was skipped), and
  /// whether it was executed.
  std::vector<ExprId> call_value;
  std::vector<ExprId> call_executed;
  /// By InstanceId: state indices of the instance, in ElementKind order.
  std::vector<std::vector<std::uint32_t>> instance_states;
  /// Only scans in which all of these hold are considered (`//@ assume`).
  std::vector<ExprId> constraints;
  std::vector<Fault> faults;
  /// Of build_freezing_system(): no time passes in this scan, and inputs are as
  /// in the first such scan (a state). No value: time always passes.
  ExprId frozen;

  VarId add_input(std::string name, VarRole role, Type type, std::int64_t low,
                  std::int64_t high, CellId cell = {});
  /// Adds a state; its `next` is set by the caller before the system is used.
  std::uint32_t add_state(std::string name, Type type, std::int64_t low,
                          std::int64_t high, std::int64_t init,
                          CellId cell = {});
  ExprId of(VarId var) const { return vars[var].expr; }
  ExprId state_expr(std::uint32_t state) const {
    return vars[states[state].var].expr;
  }

  /// A clock for a property's monitor: at the end of each scan it is 0 when
  /// `restart` (a term of that scan), else it has grown by dt, up to `cap`.
  /// Returns its state index; `next` is set.
  std::uint32_t add_clock(std::string name, ExprId restart, std::int64_t cap);
};

/// Compiles a program. Element steps come from element_kinds() alone.
/// Preconditions: build_program() reported no error.
/// Limits: linear in the program.
TransitionSystem build_transition_system(const Program& program);

/// The same, but in any run, behind its first scan, time may stop for good: in
/// all scans from then on no clock grows, and inputs keep the values that they
/// have in the first of them. There, all samples of one pin are one.
TransitionSystem build_freezing_system(const Program& program);

/// Gives the names of a formula their terms.
class NameResolver {
 public:
  virtual ~NameResolver() = default;
  virtual ExprId resolve(std::string_view name) = 0;
};

/// A formula without calls as a term.
/// Preconditions: it parsed, `names` knows every name, and its types are right:
/// element tables are ours, properties are checked when they are read.
ExprId compile_formula(ExprArena& exprs, const Formula& formula,
                       NameResolver& names);

/// One operator of a formula (no name, literal or call) over its operands'
/// terms, in order.
ExprId apply_operator(ExprArena& exprs, const FormulaNode& node,
                      const ExprId* operands);

/// The state variables and inputs that `roots` depend on, through any number
/// of scans, with the constraints' inputs. Flags by VarId index.
std::vector<bool> cone_of_influence(const TransitionSystem& ts,
                                    const std::vector<ExprId>& roots);

/// A term in the program's names, as properties are written.
std::string to_string(const TransitionSystem& ts, ExprId expr);

}  // namespace rung
