#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/plclib/sketch.h"
#include "frontend/plclib/values.h"
#include "frontend/statements.h"

namespace rung::plclib {

/// Which of the two libraries of the name, and on what board.
struct Reading {
  bool thesis = false;
  bool stable_inputs = false;
  int int_bits() const { return thesis ? 32 : 16; }
};

/// What one pass over a sketch learns for the next: the values that variables
/// may hold. A pass that learns nothing new is the last.
struct Estimates {
  std::unordered_map<std::string_view, Range> ranges;
  std::unordered_set<std::string_view> assigned;  // variables, in loop()
  std::unordered_set<std::string> written_pins;
  std::unordered_set<std::string> shifts;  // edge memories that calls use
  int pass = 0;
  bool grown = false;
};

/// Executes a sketch symbolically: setup() gives the initial values, one run of
/// loop() the assignments of a scan. Functions are put in where they are
/// called, loops are unrolled, and a task may be put in before every statement
/// of a task that it preempts. Iterative: nesting costs no stack.
class Machine {
 public:
  Machine(const TokenList& list, const Sketch& sketch, const Reading& reading,
          Estimates& estimates, Ast& ast, ErrorLimit& errors);

  void run();
  /// ms that calls which wait take in each scan.
  std::int64_t blocked_ms() const { return blocked_; }

 private:
  struct Variable {
    CType type = CType::Int;
    bool constant = false;
    bool timer = false;           // a timer's start: no number to anything else
    bool pin = false;             // its number is that of a pin
    std::size_t declared_at = 0;  // of a local variable: its place
    std::int64_t initial = 0;
    SourceRange where;
  };
  struct Pin {
    enum class Mode : std::uint8_t { Unknown, Input, Output };
    std::string_view name;
    Mode mode = Mode::Unknown;
    bool digital = false;
    bool analog = false;
    bool pulse_width = false;
    bool used = false;
    std::uint32_t reads = 0;
    std::int64_t initial = 0;
    SourceRange where;
  };
  struct Timer {
    std::uint32_t index = 0;
    std::string_view kind;
    std::string_view partner;  // the second variable of a cycle
    std::int64_t blocked = 0;  // time in the scan that passes before its calls
    SourceRange where;
  };
  struct Object {
    ObjectKind kind = ObjectKind::Pulse;
    std::int64_t preset = 0;
    std::vector<std::string_view> cells;
    std::vector<Value> pushed;  // of a stack
    SourceRange where;
  };
  struct Frame {
    enum class Kind : std::uint8_t {
      Block,
      Then,
      Else,
      Loop,
      Function,
      Task,
      Point,  // where tasks may be put in
    };
    Kind kind = Kind::Block;
    bool braced = true;
    std::string_view outer;      // the guard around it
    std::string_view condition;  // of Then and Else
    std::size_t position = 0;    // where to go back to
    const Function* function = nullptr;
    std::size_t task = 0;      // Point: the next; Task: the level around it
    std::string_view counter;  // Loop
    std::vector<std::int64_t> values;
    std::size_t turn = 0;
    SourceRange where;
  };
  struct Argument {
    std::string_view name;  // empty: an expression
    Value value;
    SourceRange where;
  };
  struct Call {
    std::string_view name;
    std::vector<Argument> arguments;
    SourceRange where;
  };
  struct LibraryCall {
    std::string_view name;
    bool thesis = false;
    bool published = false;
    std::size_t arguments = 0;
    void (Machine::*run)(const Call& call) = nullptr;
  };
  struct Method {
    ObjectKind kind;
    std::string_view name;
    bool result = false;
    void (Machine::*run)(Object& object, const Call& call) = nullptr;
  };

