#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/iec/cursor.h"
#include "frontend/iec/scope.h"

namespace rung::il_iec {

using iec::Context;
using iec::Cursor;
using iec::Scope;
using iec::Symbol;
using iec::Token;
using iec::TokenKind;
using iec::Value;

enum class Code : std::uint8_t {
  Load,
  Store,
  Set,
  Reset,
  Not,
  Binary,  // iec::Operator
  Jump,
  Return,
  Call,
  Pin,  // S1, CLK, ...: gives an input of a block and executes it
};

struct Operator {
  std::string_view name;
  Code code = Code::Load;
  bool negate = false;                    // N
  bool condition = false;                 // C
  iec::Operator op = iec::Operator::And;  // of Binary
};
const Operator* find_operator(std::string_view upper_word);
std::vector<std::string_view> operator_names();
/// Is the word, in capitals, an operator of instruction lists?
bool is_operator(std::string_view upper_word);

/// Executes a list symbolically: the accumulator is an expression, which turns
/// into assignments where it is stored.
class ListParser {
 public:
  ListParser(Cursor cursor, Scope& scope)
      : cursor_(cursor), scope_(scope), base_(scope.here()) {}

  void run();

 private:
  /// The accumulator: it has a value, has none, or an error was said about it.
  enum class State : std::uint8_t { None, Known, Broken };
  struct Frame {
    Value left;
    const Operator* op = nullptr;
    State state = State::None;
    SourceRange where;
  };
  struct Jump {
    std::string_view before;  // the guard at the jump; empty: none
    std::string_view after;
  };
  struct Label {
    std::size_t position = 0;  // of its token
    SourceRange where;
    std::vector<Jump> jumps;
  };

  // list_parser.cpp
  void line();
  void end_line();
  void check_comment();
  void instruction();
  const Operator* take_operator(SourceRange& where);
  void execute(const Operator& op, SourceRange where);
  void load(const Operator& op, SourceRange where);
  void binary(const Operator& op, SourceRange where);
  void apply(const Operator& op, Value right, SourceRange where);
  void close(SourceRange where);
  void store(const Operator& op, SourceRange where);
  void write(const Operator& op, Symbol& target, SourceRange target_where,
             SourceRange where);
  void set_or_reset(const Operator& op, Symbol& target,
                    SourceRange target_where, SourceRange where);
  void keep_value(SourceRange where);
  bool is_live() const;

  // list_jumps.cpp
  void find_labels();
  void label();
  void jump(const Operator& op, SourceRange where);
  Label* jump_target(SourceRange& where);
  void jump_to(Label* target, const Operator& op, SourceRange where);

  // list_calls.cpp
  std::optional<Value> operand();
  std::optional<Value> variable_operand();
  Symbol* variable(SourceRange& where);
  Symbol* instance_here();
  void call(const Operator& op, SourceRange where);
  void pin_operator(const Operator& op, Symbol& instance, SourceRange where);
  void function(SourceRange where);
  bool arguments(std::vector<iec::Argument>& list);
  bool argument(std::vector<iec::Argument>& list);

  void fail(std::string_view code, SourceRange where, std::string message);
  bool known(SourceRange where, const iec::Type& type, std::string_view what);
  bool known(SourceRange where);
  bool plain(std::string_view name, SourceRange where);
  void set_value(std::optional<Value> value);
  void forget() { state_ = State::None; }

  Cursor cursor_;
  Scope& scope_;
  Context base_;         // where the list began
  bool failed_ = false;  // in this line
  std::unordered_map<std::string, Label> labels_;
  std::size_t open_jumps_ = 0;
  std::vector<Frame> frames_;  // open parentheses
  State state_ = State::None;
  Value value_;            // the current result
  std::string_view kept_;  // the last bit that keeps a result
};

}  // namespace rung::il_iec
