#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/il_iec/parser.h"

namespace rung::il_iec {

enum class Code : std::uint8_t {
  Load,
  Store,
  Set,
  Reset,
  Not,
  Binary,  // AstOp
  Jump,
  Return,
  Call,
  Pin,      // S1, CLK, ...: gives an input of a block and executes it
  Unknown,  // an operator that is not supported
};

struct Operator {
  std::string_view name;
  Code code = Code::Unknown;
  bool negate = false;     // N
  bool condition = false;  // C
  AstOp op = AstOp::And;   // of Binary
};
const Operator* find_operator(std::string_view upper_word);
std::vector<std::string_view> operator_names();

/// What an operand or the accumulator is worth.
struct Value {
  Expression nodes;
  Kind kind = Kind::Bool;
};

/// Executes a list symbolically: the accumulator is an expression, which turns
/// into assignments where it is stored.
class ListParser {
 public:
  ListParser(Cursor& cursor, Names& names, Writer& writer, ErrorLimit& errors,
             bool by_use)
      : cursor_(cursor),
        names_(names),
        writer_(writer),
        errors_(errors),
        by_use_(by_use) {}

  void run(std::string_view end_word);

 private:
  /// The accumulator: it has a value, has none, or an error was said about it.
  enum class State : std::uint8_t { None, Known, Broken };
  struct Frame {
    std::size_t start = 0;  // in stack_
    const Operator* op = nullptr;
    State state = State::None;
    Kind kind = Kind::Bool;
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

  struct Output {  // Q => variable
    const Pin* pin = nullptr;
    Cell* target = nullptr;
    SourceRange where;
  };

  // list_parser.cpp
  void line(std::string_view end_word);
  void end_line();
  void check_comment();
  const Operator* take_operator(SourceRange& where);
  void instruction();
  void load(const Operator& op, SourceRange where);
  void binary(const Operator& op, SourceRange where);
  void apply(const Operator& op, Kind right, SourceRange where);
  void close(SourceRange where);
  void invert(SourceRange where);
  void store(const Operator& op, SourceRange where);
  void write(const Operator& op, Cell& cell, SourceRange target_where,
             SourceRange where);
  void set_or_reset(const Operator& op, Cell& cell, SourceRange target_where,
                    SourceRange where);
  void keep_value(SourceRange where);

  // list_jumps.cpp
  void find_labels(std::string_view end_word);
  void label();
  void jump(const Operator& op, SourceRange where);
  void jump_to(Label* target, const Operator& op, SourceRange where);

  // list_operands.cpp
  std::optional<Value> operand();
  std::optional<Value> name_operand();
  std::optional<Value> number_operand(const Token& first, bool negative);
  std::optional<Value> address_operand(const Token& token);
  std::optional<Value> pin_operand(Instance& instance, const Token& first);
  Cell* cell_here(const Token& first, SourceRange& where, bool& is_preset);
  Cell* cell_of(const Token& token);
  Cell* target_pin(Instance& instance, SourceRange& where, bool& is_preset);
  Cell* use(std::string_view text, const std::string& key, Kind kind,
            SourceRange where);
  Instance* instance_here();
  void call(const Operator& op, SourceRange where);
  void arguments(Instance& instance, SourceRange where);
  void argument(Instance& instance, std::size_t index,
                std::vector<Output>& outputs);
  void output_argument(const Pin& pin, std::vector<Output>& outputs);
  void give(Instance& instance, const Pin& pin, const Value& value,
            SourceRange where);
  void set_preset(Instance& instance, const Value& value, SourceRange where);
  void execute(Instance& instance, SourceRange where);
  void pin_operator(const Operator& op, Instance& instance, SourceRange where);

  void fail(std::string_view code, SourceRange where, std::string message);
  std::string suggestion(std::string_view word,
                         const std::vector<std::string_view>& known) const;
  std::string suggestion(std::string_view word) const;
  bool known(SourceRange where, Kind kind, std::string_view what);
  bool known(SourceRange where);
  bool plain(const Operator& op, SourceRange where);
  Expression value() const {
    return {stack_.begin() + static_cast<std::ptrdiff_t>(start()),
            stack_.end()};
  }
  std::size_t start() const {
    return frames_.empty() ? 0 : frames_.back().start;
  }
  void forget() {
    stack_.resize(start());
    state_ = State::None;
  }
  bool is_live() const;

  Cursor& cursor_;
  Names& names_;
  Writer& writer_;
  ErrorLimit& errors_;
  bool by_use_;
  bool failed_ = false;  // in this line
  std::unordered_map<std::string, Label> labels_;
  std::size_t open_jumps_ = 0;
  Expression stack_;  // open parentheses' values, then the accumulator's
  std::vector<Frame> frames_;
  State state_ = State::None;
  std::string_view kept_;  // the last bit that keeps a result
  Kind kind_ = Kind::Bool;
};

}  // namespace rung::il_iec
