#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/formula.h"
#include "check/model.h"

namespace rung::check {

/// Formulas of properties as terms over one scan: their value at its end, or
/// some scan ends before. What is further back than the state is remembered in
/// states of its own, named as certificates name them: `prev(I0)`.
class FormulaEncoder {
 public:
  FormulaEncoder(const Program& program, const ProgramValues& values,
                 Model& model);

  /// At the end of the scan, or of the one `back` before. The text was checked
  /// when the property was read.
  Value value(std::string_view text, std::uint32_t back = 0);

  /// `now` at the end of the scan before; `initial` in the first.
  Value remembered(Value now, std::int64_t initial, const std::string& name);

 private:
  /// Which value of a node is asked for.
  struct View {
    std::uint32_t node = 0;
    std::uint32_t back = 0;
    bool begin = false;  // inside `begin`
    auto operator<=>(const View&) const = default;
  };

  Value value_of(const View& root);
  std::vector<View> operands_of(const View& view) const;
  Value compute(const View& view, const std::vector<Value>& operands);
  Value call(const View& view, const std::vector<Value>& operands);
  Value leaf(std::string_view name, const View& view);
  Value cell(CellId id, std::uint32_t back);
  Value member(std::string_view name, std::uint32_t back);
  Value observed(InstanceId id, std::string_view what, bool before);
  Value once(Value now, const View& view);
  Value older(Value term, std::int64_t initial, std::string_view name,
              std::uint32_t from, std::uint32_t back);
  std::int64_t initial_value(Value term) const;

  const Program& program_;
  const ProgramValues& values_;
  Model& model_;
  std::unordered_map<std::string_view, CellId> cells_;
  std::unordered_map<std::string_view, InstanceId> instances_;
  std::map<std::pair<std::uint32_t, std::int64_t>, std::uint32_t> memory_;
  std::map<std::uint32_t, std::uint32_t> once_;  // by the operand's term
  std::string_view text_;                        // of the formula at hand
  Formula formula_;
  std::map<View, Value> known_;
};

}  // namespace rung::check
