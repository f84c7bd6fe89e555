#include "reports/html/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/html/ladders.h"
#include "reports/html/run_states.h"
#include "reports/ladder/svg.h"
#include "reports/markup.h"
#include "reports/scan_table.h"

namespace rung {
namespace {

std::string header(const ScanGrid& grid, bool has_remarks) {
  std::string out = fmt::format(
      "<thead><tr><th scope=\"col\">{}</th><th scope=\"col\">{}</th>",
      grid.lines.front().scan, grid.lines.front().time);
  for (const std::vector<std::string>& column : grid.columns) {
    out += fmt::format("<th scope=\"col\">{}</th>", markup(column.front()));
  }
  if (has_remarks) out += "<th scope=\"col\">remark</th>";
  return out + "</tr></thead>\n";
}

/// The table of one run.
class TableWriter {
 public:
  TableWriter(const HtmlRun& run, const ScanGrid& grid)
      : run_(run), grid_(grid) {
    has_remarks_ = !run.end.empty() ||
                   std::any_of(grid.lines.begin(), grid.lines.end(),
                               [](const auto& l) { return !l.remark.empty(); });
  }

  std::string write() const {
    std::string out =
        "<div class=\"scroll\" role=\"group\" aria-label=\"scan table\" "
        "tabindex=\"0\">\n<table class=\"scans\">\n" +
        header(grid_, has_remarks_) + "<tbody>\n";
    for (std::size_t row = 1; row < grid_.lines.size(); ++row) {
      const ScanGrid::Line& line = grid_.lines[row];
      out += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>", line.scan,
                         line.time);
      for (std::size_t i = 0; i < grid_.columns.size(); ++i) {
        out += cell(i, row);
      }
      if (has_remarks_) out += remark(row);
      out += "</tr>\n";
    }
    return out + "</tbody>\n</table>\n</div>\n";
  }

 private:
  bool is_last(std::size_t row) const { return row + 1 == grid_.lines.size(); }

  std::string cell(std::size_t column, std::size_t row) const {
    const std::string& text = grid_.columns[column][row];
    const bool differs =
        is_last(row) && std::find(run_.differs.begin(), run_.differs.end(),
                                  run_.signals[column]) != run_.differs.end();
    if (differs) return fmt::format("<td class=\"differs\">≠ {}</td>", text);
    if (!text.ends_with('*')) return fmt::format("<td>{}</td>", text);
    return fmt::format("<td class=\"changed\">{}</td>", text);
  }

  std::string remark(std::size_t row) const {
    std::string text = grid_.lines[row].remark;
    const bool ends = is_last(row) && !run_.end.empty();
    if (ends) {
      text = text.empty() ? std::string(run_.end)
                          : fmt::format("{}; {}", run_.end, text);
    }
    return fmt::format("<td class=\"remark{}\">{}</td>",
                       ends && run_.ends_badly ? " bad" : "", text);
  }

  const HtmlRun& run_;
  const ScanGrid& grid_;
  bool has_remarks_ = false;
};

/// A rung in the run's last scan; only its frame where the script draws it.
std::string figure(const HtmlRun& run, const RungStates& rung,
                   Locator& locator) {
  const std::uint64_t scan = run.trace.steps.back().scan;
  const Rung& source = run.program.rungs[rung.rung];
  const std::string name = rung_place(run.sources, source, locator);
  const RungState& last = rung.states.back();
  const std::string label =
      fmt::format("rung {} at the end of scan {}: {} = {}", name, scan,
                  run.program.cells[source.target].name, last.target);
  return fmt::format(
      "<figure data-rung=\"{0}\" data-name=\"{1}\">\n"
      "<figcaption><a href=\"#{2}-rung-{3}\">{1}</a>"
      "<span class=\"when\"> in scan {4}</span>: "
      "<code>{5}</code></figcaption>\n"
      "<div class=\"scroll\" role=\"group\" aria-label=\"rung {1}\" "
      "tabindex=\"0\">\n{6}</div>\n</figure>\n",
      rung.rung.index(), markup(name), run.file_id, rung.rung.index() + 1, scan,
      rung_caption(run.sources, source),
      run.is_drawn ? draw_rung_svg(rung.drawn, &last, label) : "");
}

/// Rungs of different files stand beside each other.
std::string figures(const HtmlRun& run, const std::vector<RungStates>& rungs,
                    Locator& locator) {
  if (rungs.empty()) return {};
  std::string out = "<div class=\"rungs\">\n<div>\n";
  FileId file = run.program.rungs[rungs.front().rung].where.file;
  for (const RungStates& rung : rungs) {
    const FileId here = run.program.rungs[rung.rung].where.file;
    if (here != file) out += "</div>\n<div>\n";
    file = here;
    out += figure(run, rung, locator);
  }
  return out + "</div>\n</div>\n";
}

}  // namespace

std::string write_html(const HtmlRun& run, Locator& locator) {
  const Trace lines = scan_lines(run.trace, run.signals);
  const std::vector<RungStates> rungs = states_of(run, lines);
  const ScanGrid grid = scan_grid(run.program, run.trace, run.signals);
  std::string out = "<div class=\"run\">\n" + TableWriter(run, grid).write() +
                    figures(run, rungs, locator);
  if (const std::string data = data_of(run, lines, rungs); !data.empty()) {
    out += "<script type=\"application/json\">" + data + "</script>\n";
  }
  return out + "</div>\n";
}

}  // namespace rung
