#include <algorithm>

#include "app/lsp/features.h"

namespace rung::lsp {
namespace {

constexpr int kProperty = 7;  // SymbolKind
constexpr int kVariable = 13;
constexpr int kRead = 2;  // DocumentHighlightKind
constexpr int kWrite = 3;

/// Of a rung, what fits on a line.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string out(text.substr(0, std::min(text.find('\n'), kMost)));
  // Not half a character.
  while (!out.empty() && out.size() < text.size() &&
         (static_cast<unsigned char>(text[out.size()]) & 0xc0U) == 0x80U) {
    out.pop_back();
  }
  return out.size() < text.size() ? out + "..." : out;
}

bool is_here(const View& view, SourceRange where) {
  return where.has_value() && where.file == view.snapshot.file;
}

Json symbol(const View& view, std::string_view name, std::string detail,
            int kind, SourceRange whole, SourceRange part) {
  const bool inside =
      is_here(view, part) && part.begin >= whole.begin && part.end <= whole.end;
  return {{"name", name},
          {"detail", std::move(detail)},
          {"kind", kind},
          {"range", range_of(view, whole)},
          {"selectionRange", range_of(view, inside ? part : whole)}};
}

/// The rungs that write the cell; of an input its first mention.
std::vector<SourceRange> definitions(const View& view, CellId cell) {
  std::vector<SourceRange> found;
  for (const Occurrence& it : view.snapshot.occurrences) {
    if (it.cell == cell && it.kind == Occurrence::Kind::Write) {
      found.push_back(it.where);
    }
  }
  const SourceRange first = view.snapshot.program()->cells[cell].where;
  if (found.empty() && is_here(view, first)) found.push_back(first);
  return found;
}

}  // namespace

Json symbols_of(const View& view) {
  Json all = Json::array();
  const Program* const program = view.snapshot.program();
  if (program == nullptr) return all;
  for (const Property& property :
       view.snapshot.loaded.report.properties.properties) {
    if (property.built_in || !is_here(view, property.where)) continue;
    all.push_back(symbol(view, property.name, excerpt(property.text), kProperty,
                         property.where, property.where));
  }
  for (const Rung& rung : program->rungs) {
    const Cell& target = program->cells[rung.target];
    if (target.made || !is_here(view, rung.where)) continue;
    all.push_back(symbol(view, target.name,
                         excerpt(view.snapshot.sources.text(rung.where)),
                         kVariable, rung.where, rung.target_where));
  }
  return all;
}

Json definition_at(const View& view, std::uint32_t offset) {
  const Occurrence* const name = occurrence_at(view.snapshot, offset);
  if (name == nullptr) return nullptr;
  Json all = Json::array();
  for (const SourceRange& where : definitions(view, name->cell)) {
    all.push_back(location_of(view, where));
  }
  return all;
}

Json references_at(const View& view, std::uint32_t offset, bool declaration) {
  const Occurrence* const name = occurrence_at(view.snapshot, offset);
  if (name == nullptr) return nullptr;
  Json all = Json::array();
  for (const Occurrence& it : view.snapshot.occurrences) {
    if (it.cell != name->cell) continue;
    if (!declaration && it.kind == Occurrence::Kind::Write) continue;
    all.push_back(location_of(view, it.where));
  }
  return all;
}

Json highlights_at(const View& view, std::uint32_t offset) {
  const Occurrence* const name = occurrence_at(view.snapshot, offset);
  if (name == nullptr) return nullptr;
  Json all = Json::array();
  for (const Occurrence& it : view.snapshot.occurrences) {
    if (it.cell != name->cell) continue;
    all.push_back(
        {{"range", range_of(view, it.where)},
         {"kind", it.kind == Occurrence::Kind::Write ? kWrite : kRead}});
  }
  return all;
}

}  // namespace rung::lsp
