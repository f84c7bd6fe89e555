#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontend/ldmicro/names.h"

namespace rung::ldmicro {

/// Writes rungs as assignments: what intcode.cpp of LDmicro compiles them to.
class RungWriter {
 public:
  /// `adjust`: the cycles that a timer without an adjustment has.
  RungWriter(const ProgramText& text, Names& names, StatementWriter& out,
             ErrorLimit& errors, std::int64_t adjust)
      : text_(text),
        names_(names),
        out_(out),
        errors_(errors),
        flow_(out),
        adjust_(adjust) {}

  void write(const ProgramText::Rung& rung);

 private:
  using Step = ladder::Step;

  void instruction(const Instruction& it, const Step& step);
  void contact(const Instruction& it);
  void coil(const Instruction& it, const Step& step);
  void coil_value(std::string_view target, std::size_t flag,
                  const Instruction& it, const Step& step);
  void compare(const Instruction& it);
  void move(const Instruction& it);
  void arithmetic(const Instruction& it);
  void reset(const Instruction& it);
  void reset_clock(std::string_view name, SourceRange where);
  void master_relay(const Instruction& it);
  void edge(std::string_view operation, SourceRange where);
  void one_shot_low(SourceRange where);
  void oscillator(SourceRange where);

  // counters.cpp
  void counter(const Instruction& it);
  std::optional<std::string_view> counting(const Instruction& it);
  void count_to(const Instruction& it, const Names::Integer& cell,
                const Expression& limit, std::string_view event);
  void count_round(const Instruction& it, const Names::Integer& cell,
                   const Expression& limit, std::string_view event);
  void timer(const Instruction& it);
  std::optional<std::int64_t> period(const Instruction& it);
  void counted_timer(const Instruction& it, std::int64_t scans);

  /// `target := value` where there is power.
  void store(const Names::Integer& target, const Expression& value,
             SourceRange target_where, SourceRange where);

  const ProgramText& text_;
  Names& names_;
  StatementWriter& out_;
  ErrorLimit& errors_;
  ladder::PowerFlow flow_;
  std::int64_t adjust_;
  std::string_view master_;  // the power of rungs; empty: always
};

}  // namespace rung::ldmicro
