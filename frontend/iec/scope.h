#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/iec/expansion.h"

namespace rung::iec {

enum class Operator : std::uint8_t {
  And,
  Or,
  Xor,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
};
std::string_view to_string(Operator op);

/// An argument of a call: `IN := value`, `Q => variable`, or a value by its
/// place.
struct Argument {
  std::string name;  // in capitals; empty: by its place
  bool output = false;
  bool negated = false;        // of an output: NOT Q => variable
  Value value;                 // of an input
  Symbol* variable = nullptr;  // of an output; of an input that is a variable
  SourceRange where;
};

/// What the body of a unit works with while it is executed once. Everything
/// that cannot be done is an error with its place, and gives no value.
class Scope {
 public:
  Scope(Expansion& expansion, Frame& frame)
      : expansion_(&expansion), frame_(&frame) {}

  StatementWriter& writer() { return expansion_->writer(); }
  ErrorLimit& errors() { return expansion_->errors(); }
  void fail(std::string_view code, SourceRange where, std::string message,
            std::vector<Label> labels = {}) {
    expansion_->fail(code, where, std::move(message), std::move(labels));
  }
  bool has_failed() const { return expansion_->has_failed(); }
  /// To be called once a statement: false means stop, with an error said.
  bool step(SourceRange where) { return expansion_->step(where); }

  // --- names (scope.cpp) -----------------------------------------------------

  /// A variable of this unit, or `%IX0.0`; null: there is none (no error).
  Symbol* find(std::string_view name);
  /// The same, with an error.
  Symbol* get(std::string_view name, SourceRange where);
  /// `instance.member`, with an error.
  Symbol* member(Symbol& instance, std::string_view name, SourceRange where);
  /// A path, `a`, `a.b.c` or `%IX0.0`, with an error.
  Symbol* resolve(std::string_view path, SourceRange where);

  std::optional<Value> read(Symbol& symbol, SourceRange where);
  std::optional<Value> read(std::string_view path, SourceRange where);
  /// May a statement of this unit write it? With an error.
  bool check_writable(Symbol& symbol, SourceRange where);
  bool write(Symbol& target, Value value, SourceRange target_where,
             SourceRange where);
  bool write(std::string_view path, Value value, SourceRange target_where,
             SourceRange where);
  std::optional<Value> literal(std::string_view text, SourceRange where);
  /// Is the name a standard or the project's own function?
  bool is_function(std::string_view name) const;
  /// All names of variables, for "did you mean"; empty when nobody reads it.
  std::string suggestion(std::string_view name) const;

  // --- values (operators.cpp) ------------------------------------------------

  Value bit(bool value, SourceRange where);
  Value number(std::int64_t value, const Type& type, SourceRange where);
  std::optional<Value> invert(Value a, SourceRange where);
  std::optional<Value> negate(Value a, SourceRange where);
  std::optional<Value> binary(Operator op, Value a, Value b, SourceRange where);
  /// As a value of this type, where that loses nothing; with an error.
  std::optional<Value> convert(Value value, const Type& type,
                               SourceRange where);
  /// g ? then : otherwise; both of one type.
  Value choose(Value g, const Value& then, const Value& otherwise,
               SourceRange where);
  /// A value that one expression may use more than once: a cell or a constant.
  Value once(Value value, SourceRange where, std::string_view prefix = "kept");
  /// As convert(), and both to the larger type of the two.
  bool unify(Value& a, Value& b, std::string_view what, SourceRange where);

  // --- calls (calls.cpp, functions.cpp) --------------------------------------

  /// Gives the inputs, executes, and hands out the outputs.
  bool call(Symbol& instance, std::vector<Argument> arguments,
            SourceRange where);
  /// Standard functions and the project's own. `alone`: nothing has been read
  /// that its outputs could change before it is used.
  std::optional<Value> function(std::string_view name,
                                std::vector<Argument> arguments,
                                SourceRange where, bool alone = true);
  /// A hidden R_TRIG (F_TRIG) that belongs to this unit's frame alone; it is
  /// executed here, and what it gives is a bit of its own. In a function block
  /// each instance has its own, so `site` must name the place in the body.
  Value edge(bool rising, Value clk, std::string_view site, SourceRange where);

  // --- conditions (scope.cpp) ------------------------------------------------

  /// Statements up to leave() have an effect only where `condition` is true
  /// too. Conditions nest.
  Context enter(const Value& condition, SourceRange where);
  /// What leave() may return to.
  Context here() const;
  void leave(const Context& outer, SourceRange where);
  /// RETURN: no statement of this body further down has an effect.
  void leave_body(SourceRange where);
  /// A bit that is true where statements have an effect now, and e is.
  std::string_view keep_condition(const Expression& condition,
                                  SourceRange where);

  Expansion& expansion() { return *expansion_; }
  Frame& frame() { return *frame_; }

 private:
  struct Call;
  bool check_operands(Operator op, const Value& a, const Value& b,
                      SourceRange where);
  Value logic(Operator op, Value a, const Value& b, SourceRange where);
  bool match(Call& call, std::vector<Argument>& arguments);
  void no_such_parameter(const Call& call, const Argument& argument);
  bool give_inputs(Call& call);
  bool give_input(Call& call, std::size_t index);
  bool give_enable(Call& call);
  bool execute(Call& call);
  bool run_block(const Symbol& instance, SourceRange where);
  bool take_outputs(Call& call);
  Symbol* parameter_symbol(Call& call, std::size_t index, SourceRange where);
  std::optional<Value> own_function(const Pou& pou,
                                    std::vector<Argument> arguments,
                                    SourceRange where);
  bool set_preset(Symbol& preset, const Value& value, SourceRange where);
  bool is_output_of_other(const Symbol& symbol) const;
  static Symbol* variable_of(const Value& value);
  void assign(Symbol& target, const Expression& value, SourceRange target_where,
              SourceRange where);

  Expansion* expansion_;
  Frame* frame_;
  std::string_view gone_;  // a bit: this body has been left
};

}  // namespace rung::iec
