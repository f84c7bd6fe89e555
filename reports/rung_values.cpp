#include "reports/rung_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/execute.h"
#include "reports/frame.h"
#include "reports/unicode.h"

namespace rung {
namespace {

// Executing this many rungs takes a second or so.
constexpr std::uint64_t kMaxExecutedRungs = 20'000'000;
// Longer rungs are not drawn: nobody reads values under them.
constexpr std::uint32_t kMaxLines = 12;
constexpr std::size_t kMaxLineBytes = 4 * kFrameWidth;

/// A value and the byte of the source that it belongs under.
struct Note {
  std::uint32_t offset = 0;
  std::uint32_t length = 1;
  std::string text;
};

/// Executes the trace's inputs; false when that would take too long.
bool run(const Program& program, const Trace& trace, Simulator& simulator,
         const StepVisitor& at_step) {
  std::uint64_t affordable = kMaxExecutedRungs / (program.rungs.size() + 1);
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const Trace::Step& step = trace.steps[i];
    if (step.values.size() != program.cells.size()) return false;
    for (const CellId id : ids_of(program.cells)) {
      if (program.cells[id].role == CellRole::Input) {
        simulator.set_input(id, step.values[id.index()]);
      }
    }
    if (!run_scans(simulator, step.repeat, step.dt_ms, affordable))
      return false;
    at_step(i, simulator);
  }
  return true;
}

std::vector<Note> notes_of(const Program& program, const Rung& rung,
                           const Simulator& simulator, const Trace& trace) {
  std::vector<Note> notes = {
      {rung.target_where.begin, rung.target_where.end - rung.target_where.begin,
       fmt::format("{}", trace.steps.back().values[rung.target.index()])}};
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = program.nodes[i];
    const bool is_operand = node.op == NodeOp::Read || node.op == NodeOp::Call;
    if (!is_operand || node.where.file != rung.where.file) continue;
    // Of a call only its name is marked: its operands have values of their own.
    const std::uint32_t length =
        node.op == NodeOp::Call ? 1 : node.where.end - node.where.begin;
    notes.push_back({node.where.begin, length,
                     simulator.node_executed(i)
                         ? fmt::format("{}", simulator.node_value(i))
                         : "-"});
  }
  std::sort(notes.begin(), notes.end(),
            [](const Note& a, const Note& b) { return a.offset < b.offset; });
  return notes;
}

/// The columns that the bytes of `line` before `at` take on a terminal.
std::size_t column_of(std::string_view line, std::size_t at) {
  return printable_width(line.substr(0, std::min(at, line.size())));
}

/// One source line and the values under it; nothing when no value is there.
void draw_line(std::string_view line, std::size_t line_begin,
               std::uint32_t number, const std::vector<Note>& notes,
               std::size_t gutter, const Painter& paint, std::string& out) {
  if (line.size() > kMaxLineBytes || printable_width(line) > kFrameWidth) {
    return;
  }
  std::string values;
  for (const Note& note : notes) {
    if (note.offset < line_begin || note.offset >= line_begin + line.size()) {
      continue;
    }
    const std::size_t at = note.offset - line_begin;
    const std::size_t column =
        column_of(line, at) +
        (note.length > note.text.size() ? (note.length - 1) / 2 : 0);
    if (values.size() < column) values.resize(column, ' ');
    if (!values.empty() && values.back() != ' ') values += ' ';
    values += note.text;
  }
  if (values.empty()) return;
  out += "  " + paint(Ink::Frame, fmt::format("{:>{}} |", number, gutter)) +
         " " + printable(line) + "\n";
  out += "  " + paint(Ink::Frame, std::string(gutter + 1, ' ') + "|") + " " +
         paint(Ink::Changed, values) + "\n";
}

}  // namespace

std::unique_ptr<Simulator> run_again(const Program& program,
                                     const Trace& trace) {
  auto simulator = std::make_unique<Simulator>(program);
  const StepVisitor nothing = [](std::size_t, const Simulator&) {};
  if (!run(program, trace, *simulator, nothing)) return nullptr;
  return simulator;
}

bool run_again(const Program& program, const Trace& trace,
               const StepVisitor& at_step) {
  Simulator simulator(program);
  return run(program, trace, simulator, at_step);
}

std::string draw_rung_values(const RungValues& values, const Painter& paint,
                             Locator& locator) {
  const Program& program = values.program;
  if (values.rungs.empty() || values.trace.steps.empty()) return {};
  const auto simulator = run_again(program, values.trace);
  if (!simulator) return {};
  const std::size_t count = std::min(values.rungs.size(), kMaxRungs);
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    const Rung& rung = program.rungs[values.rungs[i]];
    const std::vector<Note> notes =
        notes_of(program, rung, *simulator, values.trace);
    const SourceFile& source = values.sources[rung.where.file];
    const Place place = locator.of(rung.where);
    if (place.end.line - place.begin.line >= kMaxLines) continue;
    const std::size_t gutter = fmt::formatted_size("{}", source.line_count());
    for (std::uint32_t n = place.begin.line; n <= place.end.line; ++n) {
      const std::string_view line = source.line(n);
      const auto begin =
          static_cast<std::size_t>(line.data() - source.text().data());
      draw_line(line, begin, n, notes, gutter, paint, out);
    }
  }
  return out;
}

}  // namespace rung
