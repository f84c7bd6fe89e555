#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/program.h"
#include "backend/unit/bounds.h"
#include "backend/unit/names.h"
#include "backend/unit/unit.h"
#include "backend/unit/unused.h"
#include "base/diagnostic.h"

namespace rung::backend {

class UnitBuilder;

/// How a target has timers, counters, edges and latches: what a call of an
/// element is there. One for each set of blocks that targets share.
class Elements {
 public:
  virtual ~Elements() = default;
  /// Once, before the first statement: makes blocks, and binds cells of the
  /// source that are pins of them.
  virtual void declare(UnitBuilder& builder) = 0;
  /// Writes what the call does, and returns its result: an expression that
  /// keeps its value to the end of the rung.
  virtual Terms call(UnitBuilder& builder, const ElementCall& call,
                     std::vector<Terms> arguments) = 0;
  /// All calls stay in their expressions: short circuits skip them there.
  virtual bool inline_only() const { return false; }
};

/// What a target can express.
struct Profile {
  std::string_view name;  // "instruction lists", for messages
  const NameRules* names = nullptr;
  /// Statements behind conditions: `IF`, jumps, or an enable input.
  bool conditions = true;
  bool first_values = true;  // cells may begin with another value than 0
  bool words = true;         // with arithmetic and comparisons
  bool wraps = true;         // words are modulo 2^16, else they hold 32 bits
  bool ladder = false;  // contacts in series and in parallel are all there is
  bool inline_calls = false;    // elements are called in expressions
  bool short_circuits = false;  // `&&` and `||` of those, in every case
};

/// Turns a program into a Unit: calls of elements stand in statements of their
/// own, in the order of their execution, and what a short circuit skips has a
/// guard.
///
/// Errors: what the target cannot express goes to the sink (RP084), all of it.
/// Limits: linear in the program; no recursion.
class UnitBuilder {
 public:
  UnitBuilder(const Program& program, const Profile& profile,
              DiagnosticSink& sink);

  std::optional<Unit> build(Elements& elements, std::string_view name);

  // --- for Elements ----------------------------------------------------------
  const Program& program() const { return program_; }
  Unit& unit() { return unit_; }
  void fail(SourceRange where, std::string message);

  BlockId add_block(std::string_view type, const Instance& instance);
  CellId add_pin(BlockId block, std::string_view pin, Type type);
  /// A state that a target has no element for: `T_0_started`.
  CellId add_state(const Instance& instance, std::string_view state, Type type);
  /// `cell` of the source is this variable.
  void bind(CellId cell, CellId variable) {
    variable_of_[cell.index()] = variable;
  }

  /// Does a short circuit skip what is written now?
  bool is_conditional() const { return !open_.empty(); }

  /// The call of an element that stands in an expression.
  Terms inline_call(std::string head, const std::vector<Terms>& operands);
  /// A contact as it is; else a made variable that holds the value.
  Terms kept(Terms value, Type type = Type::Bit);
  /// The made variable in any case.
  CellId kept_cell(Terms value, Type type = Type::Bit);
  /// `result` itself when nothing in this rung may change it any more.
  Terms result_of(const ElementCall& call, Terms result);
  /// Statements, behind the conditions that a short circuit put up.
  void assign(CellId target, Terms value);
  void assign_when(const Terms& condition, CellId target, Terms value);
  void call(BlockId block, std::vector<Argument> arguments,
            std::optional<std::int64_t> preset);

 private:
  struct Open {              // a short circuit
    std::uint32_t join = 0;  // the And or Or
    Terms guard;             // a contact
  };

  void declare_cells();
  void relate_constants();
  void check_words();
  bool fits(Bounds bounds) const;
  std::string word_range() const;
  void check_rung_words(const Rung& rung, std::vector<bool>& wraps);
  void lower_rung(RungId id);
  void lower_node(std::uint32_t at);
  void lower_call(std::uint32_t at);
  void lower_branch(std::uint32_t at);
  void bit_to_word();
  void expand_xor();
  void finish_rung(const Rung& rung);
  Terms take(std::size_t operands);
  void push(const Terms& terms);
  CellId make(Type type);
  void pure(CellId target, Terms value, Terms guard = {});
  void add(Statement statement);

  const Program& program_;
  const Profile& profile_;
  DiagnosticSink& sink_;
  bool failed_ = false;
  Unit unit_;
  NameTable names_;
  Elements* elements_ = nullptr;
  WordBounds bounds_;
  Unused unused_;
  std::vector<CellId> variable_of_;  // by cell of the source

  // Of the rung that is being lowered.
  RungId rung_;
  Terms terms_;                        // operands, one behind the other
  std::vector<std::uint32_t> starts_;  // of each operand, in terms_
  std::vector<Open> open_;
  std::unordered_map<InstanceId, std::uint32_t> calls_left_;
};

}  // namespace rung::backend
