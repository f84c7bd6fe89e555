#include "backend/plclib/loop.h"

#include <algorithm>
#include <utility>

#include "backend/plclib/bits.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/infix.h"

namespace rung::backend {
namespace {

constexpr InfixSpelling kCpp = {.and_sign = " && ",
                                .or_sign = " || ",
                                .xor_sign = " ^ ",
                                .not_sign = "!",
                                .equal = " == ",
                                .not_equal = " != ",
                                .true_word = "true",
                                .false_word = "false"};

class LoopWriter {
 public:
  LoopWriter(const Unit& unit, const Wiring& wiring,
             const RungComments& comments, std::string_view stack)
      : unit_(unit),
        values_(unit),
        wiring_(wiring),
        comments_(comments),
        stack_(stack) {
    result_.declared.resize(unit.variables.size(), false);
    for (const CellId id : ids_of(unit.variables)) {
      if (!is_pin(id)) continue;
      Variable& variable = values_.variables[id];
      variable.name =
          (variable.type == Type::Word ? "analogRead(" : "digitalRead(") +
          variable.name + ')';
    }
  }

  LoopText run() {
    for (const Sample& sample : wiring_.samples) this->sample(sample);
    never_written();
    for (std::size_t at = 0; at < unit_.statements.size();) {
      open_rung(unit_.statements[at].rung.index());
      const std::size_t end = at + guarded_run(unit_, at);
      guarded(at, end);
      at = end;
    }
    last_comments();
    return std::move(result_);
  }

 private:
  bool is_pin(CellId id) const {
    return id.index() < wiring_.pins.size() &&
           !wiring_.pins[id.index()].empty();
  }
  const std::string& name_of(CellId id) {
    result_.declared[id.index()] = true;
    return unit_.variables[id].name;
  }

  void line(const std::string& text) {
    result_.text += inside_ ? "    " : "  ";
    result_.text += text + '\n';
    ++result_.statements;
  }
  void comment(const std::string& text) {
    result_.text += "  " + line_comment(text) + '\n';
  }

  void paragraph() {
    if (!result_.text.empty()) result_.text += '\n';
  }

  /// A rung is a paragraph, with the comments up to it.
  void open_rung(std::uint32_t rung) {
    if (rung < next_rung_) return;
    paragraph();
    comments_until(rung + 1);
  }

  void comments_until(std::size_t end) {
    for (; next_rung_ < std::min(end, comments_.before.size()); ++next_rung_) {
      for (const std::string& each : comments_.before[next_rung_]) {
        comment(each);
      }
    }
  }

  void last_comments() {
    if (!comments_.at_end.empty()) paragraph();
    comments_until(comments_.before.size());
    for (const std::string& each : comments_.at_end) comment(each);
  }

  void sample(const Sample& sample) {
    const bool word = unit_.variables[sample.input].type == Type::Word;
    if (!sample.image.has_value()) {
      return line((word ? "inAnalog(" : "in(") + name_of(sample.input) + ");");
    }
    line(name_of(sample.image) + (word ? " = analogRead(" : " = digitalRead(") +
         name_of(sample.input) + ");");
  }

  // Else the sketch might not name it at all.
  void never_written() {
    std::vector<bool> written(unit_.variables.size(), false);
    for (const Statement& item : unit_.statements) {
      if (item.target.has_value()) written[item.target.index()] = true;
    }
    for (const CellId id : ids_of(unit_.variables)) {
      const Variable& variable = unit_.variables[id];
      if (variable.role != CellRole::Output || written[id.index()]) continue;
      line("digitalWrite(" + name_of(id) +
           (variable.initial != 0 ? ", HIGH);" : ", LOW);"));
    }
  }

  // --- statements ------------------------------------------------------------

  void guarded(std::size_t at, std::size_t end) {
    const Terms& guard = unit_.statements[at].guard;
    if (!guard.empty()) {
      line("if (" + infix(guard) + ") {");
      inside_ = true;
      known_ = {};
    }
    for (; at < end; ++at) {
      const Statement* const next =
          at + 1 < end ? &unit_.statements[at + 1] : following(at, guard);
      statement(unit_.statements[at], next);
    }
    if (guard.empty()) return;
    inside_ = false;
    known_ = {};
    line("}");
  }

