#include "reports/waves.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/explanation.h"
#include "reports/json_parts.h"
#include "reports/scan_table.h"
#include "reports/unicode.h"

namespace rung {
namespace {

/// A character a line: a level, `=` for a word, `.` for what it was before.
Json lane(const Program& program, const Trace& lines, CellId id) {
  const Cell& cell = program.cells[id];
  std::string wave;
  Json data = Json::array();
  for (std::size_t i = 0; i < lines.steps.size(); ++i) {
    const Trace::Step& step = lines.steps[i];
    const std::int64_t value = step.values[id.index()];
    const bool same = i > 0 && value == lines.steps[i - 1].values[id.index()];
    if (same) {
      wave += step.repeat > 1 ? '|' : '.';
    } else if (cell.type == Type::Bit) {
      wave += value != 0 ? '1' : '0';
    } else {
      wave += '=';
      data.push_back(fmt::format("{}", value));
    }
  }
  Json json = {{"name", printable(cell.name)}, {"wave", std::move(wave)}};
  if (!data.empty()) json["data"] = std::move(data);
  return json;
}

/// When each line ends.
Json clock(const Trace& lines) {
  Json ends = Json::array();
  std::int64_t now = 0;
  for (const Trace::Step& step : lines.steps) {
    now += static_cast<std::int64_t>(step.repeat) * step.dt_ms;
    ends.push_back(duration(now));
  }
  return {{"name", "time"},
          {"wave", std::string(lines.steps.size(), '=')},
          {"data", std::move(ends)}};
}

bool is_column(const std::string& name) {
  return name != "dt" && name != "repeat" &&
         name.find_first_of(",\r\n") == std::string::npos;
}

}  // namespace

std::string write_wavejson(const Program& program, const Trace& trace,
                           const std::vector<CellId>& signals,
                           const std::string& title) {
  const Trace lines = scan_lines(trace, signals);
  Json lanes = Json::array();
  lanes.push_back(clock(lines));
  for (const CellRole role :
       {CellRole::Input, CellRole::Output, CellRole::Memory}) {
    Json group = Json::array({std::string(to_string(role))});
    for (const CellId id : signals) {
      if (program.cells[id].role == role) {
        group.push_back(lane(program, lines, id));
      }
    }
    if (group.size() > 1) lanes.push_back(std::move(group));
  }
  return dump({{"signal", std::move(lanes)},
               {"head", {{"text", printable(title)}}},
               {"config", {{"hscale", 2}}}});
}

std::optional<std::string> write_stimulus(const Program& program,
                                          const Trace& trace) {
  const Stimulus stimulus = stimulus_of(program, trace);
  std::string out = "dt,repeat";
  for (const CellId id : stimulus.inputs) {
    const std::string& name = program.cells[id].name;
    if (!is_column(name)) return std::nullopt;
    out += fmt::format(",\"{}\"", name);
  }
  out += '\n';
  for (const StimulusStep& step : stimulus.steps) {
    out += fmt::format("{},{}", step.dt_ms, step.repeat);
    for (const std::int64_t value : step.inputs) {
      out += fmt::format(",{}", value);
    }
    out += '\n';
  }
  return out;
}

}  // namespace rung
