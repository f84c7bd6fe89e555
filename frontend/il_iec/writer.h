#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/il_iec/names.h"
#include "frontend/statements.h"

namespace rung::il_iec {

/// Writes statements, which may stand behind conditions, as assignments.
///
/// While guard() names a bit, a statement has an effect only where that bit is
/// true: `x := e` is `x := g AND e OR NOT g AND x`, and a block's call in `e`
/// is not executed where `g` is false, for the Ast is one that short-circuits.
/// Guards are bits that are written once a scan, above the statement.
class Writer {
 public:
  Writer(Ast& ast, Names& names, ErrorLimit& errors)
      : ast_(&ast), names_(&names), errors_(&errors) {}

  /// Outputs of blocks that nothing mentions have no cell.
  void mention(std::string upper_pin) {
    mentioned_.insert(std::move(upper_pin));
  }

  std::string_view guard() const { return guard_; }
  void set_guard(std::string_view bit) { guard_ = bit; }

  void assign(Cell& target, SourceRange target_where, const Expression& value,
              SourceRange where);
  /// A fresh bit or word `prefix.N` with this value, whatever the guard is.
  std::string_view keep(std::string_view prefix, Kind kind,
                        const Expression& value, SourceRange where);
  /// Executes a block; its outputs follow.
  void call(Instance& instance, SourceRange where);

 private:
  void emit(std::string_view target, SourceRange target_where,
            const Expression& value, SourceRange where);
  void output(const Instance& instance, const Pin& pin, SourceRange where);
  Expression call_of(const Instance& instance, std::string_view operation,
                     bool operands, bool preset, SourceRange where);

  Ast* ast_;
  Names* names_;
  ErrorLimit* errors_;
  std::string_view guard_;
  std::set<std::string> mentioned_;
};

}  // namespace rung::il_iec
