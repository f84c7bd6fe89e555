#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"

namespace rung {

/// A program built by hand, so that these tests need no reader:
///
///   Q0 = (I0 || Q0) && !I1      latches itself
///   Q1 = I1                     Q2 = I2
///   Q3 = T(0, 0.5, I0)          M0 = C(0, 3, I1, false, I2)
///   QW0 = IW0                   M1 is read and never written: Q4 = M1
class SampleProgram {
 public:
  SampleProgram();

  Program program;
  std::uint32_t node(Node value);
  std::uint32_t read(std::string_view name);
  std::uint32_t call(std::string_view name, std::int64_t parameter,
                     std::vector<std::uint32_t> arguments);
  void rung(std::string_view target, std::uint32_t begin);
  CellId find(std::string_view name) const;
  CellId cell(std::string name, CellRole role, Type type = Type::Bit);
};

/// Property lines read against a SampleProgram.
struct ReadLines {
  explicit ReadLines(const std::string& lines) : ReadLines(lines, {}) {}
  /// `initial`: a cell that is true before the first scan.
  ReadLines(const std::string& lines, std::string_view initial);

  SampleProgram sample;
  SourceSet sources;
  DiagnosticList found;
  PropertySet set;

  /// The one error there is, as `code range: message`; empty when none or more.
  std::string error() const;
};

/// Runs a transition system on its terms.
class Interpreter {
 public:
  explicit Interpreter(const TransitionSystem& ts);
  /// One scan; `inputs` by cell name. Then value() is of this scan.
  void scan(std::int64_t dt, const std::vector<std::int64_t>& inputs);
  std::int64_t value(ExprId id) const { return values_[id.index()]; }

 private:
  std::int64_t compute(const Expr& expr) const;

  const TransitionSystem& ts_;
  bool started_ = false;
  std::vector<std::int64_t> vars_;
  std::vector<std::int64_t> values_;
};

}  // namespace rung
