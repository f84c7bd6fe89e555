#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/il_mitsubishi/devices.h"
#include "frontend/il_mitsubishi/lines.h"

namespace rung::melsec {

enum class Code : std::uint8_t {
  Contact,  // LD, AND, OR and their kin: see Join and Edge
  AndBlock,
  OrBlock,
  Push,  // MPS
  Read,  // MRD
  Pop,   // MPP
  Invert,
  Out,
  OutInverse,
  Set,
  Reset,
  Rise,  // PLS
  Fall,  // PLF
  Zone,  // MC
  ZoneEnd,
  End,
  Nothing,
};
enum class Join : std::uint8_t { Load, And, Or, Xor };
enum class Edge : std::uint8_t { None, Rising, Falling };

struct Operator {
  std::string_view name;
  Code code = Code::Nothing;
  std::uint8_t operands = 0;  // OUT has two for a timer or counter
  Join join = Join::Load;
  bool negate = false;
  Edge edge = Edge::None;
  AstOp compare = AstOp::Name;  // of a comparison contact
};
/// Null when there is none.
const Operator* find_operator(std::string_view upper_word);

/// A word in capitals.
std::string upper(std::string_view word);

/// Executes a list symbolically. The result is an expression; where an output
/// takes it, it becomes an assignment.
///
/// The stack of blocks is the expression stack itself: a block is a run of
/// nodes, so ANB and ORB add one node. Between a contact and the output that
/// takes it nothing is written, therefore a value may be read late; what
/// outlives an output is kept in a bit.
class ListReader {
 public:
  ListReader(const LineList& list, Ast& ast, StatementWriter& writer,
             ErrorLimit& errors)
      : list_(list),
        writer_(writer),
        errors_(errors),
        devices_(ast, writer, errors) {}

  void run();

 private:
  /// There is a result; it is whole, or an output took it already.
  enum class State : std::uint8_t { None, Live, Taken, Broken };
  struct Zone {
    std::uint32_t level = 0;
    std::string_view power;
    SourceRange where;
  };

  // list_reader.cpp
  void find_operators();
  void execute(std::size_t index);
  void contact(const Line& line, const Operator& op);
  void begin_block(SourceRange where);
  Expression operand(const Line& line, const Operator& op);
  Expression comparison(const Line& line, const Operator& op);
  void push_word(Expression& nodes, const Word& word);
  void join_blocks(AstOp op, SourceRange where);
  void branch(const Operator& op, SourceRange where);
  bool has_result(SourceRange where);
  bool is_whole(SourceRange where);

  // list_outputs.cpp
  void output(std::size_t index, const Operator& op);
  void write(const Line& line, const Operator& op, const Expression& power);
  void write_relay(const Line& line, const Operator& op, Device& device,
                   const Expression& power);
  void write_counted(const Line& line, const Operator& op, Device& device,
                     const Expression& power);
  void zone(const Line& line, const Expression& power);
  void zone_end(const Line& line);
  Device* target(const Line& line, std::size_t word, bool zone);
  std::optional<std::int64_t> preset(const Line& line, const Device& device);
  std::optional<std::uint32_t> level(const Line& line);
  bool goes_on(std::size_t index) const;
  void keep_result(SourceRange where);
  void finish();

  void fail(std::string_view code, SourceRange where, std::string message);
  std::string_view text(const Line& line, std::size_t word) const {
    return list_.text_of(line.words[word]);
  }
  SourceRange range(const Line& line, std::size_t word) const {
    return list_.range_of(line.words[word]);
  }
  SourceRange range(const Line& line) const;
  Expression value() const {
    return {stack_.begin() + static_cast<std::ptrdiff_t>(blocks_.back()),
            stack_.end()};
  }
  void forget();
  void give_up();

  const LineList& list_;
  StatementWriter& writer_;
  ErrorLimit& errors_;
  Devices devices_;
  std::vector<const Operator*> operators_;  // by line; null: an error
  Expression stack_;
  std::vector<std::size_t> blocks_;  // where each begins in stack_
  State state_ = State::None;
  SourceRange result_where_;                // the contact that began it
  std::vector<std::string_view> branches_;  // MPS: the bits that keep results
  SourceRange branch_where_;
  std::vector<Zone> zones_;
  bool ended_ = false;
};

}  // namespace rung::melsec