  // machine.cpp: names, cells, the accumulator
  void fail(std::string_view code, SourceRange where, std::string message);
  void mark_timers();
  void declare_globals();
  void declare_global(const Global& global);
  void check_calls();
  void finish();
  void declare_outputs();
  void note(std::string_view name, Range range, CType type);
  Range estimate(std::string_view name, const Variable& variable) const;
  bool is_word(std::string_view name, const Variable& variable) const;
  std::optional<std::int64_t> pin_number(std::string_view name) const;
  Pin* pin_at(std::int64_t number, std::string_view name, SourceRange where);
  Pin* pin_of(const Argument& argument);
  Pin::Mode mode_of(const Pin& pin) const;
  Value sample(Pin& pin, bool analog, SourceRange where);
  Value input_cell(std::string_view name, CellShape shape, SourceRange where);
  void write_pin(Pin& pin, Value value, bool pulse_width, SourceRange where);
  void assign(std::string_view name, Value value, SourceRange where);
  void write(std::string_view name, bool word, Value value, SourceRange where);
  void write_memory(std::string_view name, Value bit, SourceRange where);
  void protect(std::string_view name);
  void flush();
  void shorten();
  void keep_accumulator();
  bool accumulator_is_bit(const Call& call);
  Value kept_call(std::string_view operation, std::string_view prefix,
                  const Expression& operands, std::uint32_t index,
                  std::optional<std::int64_t> preset, SourceRange where);

  // statements.cpp
  void execute(const Function& function);
  void step();
  void statement();
  void simple_statement();
  bool needs_point() const;
  void run_point();
  bool finish_frame();
  void finish_statement();
  void if_statement();
  void for_statement();
  bool for_header(Frame& frame);
  void return_statement();
  void local_variable();
  void assignment();
  void call_function(const Function& function, SourceRange where);
  void enter(const Function& function, Frame::Kind kind);
  void leave(const Frame& frame);
  bool expect(std::string_view symbol);
  bool too_large();
  std::string_view inner_guard(Value condition, SourceRange where);

  // expressions.cpp
  std::optional<Value> rvalue();
  std::optional<Value> expression(std::optional<Value> first = std::nullopt);
  std::optional<Value> operand();
  std::optional<Value> name_value();
  std::optional<Value> named_value(std::string_view name, SourceRange where);
  std::optional<Value> pure_call();
  bool at_effect() const;
  std::optional<std::int64_t> constant_expression(std::string_view what);
  std::optional<std::vector<Argument>> arguments();

  // library.cpp: calls of both libraries
  static std::span<const LibraryCall> library();
  static const LibraryCall* find_call(std::string_view name);
  std::optional<Value> call(bool wanted);
  std::optional<Value> call_operand(const Argument& argument, bool analog);
  bool is_pin(const Argument& argument) const;
  void load(std::optional<Value> value, SourceRange where);
  void logic(const Call& call, std::string_view op);
  void write_target(const Argument& argument, Value bit, SourceRange where);
  std::optional<Value> argument_value(const Argument& argument);
  void compare(const Call& call, std::string_view op);
  bool are_counter_cells(const Call& call);
  std::optional<Value> target_value(const Argument& argument);
  std::optional<std::int64_t> period(const Argument& argument);
  Timer* timer_of(const Argument& argument, std::string_view kind);
  void timer(const Call& call, std::string_view operation);
  void cycle(const Call& call, std::string_view name, std::size_t second,
             std::array<std::int64_t, 2> periods);
  void block(std::int64_t ms, SourceRange where);
  void count(const Call& call, bool shows_state);

  // setup.cpp: what concerns the board and not the program
  bool no_effect();
  void set_up_plc(SourceRange where);
  void pin_mode(SourceRange where);
  void custom_io(SourceRange where);
  void print(std::string_view name);

