#include "frontend/ldmicro/program_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "base/text.h"
#include "frontend/ldmicro/lines.h"
#include "frontend/token_list.h"

namespace rung::ldmicro {
namespace {

using ladder::Effect;
using ladder::Step;

constexpr std::array kInstructions = {
    InstructionKind{"ADD", Op::Arithmetic, 3, 3, Effect::Output, AstOp::Add},
    InstructionKind{"COIL", Op::Coil, 4, 5, Effect::Output},
    InstructionKind{"CONTACTS", Op::Contacts, 2, 3, Effect::None},
    InstructionKind{"CTC", Op::CountCircular, 2, 4, Effect::State},
    InstructionKind{"CTD", Op::CountDown, 2, 4, Effect::State},
    InstructionKind{"CTR", Op::CountReverse, 3, 4, Effect::State},
    InstructionKind{"CTU", Op::CountUp, 2, 4, Effect::State},
    InstructionKind{"DIV", Op::Arithmetic, 3, 3, Effect::Output, AstOp::Divide},
    InstructionKind{"EQU", Op::Compare, 2, 2, Effect::None, AstOp::Equal},
    InstructionKind{"GEQ", Op::Compare, 2, 2, Effect::None,
                    AstOp::GreaterEqual},
    InstructionKind{"GRT", Op::Compare, 2, 2, Effect::None, AstOp::Greater},
    InstructionKind{"LEQ", Op::Compare, 2, 2, Effect::None, AstOp::LessEqual},
    InstructionKind{"LES", Op::Compare, 2, 2, Effect::None, AstOp::Less},
    InstructionKind{"MASTER_RELAY", Op::MasterRelay, 0, 0, Effect::Output},
    // AstOp has no remainder: the negation stands for it here.
    InstructionKind{"MOD", Op::Arithmetic, 3, 3, Effect::Output, AstOp::Negate},
    InstructionKind{"MOVE", Op::Move, 2, 2, Effect::Output},
    InstructionKind{"MUL", Op::Arithmetic, 3, 3, Effect::Output,
                    AstOp::Multiply},
    InstructionKind{"NEQ", Op::Compare, 2, 2, Effect::None, AstOp::NotEqual},
    InstructionKind{"OPEN", Op::Open, 0, 0, Effect::None},
    InstructionKind{"OSC", Op::Oscillator, 0, 0, Effect::State},
    InstructionKind{"OSF", Op::OneShotFalling, 0, 0, Effect::State},
    InstructionKind{"OSL", Op::OneShotLow, 0, 0, Effect::State},
    InstructionKind{"OSR", Op::OneShotRising, 0, 0, Effect::State},
    InstructionKind{"PLACEHOLDER", Op::Placeholder, 0, 0, Effect::None},
    InstructionKind{"RES", Op::Reset, 1, 1, Effect::Output},
    InstructionKind{"RTO", Op::TimerRetentive, 2, 3, Effect::State},
    InstructionKind{"SHORT", Op::Short, 0, 0, Effect::None},
    InstructionKind{"SUB", Op::Arithmetic, 3, 3, Effect::Output,
                    AstOp::Subtract},
    InstructionKind{"TOF", Op::TimerOff, 2, 3, Effect::State},
    InstructionKind{"TON", Op::TimerOn, 2, 3, Effect::State},
};

const InstructionKind* find_instruction(std::string_view name) {
  const auto* const found = std::find_if(
      kInstructions.begin(), kInstructions.end(),
      [&](const InstructionKind& row) { return row.name == name; });
  return found == kInstructions.end() ? nullptr : found;
}

class Parser {
 public:
  Parser(std::string_view text, Ast& ast, ErrorLimit& errors)
      : lines_(text, ast.file), ast_(ast), errors_(errors) {}

  ProgramText run() {
    header();
    bool program = false;
    while (!program && !lines_.at_end()) {
      const Word& line = lines_.take();
      if (line.text == "PROGRAM") {
        program = true;
      } else if (line.text == "IO LIST") {
        list(line, [this](const Word& it) { pin(it); });
      } else if (line.text == "VAR LIST") {
        list(line, [this](const Word& it) { variable(it); });
      } else if (line.text == "PULL-UP LIST") {
        list(line, [](const Word&) {});  // electric, not logic
      } else {
        setting(line);
      }
    }
    if (!program) error("RP051", lines_.end(), "expected `PROGRAM`");
    while (!lines_.at_end()) rung(lines_.take());
    return std::move(out_);
  }

