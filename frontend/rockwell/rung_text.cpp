#include "frontend/rockwell/rung_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "base/text.h"
#include "frontend/token_list.h"

namespace rung::rockwell {
namespace {

using ladder::Effect;
using ladder::Step;

constexpr std::array kInstructions = {
    InstructionKind{"ADD", Op::Arithmetic, 3, 3, Effect::Output, AstOp::Add},
    InstructionKind{"AFI", Op::AlwaysFalse, 0, 0, Effect::None},
    InstructionKind{"CLR", Op::Clear, 1, 1, Effect::Output},
    InstructionKind{"CTD", Op::Counter, 3, 3, Effect::Output, AstOp::Not},
    InstructionKind{"CTU", Op::Counter, 3, 3, Effect::Output},
    InstructionKind{"DIV", Op::Arithmetic, 3, 3, Effect::Output, AstOp::Divide},
    InstructionKind{"EQ", Op::Compare, 2, 2, Effect::None, AstOp::Equal},
    InstructionKind{"EQU", Op::Compare, 2, 2, Effect::None, AstOp::Equal},
    InstructionKind{"GE", Op::Compare, 2, 2, Effect::None, AstOp::GreaterEqual},
    InstructionKind{"GEQ", Op::Compare, 2, 2, Effect::None,
                    AstOp::GreaterEqual},
    InstructionKind{"GRT", Op::Compare, 2, 2, Effect::None, AstOp::Greater},
    InstructionKind{"GT", Op::Compare, 2, 2, Effect::None, AstOp::Greater},
    InstructionKind{"JMP", Op::Jump, 1, 1, Effect::Output},
    InstructionKind{"JSR", Op::Call, 1, 3, Effect::Output},
    InstructionKind{"LBL", Op::Label, 1, 1, Effect::None},
    InstructionKind{"LE", Op::Compare, 2, 2, Effect::None, AstOp::LessEqual},
    InstructionKind{"LEQ", Op::Compare, 2, 2, Effect::None, AstOp::LessEqual},
    InstructionKind{"LES", Op::Compare, 2, 2, Effect::None, AstOp::Less},
    InstructionKind{"LIM", Op::Limit, 3, 3, Effect::None},
    InstructionKind{"LIMIT", Op::Limit, 3, 3, Effect::None},
    InstructionKind{"LT", Op::Compare, 2, 2, Effect::None, AstOp::Less},
    InstructionKind{"MCR", Op::MasterControl, 0, 0, Effect::Output},
    InstructionKind{"MOV", Op::Move, 2, 2, Effect::Output},
    InstructionKind{"MOVE", Op::Move, 2, 2, Effect::Output},
    InstructionKind{"MUL", Op::Arithmetic, 3, 3, Effect::Output,
                    AstOp::Multiply},
    InstructionKind{"NE", Op::Compare, 2, 2, Effect::None, AstOp::NotEqual},
    InstructionKind{"NEQ", Op::Compare, 2, 2, Effect::None, AstOp::NotEqual},
    InstructionKind{"NOP", Op::NoOperation, 0, 0, Effect::None},
    InstructionKind{"ONS", Op::OneShot, 1, 1, Effect::Output},
    InstructionKind{"OSF", Op::OneShotFalling, 2, 2, Effect::Output},
    InstructionKind{"OSR", Op::OneShotRising, 2, 2, Effect::Output},
    InstructionKind{"OTE", Op::Energize, 1, 1, Effect::Output},
    InstructionKind{"OTL", Op::Latch, 1, 1, Effect::Output},
    InstructionKind{"OTU", Op::Unlatch, 1, 1, Effect::Output},
    InstructionKind{"RES", Op::Reset, 1, 1, Effect::Output},
    InstructionKind{"RET", Op::Return, 0, 0, Effect::Output},
    InstructionKind{"RTO", Op::Timer, 3, 3, Effect::Output},
    InstructionKind{"SBR", Op::Subroutine, 0, 0, Effect::None},
    InstructionKind{"SUB", Op::Arithmetic, 3, 3, Effect::Output,
                    AstOp::Subtract},
    InstructionKind{"TND", Op::End, 0, 0, Effect::Output},
    InstructionKind{"TOF", Op::Timer, 3, 3, Effect::Output},
    InstructionKind{"TON", Op::Timer, 3, 3, Effect::Output},
    InstructionKind{"XIC", Op::Examine, 1, 1, Effect::None},
    InstructionKind{"XIO", Op::Examine, 1, 1, Effect::None, AstOp::Not},
};

const InstructionKind* find_instruction(std::string_view name) {
  const auto* const found = std::find_if(
      kInstructions.begin(), kInstructions.end(),
      [&](const InstructionKind& row) { return row.name == name; });
  return found == kInstructions.end() ? nullptr : found;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f';
}

class Parser {
 public:
  Parser(const Piece& piece, RungTexts& out, ErrorLimit* errors)
      : piece_(piece), text_(piece.text), out_(out), errors_(errors) {}

