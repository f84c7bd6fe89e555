#include "reports/html/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/ladder/svg.h"
#include "reports/markup.h"
#include "reports/rung_values.h"
#include "reports/scan_table.h"

namespace rung {
namespace {

constexpr std::size_t kCaptionColumns = 100;

std::string header(const ScanGrid& grid, bool has_remarks) {
  std::string out = fmt::format(
      "<thead><tr><th scope=\"col\">{}</th><th scope=\"col\">{}</th>",
      grid.lines.front().scan, grid.lines.front().time);
  for (const std::vector<std::string>& column : grid.columns) {
    out += fmt::format("<th scope=\"col\">{}</th>", markup(column.front()));
  }
  if (has_remarks) out += "<th scope=\"col\">repeated</th>";
  return out + "</tr></thead>\n";
}

std::string table(const ScanGrid& grid) {
  const bool has_remarks =
      std::any_of(grid.lines.begin(), grid.lines.end(),
                  [](const auto& line) { return !line.remark.empty(); });
  std::string out =
      "<div class=\"scroll\" role=\"group\" aria-label=\"scan table\" "
      "tabindex=\"0\">\n<table class=\"scans\">\n" +
      header(grid, has_remarks) + "<tbody>\n";
  for (std::size_t row = 1; row < grid.lines.size(); ++row) {
    const ScanGrid::Line& line = grid.lines[row];
    out += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>", line.scan,
                       line.time);
    for (const std::vector<std::string>& column : grid.columns) {
      const bool changed = column[row].ends_with('*');
      out += fmt::format("<td{}>{}</td>", changed ? " class=\"changed\"" : "",
                         column[row]);
    }
    if (has_remarks) {
      out += fmt::format("<td class=\"remark\">{}</td>", line.remark);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

std::string figure(const HtmlRun& run, RungId id, const Simulator& simulator,
                   Locator& locator) {
  const Rung& rung = run.program.rungs[id];
  const RungState state = state_of(run.program, rung, simulator);
  const std::string where =
      fmt::format("{}:{}", run.sources[rung.where.file].path(),
                  locator.of(rung.where).begin.line);
  const std::string label = fmt::format(
      "rung {} at the end of scan {}: {} = {}", where, simulator.scans(),
      run.program.cells[rung.target].name, state.target);
  return fmt::format(
      "<figure>\n<figcaption>{0} in scan {1}: "
      "<code>{2}</code></figcaption>\n"
      "<div class=\"scroll\" role=\"group\" aria-label=\"rung {0}\" "
      "tabindex=\"0\">\n{3}</div>\n</figure>\n",
      markup(where), simulator.scans(),
      markup(first_line(run.sources, rung), kCaptionColumns),
      draw_rung_svg(lay_out_rung(run.program, rung), &state, label));
}

std::string figures(const HtmlRun& run, Locator& locator) {
  if (run.rungs.empty()) return {};
  const auto simulator = run_again(run.program, run.trace);
  if (!simulator) return {};
  std::string out = "<div>\n";
  const std::size_t count = std::min(run.rungs.size(), kMaxRungs);
  for (std::size_t i = 0; i < count; ++i) {
    out += figure(run, run.rungs[i], *simulator, locator);
  }
  return out + "</div>\n";
}

}  // namespace

std::string write_html(const HtmlRun& run, Locator& locator) {
  return "<div class=\"run\">\n" +
         table(scan_grid(run.program, run.trace, run.signals)) +
         figures(run, locator) + "</div>\n";
}

}  // namespace rung
