#pragma once

#include <set>
#include <string>
#include <vector>

#include "analysis/result.h"
#include "app/lsp/outbox.h"
#include "app/lsp/snapshot.h"
#include "base/diagnostic.h"

namespace rung::lsp {

/// What a client is answered from: everything is of one version of the text,
/// so nothing old is ever shown as if it were so now.
struct View {
  const std::string& uri;
  const Snapshot& snapshot;
  const std::vector<Diagnostic>&
      findings;  // of rules; none where not known yet
  const std::vector<ObligationResult>& results;  // of what was proved
  const std::set<std::string>& running;          // properties, by name
  bool fixes_decided = false;  // each fix says whether it is proved
  Encoding encoding = Encoding::Utf16;

  const Property& property(std::uint32_t index) const {
    return snapshot.loaded.report.properties.properties[index];
  }
};

Json to_json(Position position);
Json range_of(const View& view, SourceRange where);
Json location_of(const View& view, SourceRange where);
Position position_in(const Json& json);  // throws what the library throws
/// The version of a document; `otherwise` where it says none.
std::int64_t version_in(const Json& document, std::int64_t otherwise);
std::uint32_t offset_in(const View& view, const Json& position);

/// The results of a property, of all its parts.
std::vector<const ObligationResult*> results_of(const View& view,
                                                const std::string& property);

/// The one to show: violated before unknown before bounded before vacuous
/// before proved. Null: there is none.
const ObligationResult* worst_of(
    const std::vector<const ObligationResult*>& results);

/// The run that violates, as people read it: a sentence, the scans, the rungs.
std::string counterexample_text(const View& view,
                                const ObligationResult& result);

/// "PROVED (induction, 0.03 s)"
std::string status_text(const ObligationResult& result, double milliseconds);
/// Of a property, all parts together; empty: nothing is known.
std::string status_text(const View& view, const std::string& property);

}  // namespace rung::lsp
