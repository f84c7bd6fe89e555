#include "backend/st/write.h"

#include "backend/unit/elements_iec.h"
#include "backend/unit/iec_text.h"
#include "backend/unit/infix.h"
#include "backend/unit/lower_iec.h"

namespace rung {
namespace backend {
namespace {

class StWriter {
 public:
  StWriter(const Unit& unit, const RungComments& comments)
      : unit_(unit), comments_(comments) {}

  std::string run() {
    for (std::size_t at = 0; at < unit_.statements.size();) {
      open_rung(unit_.statements[at].rung);
      const std::size_t count = guarded_run(unit_, at);
      const Terms& guard = unit_.statements[at].guard;
      if (!guard.empty()) {
        text_ += "  IF ";
        append_infix(text_, unit_, guard, {});
        text_ += " THEN\n";
      }
      for (const std::size_t end = at + count; at < end; ++at) {
        text_ += guard.empty() ? "  " : "    ";
        statement(unit_.statements[at]);
      }
      if (!guard.empty()) text_ += "  END_IF;\n";
    }
    open_rung(RungId(static_cast<std::uint32_t>(comments_.before.size())));
    for (const std::string& line : comments_.at_end) comment(line);
    return std::move(text_);
  }

 private:
  void comment(const std::string& line) {
    text_ += "  " + iec_comment(line) + '\n';
  }

  /// The comments of the rungs up to this one.
  void open_rung(RungId rung) {
    for (; next_rung_ <= rung.index() && next_rung_ < comments_.before.size();
         ++next_rung_) {
      const auto& lines = comments_.before[next_rung_];
      if (!lines.empty() && next_rung_ != 0) text_ += '\n';
      for (const std::string& line : lines) comment(line);
    }
  }

  void statement(const Statement& statement) {
    if (statement.target.has_value()) {
      text_ += unit_.variables[statement.target].name + " := ";
      append_infix(text_, unit_, statement.value, {});
    } else {
      text_ += unit_.blocks[statement.block].name + '(';
      std::string_view between;
      for (const Argument& argument : statement.arguments) {
        text_ += between;
        text_ += unit_.variables[argument.pin].pin;
        text_ += " := ";
        append_infix(text_, unit_, argument.value, {});
        between = ", ";
      }
      if (statement.preset) {
        text_ += between;
        text_ += "PT := " + iec_time(*statement.preset);
      }
      text_ += ')';
    }
    text_ += ";\n";
  }

  const Unit& unit_;
  const RungComments& comments_;
  std::string text_;
  std::size_t next_rung_ = 0;
};

}  // namespace

std::string write_st(const Unit& unit, const RungComments& comments,
                     const PropertyLines& properties) {
  return iec_head(unit, properties) + '\n' + StWriter(unit, comments).run() +
         "END_PROGRAM\n";
}

}  // namespace backend

std::optional<backend::Written> lower_to_st(const Program& program,
                                            const SourceSet& sources,
                                            DiagnosticSink& sink) {
  return backend::lower_to_iec(program, sources, "structured text",
                               backend::write_st, sink);
}

}  // namespace rung
