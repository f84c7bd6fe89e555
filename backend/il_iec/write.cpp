#include "backend/il_iec/write.h"

#include <string_view>
#include <vector>

#include "backend/unit/iec_text.h"
#include "backend/unit/lower_iec.h"
#include "backend/unit/names.h"

namespace rung {
namespace backend {
namespace {

bool is_leaf(const Term& term) {
  return term.op == NodeOp::Constant || term.op == NodeOp::Read;
}

class IlWriter {
 public:
  IlWriter(const Unit& unit, const RungComments& comments)
      : unit_(unit), comments_(comments), names_(unit.names) {}

  std::string run() {
    for (std::size_t at = 0; at < unit_.statements.size();) {
      open_rung(unit_.statements[at].rung);
      const std::size_t count = guarded_run(unit_, at);
      const Terms& guard = unit_.statements[at].guard;
      const std::string label =
          guard.empty() ? std::string() : names_.make("skip");
      if (!guard.empty()) jump_unless(guard, label);
      for (const std::size_t end = at + count; at < end; ++at) {
        statement(unit_.statements[at]);
      }
      if (!guard.empty()) text_ += label + ":\n";
    }
    open_rung(RungId(static_cast<std::uint32_t>(comments_.before.size())));
    for (const std::string& line : comments_.at_end) comment(line);
    return std::move(text_);
  }

 private:
  void comment(const std::string& line) {
    text_ += "  " + iec_comment(line) + '\n';
  }

  /// A blank line and the comments of the rungs up to this one.
  void open_rung(RungId rung) {
    if (next_rung_ > rung.index()) return;
    text_ += '\n';
    for (; next_rung_ <= rung.index() && next_rung_ < comments_.before.size();
         ++next_rung_) {
      for (const std::string& line : comments_.before[next_rung_]) {
        comment(line);
      }
    }
    next_rung_ = rung.index() + 1;
  }

  void line(std::string_view code, std::string_view operand = {}) {
    text_ += "  ";
    text_ += code;
    if (!operand.empty()) {
      text_.append(code.size() < 5 ? 5 - code.size() : 1, ' ');
      text_ += operand;
    }
    text_ += '\n';
  }

  void jump_unless(Terms guard, const std::string& label) {
    const bool negated = guard.back().op == NodeOp::Not && guard.size() == 2;
    if (negated) guard.pop_back();
    load(guard);
    line(negated ? "JMPC" : "JMPCN", label);
  }

  void statement(const Statement& statement) {
    if (statement.target.has_value()) {
      load(statement.value);
      return line("ST", unit_.variables[statement.target].name);
    }
    const std::string& block = unit_.blocks[statement.block].name;
    std::string operands;
    const auto give = [&](std::string_view pin, const std::string& value) {
      operands += operands.empty() ? "" : ", ";
      operands += std::string(pin) + " := " + value;
    };
    // What is no plain operand goes to the pin first.
    for (const Argument& argument : statement.arguments) {
      const Variable& pin = unit_.variables[argument.pin];
      if (argument.value.size() == 1 && is_leaf(argument.value[0])) {
        give(pin.pin, operand(argument.value[0]));
      } else {
        load(argument.value);
        line("ST", pin.name);
      }
    }
    if (statement.preset) give("PT", iec_time(*statement.preset));
    line("CAL", block + (operands.empty() ? "" : "(" + operands + ")"));
  }

  std::string operand(const Term& term) const {
    if (term.op == NodeOp::Read) return unit_.variables[term.cell].name;
    if (term.type == Type::Bit) return term.value != 0 ? "TRUE" : "FALSE";
    return std::to_string(term.value);
  }

  /// The expression becomes the current result. No recursion: what is still
  /// to be written stands on a stack.
  void load(const Terms& terms) {
    terms_ = &terms;
    todo_ = {{Todo::Load, terms.size() - 1}};
    while (!todo_.empty()) {
      const Todo next = todo_.back();
      todo_.pop_back();
      switch (next.kind) {
        case Todo::Load:
          load_term(next.at);
          break;
        case Todo::Join:
          join(next.at);
          break;
        case Todo::Invert:
          line("NOT");
          break;
        case Todo::Close:
          line(")");
          break;
      }
    }
  }

  void load_term(std::size_t at) {
    const Term& term = (*terms_)[at];
    if (is_leaf(term)) return line("LD", operand(term));
    if (term.op == NodeOp::Negate) {
      line("LD", "0");
      return join(at);
    }
    if (term.op == NodeOp::Not) {
      const Term& of = (*terms_)[at - 1];
      if (is_leaf(of)) return line("LDN", operand(of));
      todo_.push_back({Todo::Invert, at});
      todo_.push_back({Todo::Load, at - 1});
      return;
    }
    todo_.push_back({Todo::Join, at});
    todo_.push_back({Todo::Load, at - 1 - (*terms_)[at - 1].size});
  }

  /// The operator at `at` with its last operand.
  void join(std::size_t at) {
    std::string code(iec_function((*terms_)[at].op));
    const Term& right = (*terms_)[at - 1];
    if (is_leaf(right)) return line(code, operand(right));
    const bool logic = code == "AND" || code == "OR" || code == "XOR";
    if (logic && right.op == NodeOp::Not && is_leaf((*terms_)[at - 2])) {
      return line(code + "N", operand((*terms_)[at - 2]));
    }
    line(code + "(");
    todo_.push_back({Todo::Close, at});
    todo_.push_back({Todo::Load, at - 1});
  }

  struct Todo {
    enum Kind : std::uint8_t { Load, Join, Invert, Close };
    Kind kind = Load;
    std::size_t at = 0;
  };

  const Unit& unit_;
  const RungComments& comments_;
  NameTable names_;  // for labels
  std::string text_;
  std::size_t next_rung_ = 0;
  const Terms* terms_ = nullptr;
  std::vector<Todo> todo_;
};

}  // namespace

std::string write_il_iec(const Unit& unit, const RungComments& comments,
                         const PropertyLines& properties) {
  return iec_head(unit, properties) + IlWriter(unit, comments).run() +
         "END_PROGRAM\n";
}

}  // namespace backend

std::optional<backend::Written> lower_to_il_iec(const Program& program,
                                                const SourceSet& sources,
                                                DiagnosticSink& sink) {
  return backend::lower_to_iec(program, sources, "instruction lists",
                               backend::write_il_iec, sink);
}

}  // namespace rung
