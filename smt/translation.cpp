#include "smt/translation.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace rung {
namespace {

using Names = std::unordered_map<std::string_view, std::string_view>;

class Matching {
 public:
  Matching(Program& source, Program& written, const TranslationClaim& claim)
      : source_(source), written_(written) {
    for (const auto& [from, to] : claim.signals) to_.emplace(from, to);
    for (const CellId id : ids_of(written.cells)) {
      by_name_.emplace(written.cells[id].name, id);
    }
    written_by_rung_.resize(source.cells.size(), false);
    for (const Rung& rung : source.rungs) {
      written_by_rung_[rung.target.index()] = true;
    }
  }

  /// The first declaration that is lost or changed; empty: none.
  std::string match(EquivalenceOptions& options) {
    if (source_.scan.min_ms != written_.scan.min_ms ||
        source_.scan.max_ms != written_.scan.max_ms) {
      return "the scan interval differs";
    }
    for (const CellId id : ids_of(source_.cells)) {
      std::string lost = match_cell(id, options);
      if (!lost.empty()) return lost;
    }
    for (const CellId id : ids_of(written_.cells)) {
      const Cell& cell = written_.cells[id];
      if (cell.role == CellRole::Memory || taken_.contains(id)) continue;
      return "`" + cell.name + "` is new";
    }
    return {};
  }

  /// Elements get the names of those that they stand for: what is said of
  /// their states is said in these names.
  void name_elements(const TranslationClaim& claim) {
    std::unordered_map<std::string_view, std::string_view> names;
    for (const auto& [from, to] : claim.elements) names.emplace(to, from);
    for (const InstanceId id : ids_of(written_.instances)) {
      const auto found = names.find(written_.instances[id].name);
      if (found == names.end()) continue;
      written_.instances[id].name = found->second;
    }
  }

 private:
  std::string match_cell(CellId id, EquivalenceOptions& options) {
    Cell& cell = source_.cells[id];
    const auto renamed = to_.find(cell.name);
    const std::string_view name =
        renamed == to_.end() ? std::string_view(cell.name) : renamed->second;
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) {
      // Without it the other side cannot depend on it: that is compared.
      const bool may_be = cell.made || (cell.role != CellRole::Output &&
                                        !written_by_rung_[id.index()]);
      return may_be ? "" : "`" + cell.name + "` is lost";
    }
    Cell& other = written_.cells[found->second];
    const bool input = cell.role == CellRole::Input;
    // Some languages have no memory but outputs. A memory cell is compared too.
    const bool shown =
        cell.role == CellRole::Memory && other.role == CellRole::Output;
    if (cell.type != other.type || (cell.role != other.role && !shown) ||
        (input && (cell.low < other.low || cell.high > other.high))) {
      return "the declaration of `" + cell.name + "` differs";
    }
    taken_.insert(found->second);
    if (input) {
      other.low = cell.low;
      other.high = cell.high;
    } else if (!cell.made) {
      cell.role = CellRole::Output;
      other.role = CellRole::Output;
    }
    if (!cell.made || renamed != to_.end()) {
      options.map.emplace_back(cell.name, other.name);
    }
    return {};
  }

  Program& source_;
  Program& written_;
  Names to_;
  std::unordered_map<std::string_view, CellId> by_name_;
  std::unordered_set<CellId> taken_;
  std::vector<bool> written_by_rung_;  // by cell of the source
};

}  // namespace

TranslationCheck check_translation(Program source, Program written,
                                   const TranslationClaim& claim,
                                   const EquivalenceOptions& options) {
  TranslationCheck check;
  EquivalenceOptions all = options;
  all.relations = claim.relations;
  Matching matching(source, written, claim);
  check.lost = matching.match(all);
  if (!check.lost.empty()) return check;
  matching.name_elements(claim);
  const bool compared =
      std::any_of(source.cells.begin(), source.cells.end(),
                  [](const Cell& it) { return it.role == CellRole::Output; });
  if (!compared) {  // no rung writes a thing
    check.result.verdict = EquivalenceVerdict::Equivalent;
    return check;
  }
  check.result = check_equivalence(source, written, all);
  if (!check.result.not_compared.empty()) {
    check.lost = "`" + check.result.not_compared[0] + "` is not compared";
  }
  return check;
}

}  // namespace rung
