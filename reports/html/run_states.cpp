#include "reports/html/run_states.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/json_parts.h"
#include "reports/rung_values.h"
#include "reports/unicode.h"

namespace rung {
namespace {

bool is_symbol(const LadderShape& shape) {
  return shape.kind != LadderShape::Kind::Wire &&
         shape.kind != LadderShape::Kind::Riser;
}

/// A script's numbers have 53 bits: longer ones are texts.
Json number(std::int64_t value) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 53U;
  if (value > kLargest || value < -kLargest) return std::to_string(value);
  return value;
}

Json json_of(const Cell& cell, CellId id, const Trace& lines) {
  Json values = Json::array();
  for (const Trace::Step& step : lines.steps) {
    values.push_back(number(step.values[id.index()]));
  }
  return {{"name", printable(cell.name)},
          {"kind", to_string(cell.role)},
          {"word", cell.type == Type::Word},
          {"initial", number(cell.initial)},
          {"values", std::move(values)}};
}

/// A text a net, with a character a line.
Json power_of(const RungStates& rung) {
  std::vector<std::string> power(static_cast<std::size_t>(rung.drawn.nets));
  for (const RungState& state : rung.states) {
    const std::vector<bool> on = powered_nets(rung.drawn, state);
    for (std::size_t net = 0; net < power.size(); ++net) {
      power[net] += on[net] ? '1' : '0';
    }
  }
  return power;
}

Json values_of(const RungStates& rung) {
  Json all = Json::array();
  for (const LadderShape& shape : rung.drawn.shapes) {
    if (!is_symbol(shape)) continue;
    Json values = Json::array();
    for (const RungState& state : rung.states) {
      const auto value = shown_value(shape, state);
      values.push_back(value ? number(*value) : Json(nullptr));
    }
    all.push_back(std::move(values));
  }
  return all;
}

std::size_t width_of(const HtmlRun& run, const std::vector<RungStates>& rungs) {
  std::size_t width = run.signals.size();
  for (const RungStates& rung : rungs) {
    width +=
        rung.drawn.shapes.size() + static_cast<std::size_t>(rung.drawn.nets);
  }
  return width;
}

/// `</script>` and `]]>` cannot stand in it.
std::string island_text(const Json& json) {
  std::string out;
  for (const char c :
       json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&') {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::vector<RungStates> states_of(const HtmlRun& run, const Trace& lines) {
  std::vector<RungStates> rungs;
  const std::size_t count = std::min(run.rungs.size(), kMaxRungs);
  for (std::size_t i = 0; i < count; ++i) {
    const RungId id = run.rungs[i];
    rungs.push_back({id, lay_out_rung(run.program, run.program.rungs[id]), {}});
  }
  if (rungs.empty() || lines.steps.empty()) return {};
  std::size_t line = 0;
  const auto note = [&](std::size_t step, const Simulator& simulator) {
    if (line == lines.steps.size() ||
        run.trace.steps[step].scan != lines.steps[line].scan) {
      return;
    }
    ++line;
    for (RungStates& rung : rungs) {
      rung.states.push_back(
          state_of(run.program, run.program.rungs[rung.rung], simulator));
    }
  };
  const bool is_whole =
      run_again(run.program, run.trace, note) && line == lines.steps.size();
  return is_whole ? rungs : std::vector<RungStates>();
}

std::string data_of(const HtmlRun& run, const Trace& lines,
                    const std::vector<RungStates>& rungs) {
  if (width_of(run, rungs) * lines.steps.size() > kMaxValues) return {};
  Json scan = Json::array();
  Json repeat = Json::array();
  for (const Trace::Step& step : lines.steps) {
    scan.push_back(step.scan);
    repeat.push_back(step.repeat);
  }
  Json signals = Json::array();
  for (const CellId id : run.signals) {
    signals.push_back(json_of(run.program.cells[id], id, lines));
  }
  Json pictures = Json::array();
  for (const RungStates& rung : rungs) {
    pictures.push_back({{"rung", rung.rung.index()},
                        {"power", power_of(rung)},
                        {"values", values_of(rung)}});
  }
  Json json = {{"scan", std::move(scan)},
               {"repeat", std::move(repeat)},
               {"signals", std::move(signals)},
               {"rungs", std::move(pictures)}};
  if (lines.loop) json["loop"] = *lines.loop;
  return island_text(json);
}

}  // namespace rung