  /// The statement behind an unguarded one, if it is none either.
  const Statement* following(std::size_t at, const Terms& guard) const {
    if (!guard.empty() || at + 1 >= unit_.statements.size()) return nullptr;
    const Statement& next = unit_.statements[at + 1];
    return next.guard.empty() ? &next : nullptr;
  }

  std::string infix(const Terms& terms) {
    for (const Term& term : terms) {
      if (term.op == NodeOp::Read) name_of(term.cell);
    }
    std::string text;
    append_infix(text, values_, terms, kCpp);
    return text;
  }

  void statement(const Statement& item, const Statement* next) {
    if (item.target.has_value()) return assignment(item);
    load(item.arguments[0].value);
    const Argument& input = item.arguments[0];
    line(std::string(unit_.variables[input.pin].pin) + '(' +
         unit_.blocks[item.block].name + ", " + std::to_string(*item.preset) +
         ");");
    known_ = {};
    const CellId output = output_of(item.block);
    if (!output.has_value()) return;
    if (next != nullptr && begins_with(*next, output)) {
      known_ = output;
    } else {
      out(output);
    }
  }

  void assignment(const Statement& item) {
    if (unit_.variables[item.target].type == Type::Bit &&
        is_bit_list(item.value, !inside_)) {
      load(item.value);
      return out(item.target);
    }
    const std::string value = infix(item.value);
    const std::string& name = name_of(item.target);
    if (is_pin(item.target)) {
      line("digitalWrite(" + name + ", " + value + ");");
    } else {
      line(name + " = " + value + ';');
    }
    if (known_ == item.target) known_ = {};
  }

  void out(CellId target) {
    line("out(" + name_of(target) + ");");
    known_ = target;
  }

  void load(const Terms& terms) {
    for (const BitCall& call : bit_calls(terms, known_)) {
      if (call.cell.has_value()) {
        line(std::string(call.name) + '(' + name_of(call.cell) + ");");
      } else {
        result_.stack = stack_;
        line(std::string(stack_) + '.' + std::string(call.name) + "();");
      }
    }
  }

  // --- what a timer gives ----------------------------------------------------

  CellId output_of(BlockId block) {
    if (outputs_.empty()) {
      outputs_.resize(unit_.blocks.size());
      for (const CellId id : ids_of(unit_.variables)) {
        const Variable& variable = unit_.variables[id];
        if (!variable.block.has_value() || variable.pin != "Q") continue;
        outputs_[variable.block.index()] = id;
      }
    }
    return outputs_[block.index()];
  }

  /// Does nothing but the begin of `next` read the result? Then it stays in
  /// the accumulator.
  bool begins_with(const Statement& next, CellId output) const {
    if (output.index() >= wiring_.reads.size() ||
        wiring_.reads[output.index()] != 1) {
      return false;
    }
    const bool call = !next.target.has_value();
    const Terms& value = call ? next.arguments[0].value : next.value;
    if (!reads(value, output)) return false;
    const bool listed =
        (call || unit_.variables[next.target].type == Type::Bit) &&
        is_bit_list(value, !inside_);
    if (!listed) return false;
    for (const BitCall& each : bit_calls(value, output)) {
      if (each.cell == output) return false;
    }
    return true;
  }

  const Unit& unit_;
  Unit values_;  // with names as they are read: `digitalRead(Q0)`
  const Wiring& wiring_;
  const RungComments& comments_;
  std::string_view stack_;
  LoopText result_;
  std::vector<CellId> outputs_;  // by block
  CellId known_;                 // what the accumulator holds
  bool inside_ = false;          // an `if`
  std::size_t next_rung_ = 0;
};

}  // namespace

std::string line_comment(std::string_view text) {
  std::string line = "// ";
  // The reader takes `//@` for a property line.
  line += text;
  if (line.back() == '\\') line += " .";
  return line;
}

LoopText write_loop(const Unit& unit, const Wiring& wiring,
                    const RungComments& comments, std::string_view stack) {
  return LoopWriter(unit, wiring, comments, stack).run();
}

}  // namespace rung::backend
