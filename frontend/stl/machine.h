#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/stl/memory.h"
#include "frontend/stl/operators.h"
#include "frontend/stl/statements.h"

namespace rung::stl {

/// The status word and the accumulators, as expressions. The result of logic
/// operation (RLO) is `base OR term` where `joined`, else `term`; `base` is the
/// OR bit. Whether the next query begins a new result (/FC is 0) is known, but
/// behind an `O` alone: there /FC is the result itself.
struct Registers {
  Expression term;
  Expression base;
  bool joined = false;
  bool first = true;
  bool after_or = false;
  Expression sta;
  Expression saved;                 // BR
  std::array<Expression, 4> flags;  // OS OV CC0 CC1; empty: not known
  Word accu1;
  Word accu2;
};

/// Executes a program symbolically. What an instruction writes becomes an
/// assignment; jumps forward become guards, calls are put in their place.
class Machine {
 public:
  Machine(const Source& source, Ast& ast, StatementWriter& writer,
          ErrorLimit& errors)
      : source_(source),
        ast_(ast),
        writer_(writer),
        errors_(errors),
        memory_(writer, errors) {}

  void run();

 private:
  struct Jump {
    std::string_view before;  // the guards around it
    std::string_view after;
    Registers registers;
  };
  struct Paren {
    const Operator* op = nullptr;
    Registers outer;
    SourceRange where;
  };
  /// A block that is being executed.
  struct Frame {
    const Block* block = nullptr;
    std::uint32_t scope = 0;
    std::size_t next = 0;
    std::string_view guard;  // at its begin
    std::map<std::string, std::size_t> labels;
    std::map<std::string, std::vector<Jump>> jumps;  // "": to the end
    std::size_t open_jumps = 0;
    bool stops = false;  // STOP may have ended it
  };
  struct Counted {
    std::string_view kind;    // of element_kinds()
    std::string_view prefix;  // of its operations
    std::optional<std::uint32_t> index;
    std::optional<std::int64_t> preset;  // ms
    SourceRange where;
  };

  // prepare.cpp
  bool prepare();
  void choose_mnemonics();
  void note_block(const Block& block);
  void note_timer(const Statement& statement, const Operator& op,
                  std::optional<std::uint32_t> loaded);
  const Block* find_block(BlockKind kind, std::uint32_t number) const;

  // machine.cpp
  void execute(const Block& block);
  void enter(const Block& block, SourceRange where);
  void leave();
  void step(const Statement& statement);
  void dispatch(const Statement& statement, const Operator& op);
  void dispatch_words(const Statement& statement, const Operator& op);
  void label(const Statement& statement);
  void jump(const Statement& statement, const Operator& op);
  void jump_to(const std::string& label, const Expression& condition,
               SourceRange where);
  void merge(std::vector<Jump>& jumps, bool forgets, SourceRange where);
  void merge_bit(Expression& here, const std::vector<Jump>& jumps,
                 const std::vector<const Expression*>& values,
                 SourceRange where);
  static void merge_word(Word& here, const Word& other);
  void end(const Operator& op, SourceRange where);
  void call(const Statement& statement, const Operator& op);
  void stop(SourceRange where);
  void settle_registers(SourceRange where);

  // machine_bits.cpp
  void logic(const Statement& statement, const Operator& op);
  void and_before_or(SourceRange where);
  void join(Expression value, Join join);
  void open(const Operator& op, SourceRange where);
  void close(SourceRange where);
  void write_bit(const Statement& statement, const Operator& op);
  void edge(const Statement& statement, const Operator& op);
  void zone(const Operator& op, SourceRange where);
  std::optional<Expression> bit_operand(const Operand& operand);
  std::optional<Address> bit_target(const Operand& operand);
  Expression result() const;
  Expression take_result(SourceRange where);
  void settle(Expression& nodes, std::string_view prefix, SourceRange where);
  void settle_result(SourceRange where);
  void end_result(Expression sta);
  bool is_read_later() const;
  bool is_read_from(std::size_t first) const;
  bool in_zone() const { return zone_on_ && !zones_.empty(); }

  // machine_words.cpp
  void load(const Statement& statement, const Operator& op);
  std::optional<Word> word_operand(const Operand& operand);
  Word status_word(SourceRange where);
  void transfer(const Statement& statement);
  void compare(const Operator& op, SourceRange where);
  void add(const Operator& op, SourceRange where);
  void to_bcd(SourceRange where);
  Expression bcd_of(const Expression& value, SourceRange where);
  std::optional<Expression> loaded_count(SourceRange where);
  void add_check(Expression value, std::string_view name, SourceRange where);
  bool has_value(const Word& word, SourceRange where);
  void timer(const Statement& statement, const Operator& op);
  void counter(const Statement& statement, const Operator& op);
  void reset_counted(const Statement& statement);
  void set_counter(const Statement& statement);
  Counted* find_counted(const Operand& operand);
  void step_element(Counted& counted, std::string_view operation,
                    const Expression& operands,
                    std::optional<std::int64_t> preset, SourceRange where);
  void check(const Statement& statement, const Operator& op);
  bool push_checked(Expression& nodes, const Operand& operand);
  std::optional<Expression> status_bit(const std::string& name,
                                       SourceRange where);
  void reset_status(SourceRange where);

  void fail(std::string_view code, SourceRange where, std::string message);

  const Source& source_;
  Ast& ast_;
  StatementWriter& writer_;
  ErrorLimit& errors_;
  Memory memory_;
  Mnemonics mnemonics_ = Mnemonics::Both;
  bool broken_ = false;       // errors: nothing is executed
  bool sees_status_ = false;  // the text looks at the status word
  std::map<std::string, const Block*> functions_;
  std::map<std::string, Counted> counted_;
  std::vector<Frame> frames_;
  Registers registers_;
  std::vector<Paren> parens_;
  bool reachable_ = true;
  bool zone_on_ = false;
  std::vector<Expression> zones_;
  std::string_view stop_bit_;
  bool skips_arguments_ = false;  // of a call that was refused
  std::size_t executed_ = 0;
  std::size_t checks_ = 0;
};

}  // namespace rung::stl
