#include "reports/scan_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/unicode.h"

namespace rung {
namespace {

constexpr std::size_t kMaxWidth = 100;  // of the signals' columns
constexpr std::size_t kFewSignals = 16;

bool same_line(const Trace::Step& a, const Trace::Step& b,
               const std::vector<CellId>& signals) {
  return a.dt_ms == b.dt_ms && !a.changes && !b.changes &&
         std::all_of(signals.begin(), signals.end(), [&](CellId id) {
           return a.values[id.index()] == b.values[id.index()];
         });
}

using Line = ScanGrid::Line;

std::vector<Line> lines_of(const Trace& trace) {
  std::vector<Line> lines = {{"scan", "time", ""}, {"start", "", ""}};
  std::int64_t now = 0;
  for (const Trace::Step& step : trace.steps) {
    const auto lasted = static_cast<std::int64_t>(step.repeat) * step.dt_ms;
    now += lasted;
    Line line = {fmt::format("{}", step.scan), duration(now), ""};
    if (step.repeat > 1) {
      line.scan = fmt::format("{}-{}", step.scan - step.repeat + 1, step.scan);
      line.remark =
          fmt::format("x {} scans, {}", step.repeat, duration(lasted));
    }
    if (step.changes) line.remark += ", with changes in between";
    if (trace.loop && &step == &trace.steps[*trace.loop]) {
      line.remark += line.remark.empty() ? "" : "; ";
      line.remark += "from here on, again and again";
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The cells of one signal's column, header first.
std::vector<std::string> column_of(const Program& program, const Trace& trace,
                                   CellId id) {
  const Cell& cell = program.cells[id];
  const bool is_input = cell.role == CellRole::Input;
  std::vector<std::string> column = {
      printable(cell.name), is_input ? "-" : fmt::format("{}", cell.initial)};
  std::int64_t before = cell.initial;
  for (const Trace::Step& step : trace.steps) {
    const std::int64_t value = step.values[id.index()];
    column.push_back(fmt::format("{}{}", value, value == before ? "" : "*"));
    before = value;
  }
  return column;
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t own = printable_width(text);
  return own >= width ? text : std::string(width - own, ' ') + text;
}

std::size_t width_of(const std::vector<std::string>& column) {
  std::size_t width = 0;
  for (const std::string& cell : column) {
    width = std::max(width, printable_width(cell));
  }
  return width;
}

struct Column {
  std::vector<std::string> cells;
  std::size_t width = 0;
};

/// The columns [first, last) beside the lines' heads.
void draw_block(const std::vector<Line>& lines,
                const std::vector<Column>& columns, std::size_t first,
                std::size_t last, const std::string& indent,
                const Painter& paint, std::string& out) {
  std::size_t scan_width = 0;
  std::size_t time_width = 0;
  for (const Line& line : lines) {
    scan_width = std::max(scan_width, line.scan.size());
    time_width = std::max(time_width, line.time.size());
  }
  for (std::size_t row = 0; row < lines.size(); ++row) {
    const Line& line = lines[row];
    out += indent + padded(line.scan, scan_width) + "  " +
           padded(line.time, time_width) + " " + paint(Ink::Frame, "|");
    for (std::size_t i = first; i < last; ++i) {
      const std::string& cell = columns[i].cells[row];
      const std::string text = "  " + padded(cell, columns[i].width);
      const bool changed = row > 0 && cell.ends_with('*');
      out += changed ? paint(Ink::Changed, text) : text;
    }
    if (!line.remark.empty()) out += "   " + line.remark;
    out += '\n';
  }
}

}  // namespace

std::string duration(std::int64_t milliseconds) {
  if (milliseconds < 1000) return fmt::format("{} ms", milliseconds);
  if (milliseconds < 10LL * 60 * 1000) {
    const std::int64_t seconds = milliseconds / 1000;
    const std::int64_t rest = milliseconds % 1000;
    if (rest % 100 == 0) return fmt::format("{}.{} s", seconds, rest / 100);
    if (rest % 10 == 0) return fmt::format("{}.{:02} s", seconds, rest / 10);
    return fmt::format("{}.{:03} s", seconds, rest);
  }
  const std::int64_t minutes = milliseconds / 60000;
  const double seconds = static_cast<double>(milliseconds % 60000) / 1000.0;
  if (minutes < 60) return fmt::format("{} min {:.6g} s", minutes, seconds);
  return fmt::format("{} h {:02} min {:.6g} s", minutes / 60, minutes % 60,
                     seconds);
}

std::string draw_scan_table(const ScanTable& table, const Painter& paint) {
  ScanGrid grid = scan_grid(table.program, table.trace, table.signals);
  std::vector<Column> columns;
  for (std::vector<std::string>& cells : grid.columns) {
    const std::size_t width = width_of(cells);
    columns.push_back({std::move(cells), width});
  }
  std::string out;
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t last = first;
    std::size_t width = 0;
    while (last < columns.size() &&
           (last == first || width + columns[last].width + 2 <= kMaxWidth)) {
      width += columns[last++].width + 2;
    }
    if (first > 0) out += '\n';
    draw_block(grid.lines, columns, first, last, table.indent, paint, out);
    first = last;
  }
  return out;
}

Trace scan_lines(const Trace& trace, const std::vector<CellId>& signals) {
  Trace result;
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const Trace::Step& step = trace.steps[i];
    const bool loop = trace.loop == i;
    if (loop) result.loop = result.steps.size();
    const bool again = !loop && !result.steps.empty() &&
                       same_line(result.steps.back(), step, signals);
    if (!again) {
      result.steps.push_back(step);
      continue;
    }
    result.steps.back().scan = step.scan;
    result.steps.back().repeat += step.repeat;
  }
  return result;
}

ScanGrid scan_grid(const Program& program, const Trace& trace,
                   const std::vector<CellId>& signals) {
  const Trace shown = scan_lines(trace, signals);
  ScanGrid grid;
  grid.lines = lines_of(shown);
  for (const CellId id : signals) {
    grid.columns.push_back(column_of(program, shown, id));
  }
  return grid;
}

std::vector<CellId> relevant_signals(const Program& program, const Trace& trace,
                                     const std::vector<CellId>& cone,
                                     const std::vector<CellId>& named) {
  std::vector<CellId> shown;
  for (const CellId id : cone) {
    const bool is_named =
        std::find(named.begin(), named.end(), id) != named.end();
    const bool moves = program.cells[id].initial != 0 ||
                       std::any_of(trace.steps.begin(), trace.steps.end(),
                                   [id](const Trace::Step& step) {
                                     return step.values[id.index()] != 0;
                                   });
    if (cone.size() <= kFewSignals || is_named || moves) shown.push_back(id);
  }
  // Inputs first, then what the rungs make of them: cause before effect.
  std::stable_partition(shown.begin(), shown.end(), [&](CellId id) {
    return program.cells[id].role == CellRole::Input;
  });
  return shown;
}

}  // namespace rung
