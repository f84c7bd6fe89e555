#include "app/lsp/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "app/select.h"
#include "reports/cone.h"
#include "reports/explain.h"
#include "reports/rung_values.h"
#include "reports/scan_table.h"

namespace rung::lsp {
namespace {

/// The last one is worst.
constexpr std::array kOrder = {Verdict::Proved, Verdict::Vacuous,
                               Verdict::Bounded, Verdict::Unknown,
                               Verdict::Violated};

std::size_t badness(const ObligationResult& result) {
  return static_cast<std::size_t>(
      std::find(kOrder.begin(), kOrder.end(), result.verdict) - kOrder.begin());
}

std::string in_capitals(std::string_view word) {
  std::string out(word);
  for (char& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return out;
}

}  // namespace

Json to_json(Position position) {
  return {{"line", position.line}, {"character", position.column}};
}

Json range_of(const View& view, SourceRange where) {
  const TextDocument& text = view.snapshot.text;
  if (!where.has_value() || where.file != view.snapshot.file) where = {};
  return {{"start", to_json(text.position(where.begin, view.encoding))},
          {"end", to_json(text.position(where.end, view.encoding))}};
}

Json location_of(const View& view, SourceRange where) {
  return {{"uri", view.uri}, {"range", range_of(view, where)}};
}

namespace {

std::uint32_t number_in(const Json& json, const char* name) {
  // Throws at what is no natural number: 1e300 is in no integer's range.
  const auto number = json.at(name).get_ref<const Json::number_unsigned_t&>();
  return static_cast<std::uint32_t>(std::min<Json::number_unsigned_t>(
      number, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

Position position_in(const Json& json) {
  return {number_in(json, "line"), number_in(json, "character")};
}

std::int64_t version_in(const Json& document, std::int64_t otherwise) {
  const Json version = document.value("version", Json());
  return version.is_number_integer() ? version.get<std::int64_t>() : otherwise;
}

std::uint32_t offset_in(const View& view, const Json& position) {
  return view.snapshot.text.offset(position_in(position), view.encoding);
}

std::vector<const ObligationResult*> results_of(const View& view,
                                                const std::string& property) {
  std::vector<const ObligationResult*> found;
  for (const ObligationResult& result : view.results) {
    if (is_selected(result.obligation.name, property)) {
      found.push_back(&result);
    }
  }
  return found;
}

const ObligationResult* worst_of(
    const std::vector<const ObligationResult*>& results) {
  const auto worst = std::max_element(
      results.begin(), results.end(),
      [](const ObligationResult* a, const ObligationResult* b) {
        return badness(*a) < badness(*b);
      });
  return worst == results.end() ? nullptr : *worst;
}

std::string counterexample_text(const View& view,
                                const ObligationResult& result) {
  const FileReport& file = view.snapshot.loaded.report;
  const Cones cones(*file.program);
  std::string out =
      fmt::format("{}: {}\n{}\n", result.obligation.name,
                  result.obligation.text, explain(file, result, cones));
  if (!result.trace) return out;
  const Painter plain(false);
  const auto& formulas = formulas_of(file, result.obligation);
  const std::vector<CellId> named = cones.named(formulas);
  const std::vector<CellId> shown =
      relevant_signals(*file.program, *result.trace, cones.of(formulas), named);
  out += "\n" +
         draw_scan_table({*file.program, *result.trace, shown, "  "}, plain);
  Locator locator(view.snapshot.sources);
  const std::string rungs =
      draw_rung_values({view.snapshot.sources, *file.program, *result.trace,
                        cones.drivers(named)},
                       plain, locator);
  return rungs.empty() ? out : out + "\n" + rungs;
}

std::string status_text(const ObligationResult& result, double milliseconds) {
  std::string out = in_capitals(to_string(result.verdict));
  if (result.verdict == Verdict::Bounded) {
    out += fmt::format(" {} scans, no proof", result.scans);
  }
  if (result.verdict == Verdict::Unknown) out += ": " + result.reason;
  if (!result.engine.empty()) {
    out += fmt::format(" ({}, {:.2f} s)", result.engine, milliseconds / 1000);
  }
  return out;
}

std::string status_text(const View& view, const std::string& property) {
  const auto results = results_of(view, property);
  const ObligationResult* const worst = worst_of(results);
  if (worst == nullptr) return "";
  double milliseconds = 0;
  for (const ObligationResult* it : results) milliseconds += it->milliseconds;
  return status_text(*worst, milliseconds);
}

}  // namespace rung::lsp
