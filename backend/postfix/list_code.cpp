#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "backend/postfix/listing.h"
#include "backend/unit/bounds.h"

namespace rung::postfix {
namespace {

using backend::Bounds;
using backend::bounds_of;

constexpr std::uint32_t kNoBranch = 0xffff'ffff;

// A rung's nodes are the postfix form already. What is checked here is that
// they are one tree, in order and well typed, so that the stacks of the
// machine hold at each node what the node reads.
class CodeLister {
 public:
  CodeLister(const Program& program, const std::vector<std::uint32_t>& address,
             DiagnosticSink& sink, std::vector<Instruction>& code)
      : program_(program), address_(address), sink_(sink), code_(code) {}

  bool run() {
    code_.reserve(program_.nodes.size() + program_.rungs.size());
    for (const Rung& rung : program_.rungs) {
      if (!list_rung(rung)) {
        fail(rung.where, "the rung of `" + program_.cells[rung.target].name +
                             "` is not in postfix order");
      }
    }
    return !failed_;
  }

 private:
  struct Operand {
    std::uint32_t node = 0;
    std::uint32_t calls_before = 0;  // in the rung, before this operand's first
    std::uint32_t branch = kNoBranch;  // the Skip in code_ that follows it
    Bounds bounds;                     // of a word
  };

  void fail(SourceRange where, std::string message) {
    failed_ = true;
    report_inexpressible(sink_, where, std::move(message));
  }

  bool list_rung(const Rung& rung) {
    operands_.clear();
    calls_ = 0;
    overflow_ = {};
    if (rung.begin >= rung.end || rung.end > program_.nodes.size()) {
      return false;
    }
    for (std::uint32_t at = rung.begin; at < rung.end; ++at) {
      if (!list_node(at, rung.end)) return false;
    }
    const Cell& target = program_.cells[rung.target];
    if (operands_.size() != 1 || operands_[0].node != rung.root() ||
        operands_[0].branch != kNoBranch ||
        program_.nodes[rung.root()].type != target.type ||
        target.role == CellRole::Input) {
      return false;
    }
    note_faults(rung);
    code_.push_back({.kind = target.type == Type::Bit
                                 ? Instruction::Kind::WriteBit
                                 : Instruction::Kind::WriteWord,
                     .cell = rung.target,
                     .address = address_[rung.target.index()],
                     .where = rung.target_where});
    return true;
  }

  bool list_node(std::uint32_t at, std::uint32_t end) {
    const Node& node = program_.nodes[at];
    switch (node.op) {
      case NodeOp::Constant:
        return list_constant(at);
      case NodeOp::Read:
        return list_read(at);
      case NodeOp::Call:
        return list_call(at);
      case NodeOp::Branch:
        return list_branch(at, end);
      case NodeOp::And:
      case NodeOp::Or:
        return list_and_or(at);
      case NodeOp::Not:
        return list_operator(at, Opcode::Not);
      case NodeOp::Xor:
        return list_operator(at, Opcode::Xor);
      case NodeOp::Equal:
        return list_operator(at, Opcode::Equal);
      case NodeOp::NotEqual:
        return list_operator(at, Opcode::NotEqual);
      case NodeOp::Less:
        return list_operator(at, Opcode::Less);
      case NodeOp::LessEqual:
        return list_operator(at, Opcode::LessEqual);
      case NodeOp::Greater:
        return list_operator(at, Opcode::Greater);
      case NodeOp::GreaterEqual:
        return list_operator(at, Opcode::GreaterEqual);
      case NodeOp::Add:
        return list_operator(at, Opcode::Add);
      case NodeOp::Subtract:
        return list_operator(at, Opcode::Subtract);
      case NodeOp::Multiply:
        return list_operator(at, Opcode::Multiply);
      case NodeOp::Divide:
        return is_divisor(node.b) && list_operator(at, Opcode::Divide);
      case NodeOp::Negate:
        return list_operator(at, Opcode::Negate);
      case NodeOp::Wrap16:
        return list_operator(at, Opcode::Wrap16);
      case NodeOp::Wrap:
        fail(node.where, "words of 16 bits only are in the format");
        return list_operator(at, Opcode::Wrap16);
      case NodeOp::ToWord:
        return list_operator(at, Opcode::ToWord);
      case NodeOp::ToBit:
        return list_operator(at, Opcode::ToBit);
    }
    return false;
  }