  bool run() {
    begin_rung();
    while (skip_blanks()) element();
    if (!steps_.empty() || !branches_.empty() || framed_) {
      fail("RP051", at_, at_, "this rung has no end");
    }
    return good_;
  }

 private:
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {piece_.file, piece_.begin + static_cast<std::uint32_t>(begin),
            piece_.begin + static_cast<std::uint32_t>(end)};
  }

  void fail(std::string_view code, std::size_t begin, std::size_t end,
            std::string message) {
    good_ = false;
    if (errors_ != nullptr) {
      errors_->error(code, range(begin, end), std::move(message));
    }
  }

  bool skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size();
  }

  void begin_rung() {
    steps_.clear();
    branches_.clear();
    framed_ = false;
    begin_ = at_;
  }

  void end_rung(std::size_t end) {
    if (!branches_.empty()) {
      fail("RP051", branches_.back(), branches_.back() + 1,
           "this branch has no end in its rung");
      for (std::size_t i = branches_.size(); i > 0; --i) {
        bracket(Step::Kind::Close, end, end);
      }
    }
    ladder::prepare(steps_);
    out_.rungs.push_back({std::move(steps_), range(begin_, end)});
    begin_rung();
  }

  void bracket(Step::Kind kind, std::size_t begin, std::size_t end) {
    steps_.push_back({.kind = kind, .where = range(begin, end)});
  }

  void element() {
    const std::size_t begin = at_;
    switch (text_[at_]) {
      case ';':
        ++at_;
        return end_rung(at_);
      case '[':
        ++at_;
        return open(begin);
      case ',':
        ++at_;
        return next(begin);
      case ']':
        ++at_;
        return close(begin);
      default:
        break;
    }
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    if (at_ == begin) {
      ++at_;
      return fail("RP051", begin, at_,
                  "an instruction is expected here, and " +
                      quoted_excerpt(text_.substr(begin, 1)) + " found");
    }
    word(begin);
  }

  void word(std::size_t begin) {
    const std::string_view name = text_.substr(begin, at_ - begin);
    const bool number = name.find_first_not_of("0123456789") == name.npos;
    if (number && at_ < text_.size() && text_[at_] == ':') {
      ++at_;  // `12:`, the number of the rung
      return;
    }
    if (name == "SOR" || name == "EOR") return frame(name == "SOR", begin);
    if (name == "BST") return open(begin);
    if (name == "NXB") return next(begin);
    if (name == "BND") return close(begin);
    instruction(name, begin);
  }

  void frame(bool start, std::size_t begin) {
    coordinate();
    if (start == framed_) {
      return fail("RP051", begin, begin + 3, "`SOR` and `EOR` come in turns");
    }
    if (start) {
      begin_rung();
      framed_ = true;
    } else {
      end_rung(at_);
    }
  }

  void open(std::size_t begin) {
    branches_.push_back(begin);
    bracket(Step::Kind::Open, begin, at_);
  }
  void next(std::size_t begin) {
    if (branches_.empty()) return no_branch(begin);
    bracket(Step::Kind::Next, begin, at_);
  }
  void close(std::size_t begin) {
    if (branches_.empty()) return no_branch(begin);
    branches_.pop_back();
    bracket(Step::Kind::Close, begin, at_);
  }
  void no_branch(std::size_t begin) {
    fail("RP051", begin, at_, "no branch is open here");
  }

  // `[1,0]` behind a word: where it is drawn.
  void coordinate() {
    const std::size_t begin = at_;
    skip_blanks();
    std::size_t at = at_;
    if (at >= text_.size() || text_[at] != '[') {
      at_ = begin;
      return;
    }
    do {
      ++at;
    } while (at < text_.size() &&
             ((text_[at] >= '0' && text_[at] <= '9') || text_[at] == ','));
    const bool drawn = at < text_.size() && text_[at] == ']' && at > at_ + 1;
    at_ = drawn ? at + 1 : begin;
  }

