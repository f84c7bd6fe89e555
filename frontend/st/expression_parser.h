#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/iec/cursor.h"
#include "frontend/iec/scope.h"

namespace rung::st {

/// Reads expressions and calls of structured text: operators by their
/// precedence, on stacks of its own.
class ExpressionParser {
 public:
  ExpressionParser(iec::Cursor& cursor, iec::Scope& scope)
      : cursor_(cursor), scope_(scope) {}

  /// Up to what cannot be part of it. An error has been said where there is no
  /// value.
  std::optional<iec::Value> expression();
  /// `(IN := a, Q => b)` behind an instance, and the call.
  bool call(iec::Symbol& instance, SourceRange where);
  /// A variable: a name, a path or an address.
  iec::Symbol* variable(SourceRange& where);

 private:
  enum class Kind : std::uint8_t { Open, Call, Not, Minus, Binary };
  struct Pending {
    Kind kind = Kind::Open;
    iec::Operator op = iec::Operator::And;
    int precedence = 0;
    SourceRange where;
    // Of a call.
    std::string_view name;
    iec::Symbol* instance = nullptr;
    std::vector<iec::Argument> arguments;
    std::size_t values = 0;  // below it
  };
  /// What may stand next.
  enum class Next : std::uint8_t { Operand, Operator, End, Error };

  void start();
  Next step(Next next);
  Next operand();
  Next word();
  Next open_call(std::string_view name, iec::Symbol* instance,
                 SourceRange where);
  Next argument();
  Next output_argument(bool negated);
  Next after_operand();
  Next close();
  Next comma();
  Next finish_call();
  bool finish_argument();
  bool reduce(int precedence);
  bool apply(const Pending& top);
  Next push_value(std::optional<iec::Value> value);
  Next fail(std::string_view code, SourceRange where, std::string message);
  bool is_alone(const Pending& call) const;

  iec::Cursor& cursor_;
  iec::Scope& scope_;
  std::vector<iec::Value> values_;
  std::vector<Pending> pending_;
  std::size_t depth_ = 0;   // of parentheses
  bool has_value_ = false;  // of the argument that is being read
};

}  // namespace rung::st