  // The top `count` operands, which must be these nodes of this type. The
  // result becomes the operand `at`.
  bool combine(std::uint32_t at, const std::uint32_t* nodes, std::size_t count,
               Type type) {
    if (operands_.size() < count) return false;
    const std::size_t first = operands_.size() - count;
    for (std::size_t i = 0; i < count; ++i) {
      const Operand& operand = operands_[first + i];
      if (operand.node != nodes[i] || operand.branch != kNoBranch ||
          program_.nodes[operand.node].type != type) {
        return false;
      }
    }
    const std::uint32_t before =
        count == 0 ? calls_ : operands_[first].calls_before;
    const Bounds bounds = find_bounds(at, count);
    operands_.resize(first);
    operands_.push_back({.node = at, .calls_before = before, .bounds = bounds});
    return true;
  }

  Bounds find_bounds(std::uint32_t at, std::size_t count) {
    const Node& node = program_.nodes[at];
    if (node.type == Type::Bit) return {};
    if (node.op == NodeOp::Constant) return {node.value, node.value};
    if (node.op == NodeOp::Read) {
      return {program_.cells[node.cell].low, program_.cells[node.cell].high};
    }
    const Bounds left = operands_[operands_.size() - count].bounds;
    Bounds bounds = bounds_of(node.op, left, operands_.back().bounds);
    if (!bounds.within(kWordMin, kWordMax)) {
      overflow_ = node.where;
      bounds.low = std::max(bounds.low, kWordMin);
      bounds.high = std::min(bounds.high, kWordMax);
    }
    return bounds;
  }

  // The program computes with exact integers; the machine does not go on with
  // a wrong one.
  void note_faults(const Rung& rung) {
    const Cell& target = program_.cells[rung.target];
    const bool leaves = target.type == Type::Word &&
                        !operands_[0].bounds.within(target.low, target.high);
    if (!overflow_.has_value() && !leaves) return;
    sink_.report(
        {.code = "RP086",
         .severity = Severity::Note,
         .where = overflow_.has_value() ? overflow_ : rung.where,
         .message = overflow_.has_value()
                        ? "this may leave 32 bits: the machine then stops"
                        : "the value may leave the range of `" + target.name +
                              "`: the machine then stops"});
  }

  bool list_operator(std::uint32_t at, Opcode opcode) {
    const Node& node = program_.nodes[at];
    const Operator& entry = *find_operator(static_cast<std::uint8_t>(opcode));
    const std::array<std::uint32_t, 2> nodes = {node.a, node.b};
    const bool of_words = entry.words_in != 0;
    code_.push_back({.opcode = opcode, .where = node.where});
    return node.type == (entry.word_out ? Type::Word : Type::Bit) &&
           combine(at, nodes.data(), of_words ? entry.words_in : entry.bits_in,
                   of_words ? Type::Word : Type::Bit);
  }

  bool is_divisor(std::uint32_t index) const {
    if (index >= program_.nodes.size()) return false;
    const Node& node = program_.nodes[index];
    return node.op == NodeOp::Constant && node.value != 0;
  }

  bool list_constant(std::uint32_t at) {
    const Node& node = program_.nodes[at];
    if (node.type == Type::Bit) {
      code_.push_back({.opcode = node.value != 0 ? Opcode::True : Opcode::False,
                       .where = node.where});
      return (node.value == 0 || node.value == 1) &&
             combine(at, nullptr, 0, Type::Bit);
    }
    if (node.value < kWordMin || node.value > kWordMax) {
      fail(node.where, "the constant " + std::to_string(node.value) +
                           " does not fit a word of 32 bits");
    }
    code_.push_back({.kind = Instruction::Kind::Push,
                     .value = node.value,
                     .where = node.where});
    return combine(at, nullptr, 0, Type::Word);
  }