 private:
  void error(std::string_view code, SourceRange where, std::string message) {
    errors_.error(code, where, std::move(message));
  }

  void header() {
    if (lines_.at_end()) {
      return error("RP051", lines_.end(), "expected `LDmicro0.1` and the like");
    }
    const Word& line = lines_.take();
    out_.first_format = line.text == "LDmicro0.1";
    if (out_.first_format || line.text == "LDmicro0.2" ||
        line.text == "LDmicro") {
      return;
    }
    error("RP051", line.where,
          "the header " + quoted_excerpt(line.text) +
              " is not known: they are `LDmicro0.1`, `LDmicro0.2`, `LDmicro`");
  }

  void setting(const Word& line) {
    constexpr std::array<std::string_view, 6> kIgnored = {
        "MICRO=", "CRYSTAL=", "BAUD=", "COMPILED=", "COMPILER=", "RATE="};
    for (const std::string_view name : kIgnored) {
      if (line.text.starts_with(name)) return;
    }
    if (line.text.starts_with("CYCLE=")) return cycle(line);
    error("RP051", line.where,
          "expected a setting, a list or `PROGRAM` and found " +
              quoted_excerpt(line.text));
  }

  // `10000`, `10000 us at Timer1, YPlcCycleDuty:0`: the rest says by which
  // timer of the chip, not how long.
  void cycle(const Word& line) {
    const std::vector<Word> words =
        words_of(part_of(line, 6, line.text.size()));
    const auto value =
        words.empty() ? std::nullopt : number_of(words.front().text);
    out_.cycle_where = line.where;
    if (!value || *value <= 0 || *value % 1000 != 0 || *value > 1'000'000'000 ||
        (words.size() > 1 && words[1].text != "us")) {
      return error("RP053", line.where,
                   "the cycle time must be a whole number of milliseconds, "
                   "written in us, up to 1000 s");
    }
    out_.cycle_us = *value;
  }

  template <class Visit>
  void list(const Word& head, Visit visit) {
    while (!lines_.at_end()) {
      const Word& line = lines_.take();
      if (line.text == "END") return;
      visit(line);
    }
    error("RP051", head.where, quoted_excerpt(head.text) + " has no `END`");
  }

  // NAME at PIN, and for modbus a slave and an address.
  void pin(const Word& line) {
    const std::vector<Word> words = words_of(line);
    bool good = words.size() >= 3 && words.size() <= 5 && words[1].text == "at";
    for (std::size_t i = 2; good && i < words.size(); ++i) {
      const auto value = number_of(words[i].text);
      good = value && *value >= 0;
    }
    if (!good) {
      return error("RP051", line.where,
                   "expected a name, `at` and the number of a pin");
    }
    out_.pins.push_back(words.front());
  }

  // `2 bytes NAME`, `NAME signed 16 bit variable`
  void variable(const Word& line) {
    const std::vector<Word> words = words_of(line);
    std::optional<std::int64_t> bytes;
    Word name;
    if (words.size() >= 3 && words[1].text == "bytes") {
      bytes = number_of(words[0].text);
      name = words[2];
    } else if (words.size() >= 4 && words[1].text == "signed" &&
               words[3].text == "bit") {
      const auto bits = number_of(words[2].text);
      if (bits && *bits % 8 == 0) bytes = *bits / 8;
      name = words[0];
    }
    if (!bytes || *bytes < 1 || *bytes > 4) {
      return error("RP051", line.where,
                   "expected `N bytes NAME` or `NAME signed N bit variable`");
    }
    const Variable variable = {static_cast<std::uint32_t>(*bytes), name.where};
    const auto [at, fresh] = out_.variables.emplace(name.text, variable);
    if (fresh) return;
    errors_.error("RP052", name.where,
                  quoted_excerpt(name.text) + " stands in the list twice",
                  {{at->second.where, "it stands here"}});
  }

  // --- rungs -----------------------------------------------------------------

  struct Block {
    enum class Kind : std::uint8_t { Rung, Parallel, Series };
    Kind kind = Kind::Rung;
    bool empty = true;
    SourceRange where;
  };

  void rung(const Word& head) {
    const std::vector<Word> words = words_of(head);
    const bool good = words[0].text == "RUNG" && words.size() <= 2 &&
                      (words.size() == 1 || number_of(words[1].text));
    if (!good) {
      return error("RP051", head.where,
                   "expected `RUNG` and found " + quoted_excerpt(head.text));
    }
    steps_.clear();
    blocks_.assign(1, {Block::Kind::Rung, true, head.where});
    while (!blocks_.empty() && !lines_.at_end()) element(lines_.take());
    if (!blocks_.empty()) {
      return error("RP051", blocks_.back().where, "this has no `END`");
    }
    if (!steps_.empty()) {
      ladder::prepare(steps_);
      check_outputs();
    }
    out_.rungs.push_back({std::move(steps_), head.where});
    steps_ = {};
  }