  void call_in(const Call& call);
  void call_in_not(const Call& call);
  void call_in_analog(const Call& call);
  void call_and(const Call& call) { logic(call, "&"); }
  void call_or(const Call& call) { logic(call, "|"); }
  void call_xor(const Call& call) { logic(call, "^"); }
  void call_and_not(const Call& call) { logic(call, "&~"); }
  void call_or_not(const Call& call);
  void call_out(const Call& call);
  void call_out_not(const Call& call);
  void call_out_pwm(const Call& call);
  void call_set(const Call& call);
  void call_reset(const Call& call);
  void call_latch(const Call& call);
  void call_compare_gt(const Call& call) { compare(call, ">"); }
  void call_compare_lt(const Call& call) { compare(call, "<"); }
  void call_timer_delay(const Call& call) { timer(call, "timerDelay"); }
  void call_timer_on(const Call& call) { timer(call, "timerOn"); }
  void call_timer_off(const Call& call) { timer(call, "timerOff"); }
  void call_timer_pulse(const Call& call) { timer(call, "timerPulse"); }
  void call_timer_cycle(const Call& call);
  void call_m8013(const Call& call);
  void call_counter(const Call& call) { count(call, false); }
  void call_counter_state(const Call& call) { count(call, true); }
  void call_delay(const Call& call);
  void call_digital_write(const Call& call);

  // objects.cpp
  static const Method* find_method(ObjectKind kind, std::string_view name);
  void declare_object(const Global& global);
  void declare_cells(Object& object, std::string_view name, bool full);
  std::optional<Value> method_call(bool wanted);
  Value fresh(const Value& bit, std::string_view prefix);
  Value bit_of(const Object& object, std::size_t cell, SourceRange where);
  Value count_of(const Object& object, SourceRange where);
  void step_counter(Object& object, const Call& call, bool up);
  void load_counter(Object& object, const Call& call, bool full);
  void counter_up(Object& o, const Call& c) { step_counter(o, c, true); }
  void counter_down(Object& o, const Call& c) { step_counter(o, c, false); }
  void counter_preset(Object& o, const Call& c) { load_counter(o, c, true); }
  void counter_clear(Object& o, const Call& c) { load_counter(o, c, false); }
  void counter_upper(Object& object, const Call& call);
  void counter_lower(Object& object, const Call& call);
  void shift_input(Object& object, const Call& call);
  void shift(Object& object, const Call& call, bool left);
  void shift_left(Object& o, const Call& c) { shift(o, c, true); }
  void shift_right(Object& o, const Call& c) { shift(o, c, false); }
  void shift_bit(Object& object, const Call& call);
  bool is_used(std::string_view cell) const;
  void shift_reset(Object& object, const Call& call);
  void stack_push(Object& object, const Call& call);
  void stack_join(Object& object, const Call& call, std::string_view op);
  void stack_pop(Object& o, const Call& c) { stack_join(o, c, ""); }
  void stack_or(Object& o, const Call& c) { stack_join(o, c, "|"); }
  void stack_and(Object& o, const Call& c) { stack_join(o, c, "&"); }
  void pulse_clock(Object& object, const Call& call);
  void pulse_rising(Object& object, const Call& call);
  void pulse_falling(Object& object, const Call& call);

  Cursor cursor_;
  const TokenList& list_;
  const Sketch& sketch_;
  Reading reading_;
  Estimates& estimates_;
  Ast& ast_;
  ErrorLimit& errors_;
  StatementWriter writer_;
  Arithmetic arithmetic_;

  std::unordered_map<std::string_view, Variable> variables_;
  std::vector<std::string_view> order_;                   // of variables_
  std::unordered_map<std::string_view, Value> counters_;  // of loops
  std::unordered_map<std::int64_t, Pin> pins_;
  std::vector<std::int64_t> pin_order_;
  std::unordered_map<std::string_view, Timer> timers_;
  std::unordered_map<std::string_view, Object> objects_;
  std::vector<std::uint32_t> task_elements_;
  std::vector<std::uint32_t> task_runs_;

  std::unordered_set<const Function*> executed_;
  std::vector<Frame> frames_;
  Value acc_;
  std::size_t level_ = 0;  // the first task that may preempt
  bool in_setup_ = false;
  bool modes_unknown_ = false;
  bool point_done_ = false;
  bool called_ = false;  // in this expression
  bool stopped_ = false;
  std::size_t steps_ = 0;
  std::int64_t blocked_ = 0;  // by delays, so far in this scan
};

}  // namespace rung::plclib