  bool list_read(std::uint32_t at) {
    const Node& node = program_.nodes[at];
    code_.push_back({.kind = node.type == Type::Bit
                                 ? Instruction::Kind::ReadBit
                                 : Instruction::Kind::ReadWord,
                     .cell = node.cell,
                     .address = address_[node.cell.index()],
                     .where = node.where});
    return node.type == program_.cells[node.cell].type &&
           combine(at, nullptr, 0, node.type);
  }

  bool list_call(std::uint32_t at) {
    const Node& node = program_.nodes[at];
    const ElementCall& call = program_.calls[node.call];
    const ElementCode* element = find_element(call.operation->opcode);
    if (element == nullptr || element->bits_in != call.arguments.size()) {
      fail(call.where, "the format has no instruction for `" +
                           std::string(call.operation->name) + "`");
      return true;  // said; the rung's other errors would only follow from it
    }
    const bool has_preset = element->preset != ElementCode::Preset::None;
    if (has_preset &&
        (call.parameter < kWordMin || call.parameter > kWordMax)) {
      fail(call.where, "the preset " + std::to_string(call.parameter) +
                           " does not fit 32 bits");
    }
    code_.push_back({.kind = Instruction::Kind::Element,
                     .element = element,
                     .address = call.instance.index(),
                     .value = has_preset ? call.parameter : 0,
                     .where = call.where});
    ++calls_;
    return node.type == Type::Bit &&
           combine(at, call.arguments.data(), call.arguments.size(), Type::Bit);
  }

  bool list_branch(std::uint32_t at, std::uint32_t end) {
    const Node& node = program_.nodes[at];
    if (operands_.empty() || node.target <= at || node.target >= end) {
      return false;
    }
    const NodeOp joined = program_.nodes[node.target].op;
    Operand& left = operands_.back();
    if ((joined != NodeOp::And && joined != NodeOp::Or) ||
        node.skip_when != (joined == NodeOp::Or) || left.node + 1 != at ||
        node.a != left.node || program_.nodes[node.target].a != left.node) {
      return false;
    }
    left.branch = static_cast<std::uint32_t>(code_.size());
    code_.push_back(
        {.kind = Instruction::Kind::Skip,
         .opcode = node.skip_when ? Opcode::SkipTrue : Opcode::SkipFalse,
         .where = program_.nodes[node.target].where});
    return true;
  }

  bool list_and_or(std::uint32_t at) {
    const Node& node = program_.nodes[at];
    if (operands_.size() < 2) return false;
    Operand& left = operands_[operands_.size() - 2];
    const bool calls = operands_.back().calls_before != calls_;
    const bool skips = calls && program_.evaluation == Evaluation::ShortCircuit;
    if ((left.branch != kNoBranch) != skips) return false;
    if (skips) {
      code_[left.branch].target = static_cast<std::uint32_t>(code_.size());
      left.branch = kNoBranch;
    }
    const bool fits =
        list_operator(at, node.op == NodeOp::And ? Opcode::And : Opcode::Or);
    if (skips) code_.back().kind = Instruction::Kind::Joined;
    return fits;
  }

  const Program& program_;
  const std::vector<std::uint32_t>& address_;
  DiagnosticSink& sink_;
  std::vector<Instruction>& code_;
  std::vector<Operand> operands_;
  std::uint32_t calls_ = 0;
  SourceRange overflow_;  // in the rung
  bool failed_ = false;
};

}  // namespace

bool list_code(const Program& program,
               const std::vector<std::uint32_t>& address, DiagnosticSink& sink,
               std::vector<Instruction>& code) {
  return CodeLister(program, address, sink, code).run();
}

}  // namespace rung::postfix
