#include "reports/json_parts.h"

#include <cmath>

namespace rung {

std::string_view to_string(CellRole role) {
  switch (role) {
    case CellRole::Input:
      return "input";
    case CellRole::Output:
      return "output";
    case CellRole::Memory:
      return "memory";
  }
  return "";
}

Json json_of(const Program& program, const Trace& trace,
             const std::vector<CellId>& cells) {
  Json signals = Json::array();
  for (const CellId id : cells) {
    const Cell& cell = program.cells[id];
    signals.push_back({{"name", cell.name}, {"kind", to_string(cell.role)}});
  }
  Json steps = Json::array();
  for (const Trace::Step& step : trace.steps) {
    Json values = Json::object();
    for (const CellId id : cells) {
      values.push_back({program.cells[id].name, step.values[id.index()]});
    }
    Json one = {{"scan", step.scan}, {"dt_ms", step.dt_ms}};
    if (step.repeat > 1) one["repeat"] = step.repeat;
    if (step.changes) one["changes"] = true;
    one["values"] = std::move(values);
    steps.push_back(std::move(one));
  }
  Json json = {{"signals", std::move(signals)}, {"steps", std::move(steps)}};
  if (trace.loop) json["loop"] = *trace.loop;
  return json;
}

Json json_of(const Certificate& certificate) {
  Json json = {{"k", certificate.k},
               {"lemmas", certificate.lemmas},
               {"checked_by", certificate.checked_by},
               {"smtlib", nullptr}};
  if (!certificate.conditions.empty()) {
    json["conditions"] = certificate.conditions;
  }
  if (!certificate.ways.empty()) json["ways"] = certificate.ways;
  if (certificate.reused) json["reused"] = true;
  if (!certificate.smtlib_path.empty()) {
    json["smtlib"] = certificate.smtlib_path;
  }
  return json;
}

double rounded_ms(double milliseconds) {
  return std::round(milliseconds * 1000.0) / 1000.0;
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string dump_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rung
