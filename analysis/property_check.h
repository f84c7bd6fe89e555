#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/formula.h"
#include "analysis/program.h"
#include "analysis/property_line.h"
#include "base/diagnostic.h"

namespace rung {

/// `prev` reaches back this many scans at the most.
inline constexpr std::uint32_t kMaxHistory = 60;

/// What a name in a property stands for.
struct PropertyName {
  enum class Kind : std::uint8_t {
    Unknown,
    Cell,   // cell
    Done,   // T(0).q
    Fired,  // T(0).fired
    Value,  // T(0).elapsed, C(0).value
  };
  Kind kind = Kind::Unknown;
  CellId cell;
  InstanceId instance;
};

/// The names of a program, for many look-ups.
class PropertyNames {
 public:
  explicit PropertyNames(const Program& program);

  PropertyName find(std::string_view name) const;
  /// ` (did you mean ...?)`; of the first few names only: it reads all names.
  std::string suggestion(std::string_view name) const;

 private:
  const Program& program_;
  std::unordered_map<std::string_view, CellId> cells_;
  std::unordered_map<std::string_view, InstanceId> instances_;
  mutable int suggestions_ = 0;
};

/// Checks that a formula of a property is one: syntax, names, types.
class FormulaChecker {
 public:
  FormulaChecker(Program& program, const PropertyNames& names,
                 DiagnosticSink& sink)
      : program_(program), names_(names), sink_(sink) {}

  /// Is `formula` a bit? If not, says why; the range of the message is the
  /// part of the formula that is wrong. Raises the clock caps of the timers
  /// that it compares with a number.
  bool check(const Slice& formula) { return check(formula, false); }

  /// The same for `assume`, where only inputs may stand.
  bool check_assumption(const Slice& formula) { return check(formula, true); }

  /// The same for a formula that no text of the user is: messages point at
  /// all of `where`.
  bool check_made(std::string_view formula, SourceRange where) {
    made_where_ = where;
    const bool good = check({formula, {}}, false);
    made_where_ = {};
    return good;
  }

 private:
  struct Value {
    Type type = Type::Bit;
    bool constant = false;
    bool observed = false;      // T(0).elapsed: may only be compared
    bool only_cells = true;     // no element, no call in it
    std::uint32_t history = 0;  // scans that it looks back
    InstanceId instance;        // of an observed value
    std::int64_t low = 0;
    std::int64_t high = 1;
  };

  bool check(const Slice& formula, bool inputs_only);
  void visit(std::uint32_t node);
  Value name(const FormulaNode& node);
  Value call(const FormulaNode& node);
  Value comparison(const FormulaNode& node);
  Value arithmetic(const FormulaNode& node);
  Value choose(const FormulaNode& node);
  void observe(const Value& observed, const Value& other,
               const FormulaNode& node);
  void need(Type type, std::uint32_t operand);
  void need_no_observation(std::uint32_t operand);
  void fail(std::string_view code, const FormulaNode& node,
            std::string message);
  void report(std::string_view code, SourceRange where, std::string message);

  /// Operands of the node at hand: positions in formula_.nodes.
  std::uint32_t operand(std::uint32_t number) const {
    return operands_[number];
  }
  const Value& value(std::uint32_t number) const {
    return values_[operand(number)];
  }

  Program& program_;
  const PropertyNames& names_;
  DiagnosticSink& sink_;
  Slice slice_;
  SourceRange made_where_;
  Formula formula_;
  bool inputs_only_ = false;
  bool failed_ = false;
  std::vector<Value> values_;
  std::vector<std::uint32_t> operands_;
};

}  // namespace rung