  void element(const Word& line) {
    if (line.text.starts_with(";")) {
      return comment(part_of(line, 1, line.text.size()));
    }
    const std::vector<Word> words = words_of(line);
    const std::string_view name = words.front().text;
    if (name == "COMMENT") {
      comment(part_of(line, 7, line.text.size()));
    } else if (name == "END") {
      end(line);
    } else if (name == "PARALLEL") {
      begin_element(line.where);
      blocks_.push_back({Block::Kind::Parallel, true, line.where});
      steps_.push_back({.kind = Step::Kind::Open, .where = line.where});
    } else if (name == "SERIES") {
      if (blocks_.back().kind != Block::Kind::Parallel) {
        error("RP051", line.where, "`SERIES` stands in a `PARALLEL` only");
      }
      begin_element(line.where);
      blocks_.push_back({Block::Kind::Series, true, line.where});
    } else {
      leaf(words, line.where);
    }
  }

  // In a PARALLEL each element is a branch.
  void begin_element(SourceRange where) {
    Block& block = blocks_.back();
    if (block.kind == Block::Kind::Parallel && !block.empty) {
      steps_.push_back({.kind = Step::Kind::Next, .where = where});
    }
    block.empty = false;
  }

  void end(const Word& line) {
    const Block block = blocks_.back();
    blocks_.pop_back();
    if (block.kind == Block::Kind::Rung) return;
    if (block.empty) {
      error("RP051", block.where, "there is no element between this and `END`");
    }
    if (block.kind != Block::Kind::Parallel) return;
    steps_.push_back({.kind = Step::Kind::Close, .where = line.where});
  }

  void leaf(const std::vector<Word>& words, SourceRange where) {
    begin_element(where);
    const InstructionKind* const kind = find_instruction(words.front().text);
    if (kind == nullptr) {
      return error("RP087", words.front().where,
                   "the element " + quoted_excerpt(words.front().text) +
                       " is not supported");
    }
    const std::size_t count = words.size() - 1;
    if (count < kind->fewest || count > kind->most) {
      return error("RP054", where,
                   quoted_excerpt(kind->name) + " has " +
                       std::to_string(kind->fewest) + " to " +
                       std::to_string(kind->most) + " operands, not " +
                       std::to_string(count));
    }
    steps_.push_back(
        {.effect = kind->effect,
         .instruction = static_cast<std::uint32_t>(out_.instructions.size()),
         .where = where});
    out_.instructions.push_back(
        {kind, {words.begin() + 1, words.end()}, where});
  }

  // The forks of the tool differ about the power behind branches that end in
  // coils: what goes in, or the OR of what comes out.
  void check_outputs() {
    for (const Step& step : steps_) {
      const bool branches = step.kind == Step::Kind::Close;
      if (branches && step.effect == Effect::Output && step.needed) {
        error("RP088", step.where,
              "an element stands behind branches with coils: the versions of "
              "LDmicro do not agree about the power there");
      }
    }
  }

  // --- comments --------------------------------------------------------------

  // `\r\n`, as four letters, separates the lines of one.
  void comment(const Word& text) {
    ast_.comments.push_back({text.text, text.where});
    for (std::size_t at = 0; at < text.text.size();) {
      const std::size_t end =
          std::min(text.text.find("\\r\\n", at), text.text.size());
      annotation(part_of(text, at, end));
      at = end + 4;
    }
  }

  void annotation(const Word& line) {
    std::size_t begin = line.text.starts_with("//") ? 2 : 0;
    if (!line.text.substr(begin).starts_with("@")) return;
    const Word text = part_of(line, begin + 1, line.text.size());
    if (words_of(text).empty() || words_of(text).front().text == "language") {
      return;
    }
    ast_.annotations.push_back({text.text, text.where});
  }

  Lines lines_;
  Ast& ast_;
  ErrorLimit& errors_;
  ProgramText out_;
  std::vector<Step> steps_;
  std::vector<Block> blocks_;
};

}  // namespace

ProgramText read_program_text(std::string_view text, Ast& ast,
                              ErrorLimit& errors) {
  return Parser(text, ast, errors).run();
}

}  // namespace rung::ldmicro
