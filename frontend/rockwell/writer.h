#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "frontend/ladder/jumps.h"
#include "frontend/ladder/power_flow.h"
#include "frontend/rockwell/tags.h"

namespace rung::rockwell {

/// Writes what a controller executes in a scan: the main routine, and where it
/// calls others, those.
class Writer {
 public:
  Writer(const Project& project, Tags& tags, StatementWriter& out,
         ErrorLimit& errors)
      : project_(project), tags_(tags), out_(out), errors_(errors) {}

  void run();

 private:
  using Step = ladder::Step;

  /// A routine that is being executed.
  struct Frame {
    Frame(const Routine& it, StatementWriter& out)
        : routine(&it), guard(out.guard()), flow(out), jumps(out) {}
    const Routine* routine;
    std::string_view guard;  // of the call
    std::uint32_t rung = 0;
    std::size_t step = 0;
    ladder::PowerFlow flow;
    ladder::Jumps jumps;
    bool zone = false;       // between two MCR
    std::string_view power;  // of rungs in the zone
    SourceRange zone_where;
  };

  /// A timer or a counter.
  struct Block {
    std::uint32_t index = 0;
    std::string_view name;  // of its instruction: TON, CTU, CTD
  };

  void advance();
  void begin_rung(Frame& frame);
  void end_routine();
  void step(Frame& frame, const Step& step);
  void instruction(Frame& frame, const Instruction& it, const Step& step);
  void call(Frame& frame, const Instruction& it);
  void jump(Frame& frame, const Instruction& it);
  void master_control(Frame& frame, const Instruction& it);
  void compare(const Instruction& it);
  void limit(const Instruction& it);
  void energize(const Instruction& it, const Step& step);
  void latch(const Instruction& it, bool value);
  void one_shot(const Instruction& it);
  void store_word(const Operand& operand, const Expression& value,
                  SourceRange where);
  void move(const Instruction& it);
  void arithmetic(const Instruction& it);
  void split(const Place& target, const Operand& source, const Operand& name,
             SourceRange where);
  Block* block(const Instruction& it);
  std::string_view execute(const Instruction& it, const Block& block,
                           const Expression& power);
  void store_count(std::string_view name, const Block& block,
                   SourceRange where);
  void timer(const Instruction& it);
  void counter(const Instruction& it);
  void reset(const Instruction& it);

  void assign_bit(std::string_view cell, const Expression& value,
                  SourceRange where);
  /// Statements that follow are behind the power, too; until leave().
  void enter(SourceRange where);
  void leave();

  const Project& project_;
  Tags& tags_;
  StatementWriter& out_;
  ErrorLimit& errors_;
  std::map<std::string_view, const Routine*> routines_;
  std::set<std::string_view> active_;  // routines in frames_
  std::vector<Frame> frames_;
  ladder::PowerFlow* flow_ = nullptr;  // of the rung that is executed
  std::string_view outside_;           // the guard, while behind the power
  std::uint64_t executed_ = 0;         // instructions
  std::map<std::string_view, Block> blocks_;  // by the tag
};

}  // namespace rung::rockwell
