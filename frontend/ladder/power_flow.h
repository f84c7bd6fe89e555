#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/statements.h"

namespace rung::ladder {

/// What an instruction of a rung does besides passing power.
enum class Effect : std::uint8_t {
  None,    // a contact, a comparison: nothing else can see that it was there
  State,   // a timer, an edge: it remembers
  Output,  // a coil, a move: it writes what others read
};

/// A rung as text lists it: instructions, and brackets around branches. Nested
/// branches are brackets in an array, so their depth costs no stack.
struct Step {
  enum class Kind : std::uint8_t { Instruction, Open, Next, Close };
  Kind kind = Kind::Instruction;
  Effect effect = Effect::None;   // of a bracket: the most in its branches
  bool needed = true;             // something reads the power behind it
  std::uint32_t instruction = 0;  // an index of the reader's own
  SourceRange where;
};

/// Fills in `effect` of the brackets and `needed` of all steps. Brackets match.
void prepare(std::vector<Step>& steps);

/// The power on the wire of a rung, from left to right.
///
/// Instructions have their effects in the order of the text, and what a later
/// one writes does not change the power that is already on the wire. Branches
/// all begin with the power at their `[`, are executed in order, and join in an
/// OR. Contacts become one expression; where power is looked at a second time,
/// or an effect stands between, it is kept in a bit of its own. So the result
/// is linear in the rung.
class PowerFlow {
 public:
  explicit PowerFlow(StatementWriter& out) : out_(&out) {}

  /// A new rung; an empty name is power that is always there.
  void begin(std::string_view power, SourceRange where);

  void open(const Step& step);
  void next(const Step& step);
  void close(const Step& step);

  /// A contact or comparison in series.
  void contact(const Expression& condition, SourceRange where);

  /// The power as an expression. It is gone then, unless step.needed.
  Expression use(const Step& step);
  /// The power as a name that keeps its value for the rest of the scan; empty:
  /// it is always there.
  std::string_view hold(SourceRange where);
  /// The power for an instruction that set() follows: it is gone then. Short,
  /// so that a row of such instructions stays linear.
  Expression take(SourceRange where);
  /// What is on the wire behind an instruction that makes its own power. An
  /// element's call in it is executed in any case, before the next effect.
  void set(const Expression& power, bool calls = false);
  /// The rung ends.
  void finish(SourceRange where);

 private:
  struct Branches {
    bool effects = false;
    std::string_view begin;  // with effects: the power at the `[`
    bool outer = false;      // without: there was power before the `[`
    bool any = false;        // a branch has ended
    bool always = false;     // one of them is a wire with power always
    std::vector<std::string_view> ends;  // with effects: of the branches
  };

  Expression release(SourceRange where);
  void end_branch(const Step& step);
  void close_effects(const Branches& branches, SourceRange where);
  void start(std::string_view power, SourceRange where);

  StatementWriter* out_;
  /// The power: postorder of what is in series. Without effects, the operands
  /// of open branches stand before it, each to be joined when they close.
  Expression nodes_;
  bool present_ = false;   // nodes_ ends in the power; else it is always there
  bool calls_ = false;     // nodes_ has an element's call
  std::string_view held_;  // the name that nodes_ is, if it keeps its value
  std::vector<Branches> open_;
};

/// A name and a truth value as expressions.
Expression name_of(std::string_view name, SourceRange where);
Expression truth(bool value, SourceRange where);
/// `power` as an expression, for what hold() returned.
Expression power_of(std::string_view held, SourceRange where);

}  // namespace rung::ladder
