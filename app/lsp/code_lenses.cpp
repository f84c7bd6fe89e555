#include "app/lsp/features.h"

namespace rung::lsp {
namespace {

Json lens(const View& view, SourceRange where, std::string title,
          std::string_view command, Json arguments) {
  return {{"range", range_of(view, where)},
          {"command",
           {{"title", std::move(title)},
            {"command", command},
            {"arguments", std::move(arguments)}}}};
}

}  // namespace

Json code_lenses_of(const View& view) {
  Json all = Json::array();
  if (view.snapshot.program() == nullptr) return all;
  for (const Property& property :
       view.snapshot.loaded.report.properties.properties) {
    if (property.built_in || property.where.file != view.snapshot.file) {
      continue;
    }
    const Json arguments = {view.uri, property.name};
    if (all.empty()) {
      all.push_back(lens(view, property.where, "Prove all", "rungproof.prove",
                         {view.uri}));
    }
    if (view.running.count(property.name) != 0) {
      all.push_back(lens(view, property.where, "proving ...", "", {}));
      continue;
    }
    const std::string status = status_text(view, property.name);
    all.push_back(lens(view, property.where, status.empty() ? "Prove" : status,
                       "rungproof.prove", arguments));
    const ObligationResult* const worst =
        worst_of(results_of(view, property.name));
    if (worst != nullptr && worst->verdict == Verdict::Violated) {
      all.push_back(lens(view, property.where, "Show counterexample",
                         "rungproof.showCounterexample", arguments));
    }
  }
  return all;
}

}  // namespace rung::lsp