  void instruction(std::string_view name, std::size_t begin) {
    Instruction it;
    it.name = name;
    it.kind = find_instruction(name);
    if (at_ < text_.size() && text_[at_] == '(') {
      if (!listed_operands(it)) return;
    } else {
      blank_operands(it);
    }
    it.where = range(begin, at_);
    ++count_;
    if (errors_ == nullptr) return;
    if (it.kind == nullptr) {
      return fail(
          "RP087", begin, begin + name.size(),
          "the instruction " + quoted_excerpt(name) + " is not supported");
    }
    const std::size_t operands = it.operands.size();
    if (operands < it.kind->fewest || operands > it.kind->most) {
      return fail("RP054", begin, at_,
                  quoted_excerpt(name) + " has " +
                      std::to_string(it.kind->fewest) + " operands, not " +
                      std::to_string(operands));
    }
    steps_.push_back(
        {.effect = it.kind->effect,
         .instruction = static_cast<std::uint32_t>(out_.instructions.size()),
         .where = it.where});
    out_.instructions.push_back(std::move(it));
  }

  // `(a,b[i,j],?)`; nothing between the brackets is no operand.
  bool listed_operands(Instruction& it) {
    const std::size_t open = at_++;
    std::size_t begin = at_;
    std::size_t depth = 1;
    for (; at_ < text_.size() && depth > 0; ++at_) {
      const char c = text_[at_];
      if (c == '(' || c == '[') ++depth;
      if (c == ')' || c == ']') --depth;
      if (depth == 0 || (depth == 1 && c == ',')) {
        operand(it, begin, at_);
        begin = at_ + 1;
      }
    }
    const bool good = depth == 0 && text_[at_ - 1] == ')';
    if (!good) {
      fail("RP051", open, open + 1, "this bracket is not closed");
    }
    const bool none = it.operands.size() == 1 && it.operands[0].text.empty();
    if (none) it.operands.clear();
    return good;
  }

  void operand(Instruction& it, std::size_t begin, std::size_t end) {
    while (begin < end && is_blank(text_[begin])) ++begin;
    while (end > begin && is_blank(text_[end - 1])) --end;
    it.operands.push_back(
        {text_.substr(begin, end - begin), range(begin, end)});
  }

  // As many as the instruction has; `[1,0] (*name*)` has the name in it.
  void blank_operands(Instruction& it) {
    coordinate();
    const std::size_t most = it.kind == nullptr ? 0 : it.kind->most;
    while (it.operands.size() < most) {
      const std::size_t before = at_;
      if (!skip_blanks()) break;
      const std::size_t begin = at_;
      if (text_.substr(at_, 2) == "(*") {
        const std::size_t end = text_.find("*)", at_);
        if (end == text_.npos) break;
        operand(it, begin + 2, end);
        at_ = end + 2;
        continue;
      }
      while (at_ < text_.size() && !is_blank(text_[at_]) &&
             std::string_view(";,(").find(text_[at_]) == text_.npos) {
        ++at_;
      }
      const std::string_view found = text_.substr(begin, at_ - begin);
      if (found.empty() || found == "BST" || found == "NXB" || found == "BND" ||
          found == "EOR" || found.starts_with("]")) {
        at_ = before;
        break;
      }
      operand(it, begin, at_);
    }
  }

 public:
  std::int64_t count_ = 0;

 private:
  const Piece& piece_;
  std::string_view text_;
  RungTexts& out_;
  ErrorLimit* errors_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;
  std::vector<Step> steps_;
  std::vector<std::size_t> branches_;  // where they begin
  bool framed_ = false;                // behind SOR
  bool good_ = true;
};

}  // namespace

void read_rungs(const Piece& piece, RungTexts& out, ErrorLimit& errors) {
  Parser(piece, out, &errors).run();
}

std::int64_t count_instructions(std::string_view text) {
  RungTexts ignored;
  const Piece piece = {text, {}, 0};
  Parser parser(piece, ignored, nullptr);
  return parser.run() ? parser.count_ : -1;
}

}  // namespace rung::rockwell
