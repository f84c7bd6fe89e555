#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "frontend/ldmicro/program_text.h"
#include "frontend/statements.h"

namespace rung::ldmicro {

/// Everything a name of LDmicro can be: its first letter says it, and for
/// timers, how the program uses it.
///
/// An input is sampled where it is read: the k-th read of a scan is a cell of
/// its own, `Xa` and then `Xa.2`, unless inputs are stable.
class Names {
 public:
  Names(const ProgramText& text, Ast& ast, StatementWriter& out,
        ErrorLimit& errors, bool stable_inputs);

  /// The cell of a contact; empty after an error (RP052).
  std::string_view contact(const Word& name);
  /// The cell of a coil.
  std::string_view coil(const Word& name);

  struct Integer {
    std::string_view name;  // empty after an error
    CellShape shape;
    std::uint32_t bits() const { return shape.high > 127 ? 16 : 8; }
  };
  Integer integer(const Word& name);
  /// A name or a number, as an expression; empty after an error.
  Expression operand(const Word& word);

  /// Only one timer and resets use it, so nothing sees that it is a number.
  bool is_clock(std::string_view name) const;
  struct Clock {
    std::uint32_t index = 0;
    Op op = Op::TimerOn;
  };
  const Clock& clock(std::string_view name, SourceRange where);
  /// Of the list of variables, or what the number of scans needs.
  std::int64_t largest(std::string_view name) const;

  /// What counters begin with, and what RES gives them.
  std::int64_t initial(std::string_view name) const;
  void set_initial(std::string_view name, std::int64_t value);

 private:
  struct Use {
    SourceRange timer;  // where one has this name
    Op op = Op::TimerOn;
    bool number = false;  // something looks at the number of scans
    std::optional<std::int64_t> start;  // of a counter
    SourceRange counter;
    std::optional<Clock> clock;
  };

  void survey(const Instruction& instruction);
  void survey_timer(const Instruction& instruction);
  void survey_counter(const Instruction& instruction);
  std::string_view fail(const Word& name, std::string_view why);
  bool is_name(const Word& name);
  std::string_view bit(const Word& name, AstDeclaration::Kind role);

  const ProgramText& text_;
  Ast& ast_;
  StatementWriter& out_;
  ErrorLimit& errors_;
  bool stable_inputs_;
  std::map<std::string_view, std::uint32_t> cells_;  // in Ast::declarations
  std::map<std::string_view, std::uint32_t> samples_;
  std::map<std::string_view, Use> uses_;
};

}  // namespace rung::ldmicro
