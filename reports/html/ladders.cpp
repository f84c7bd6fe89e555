#include "reports/html/ladders.h"

#include <fmt/format.h>

#include "reports/explain.h"
#include "reports/ladder/layout.h"
#include "reports/ladder/svg.h"
#include "reports/markup.h"

namespace rung {
namespace {

constexpr std::size_t kCaptionColumns = 100;
constexpr std::size_t kMaxOpen = 60;  // a longer ladder opens at a click

/// All rungs with their coils in one column, or those that are used.
struct Drawing {
  std::vector<RungId> ids;
  std::vector<LadderRung> rungs;
};

Drawing drawing_of(const Program& program, const std::vector<RungId>& used) {
  if (program.rungs.size() <= kMaxLadder) {
    Drawing all;
    for (const RungId id : ids_of(program.rungs)) all.ids.push_back(id);
    all.rungs = lay_out_ladder(program);
    return all;
  }
  Drawing some;
  for (const RungId id : used) {
    some.ids.push_back(id);
    some.rungs.push_back(lay_out_rung(program, program.rungs[id]));
  }
  return some;
}

}  // namespace

std::string rung_place(const SourceSet& sources, const Rung& rung,
                       Locator& locator) {
  return fmt::format("{}:{}", sources[rung.where.file].path(),
                     locator.of(rung.where).begin.line);
}

std::string rung_caption(const SourceSet& sources, const Rung& rung) {
  return markup(first_line(sources, rung), kCaptionColumns);
}

std::string write_ladder(const SourceSet& sources, const Program& program,
                         const std::string& file_id,
                         const std::vector<RungId>& used, Locator& locator) {
  const Drawing drawing = drawing_of(program, used);
  if (drawing.ids.empty()) return {};
  const std::size_t left_out = program.rungs.size() - drawing.ids.size();
  std::string out = fmt::format(
      "<details class=\"program\"{}>\n<summary>Ladder of {}</summary>\n",
      drawing.ids.size() <= kMaxOpen ? " open=\"open\"" : "",
      quantity(program.rungs.size(), "rung"));
  if (left_out > 0) {
    out += fmt::format(
        "<p>{} are not drawn here; `rungproof render` draws all.</p>\n",
        quantity(left_out, "rung"));
  }
  out += "<div class=\"rungs\">\n<div>\n";
  FileId file = program.rungs[drawing.ids.front()].where.file;
  for (std::size_t i = 0; i < drawing.ids.size(); ++i) {
    const Rung& rung = program.rungs[drawing.ids[i]];
    if (rung.where.file != file) out += "</div>\n<div>\n";
    file = rung.where.file;
    const std::string place = markup(rung_place(sources, rung, locator));
    out += fmt::format(
        "<figure id=\"{0}-rung-{1}\">\n<figcaption>{1} {2}: "
        "<code>{3}</code></figcaption>\n"
        "<div class=\"scroll\" role=\"group\" aria-label=\"rung {1} of the "
        "ladder\" tabindex=\"0\">\n{4}</div>\n</figure>\n",
        file_id, drawing.ids[i].index() + 1, place, rung_caption(sources, rung),
        draw_rung_svg(
            drawing.rungs[i], nullptr,
            fmt::format("ladder of rung {}", drawing.ids[i].index() + 1)));
  }
  return out + "</div>\n</div>\n</details>\n";
}

}  // namespace rung
