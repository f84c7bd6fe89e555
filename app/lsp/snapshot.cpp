#include "app/lsp/snapshot.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "frontend/script/token.h"

namespace rung::lsp {
namespace {

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '$' || c == '%' || c == '.';
}

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Readers of languages that do not care for case keep one spelling.
bool spells(std::string_view text, std::string_view name) {
  return std::equal(text.begin(), text.end(), name.begin(), name.end(),
                    [](char a, char b) { return upper(a) == upper(b); });
}

class Finder {
 public:
  explicit Finder(const Snapshot& snapshot)
      : snapshot_(snapshot), program_(*snapshot.program()) {
    for (const CellId id : ids_of(program_.cells)) {
      if (!program_.cells[id].made) cells_[program_.cells[id].name] = id;
    }
  }

  std::vector<Occurrence> run() {
    for (const Rung& rung : program_.rungs) {
      add(rung.target_where, rung.target, Occurrence::Kind::Write);
    }
    for (const Node& node : program_.nodes) {
      if (node.op == NodeOp::Read) {
        add(node.where, node.cell, Occurrence::Kind::Read);
      }
    }
    for (const AstAnnotation& line : program_.annotations) mentions(line);
    if (program_.language == "script") sections();
    const auto key = [](const Occurrence& it) {
      return std::pair(it.where.begin, it.kind == Occurrence::Kind::Mention);
    };
    std::sort(found_.begin(), found_.end(),
              [&](const Occurrence& a, const Occurrence& b) {
                return key(a) < key(b);
              });
    found_.erase(std::unique(found_.begin(), found_.end(),
                             [](const Occurrence& a, const Occurrence& b) {
                               return a.where.begin == b.where.begin;
                             }),
                 found_.end());
    return std::move(found_);
  }

 private:
  void add(SourceRange where, CellId cell, Occurrence::Kind kind) {
    if (!where.has_value() || where.file != snapshot_.file) return;
    if (spells(snapshot_.sources.text(where), program_.cells[cell].name)) {
      found_.push_back({where, cell, kind});
    }
  }

  void mention(SourceRange where) {
    const auto cell = cells_.find(snapshot_.sources.text(where));
    if (cell == cells_.end()) return;
    found_.push_back({where, cell->second, Occurrence::Kind::Mention});
  }

  /// Names in a property line, but not what it calls itself.
  void mentions(const AstAnnotation& line) {
    if (line.where.file != snapshot_.file) return;
    const std::string_view text = snapshot_.sources.text(line.where);
    for (std::size_t at = 0; at < text.size();) {
      if (!is_name_part(text[at])) {
        ++at;
        continue;
      }
      const std::size_t begin = at;
      while (at < text.size() && is_name_part(text[at])) ++at;
      if (begin == 0 && at < text.size() && text[at] == ':') continue;
      mention({line.where.file,
               line.where.begin + static_cast<std::uint32_t>(begin),
               line.where.begin + static_cast<std::uint32_t>(at)});
    }
  }

  /// Initial values and the plant, which the program has without places.
  void sections() {
    const script::TokenList list =
        script::tokenize(snapshot_.sources, snapshot_.file);
    for (const script::Token& token : list.tokens) {
      if (token.kind == script::TokenKind::Name) mention(list.range_of(token));
    }
  }

  const Snapshot& snapshot_;
  const Program& program_;
  std::unordered_map<std::string_view, CellId> cells_;
  std::vector<Occurrence> found_;
};

}  // namespace

std::shared_ptr<const Snapshot> take_snapshot(const std::string& path,
                                              std::int64_t version,
                                              const TextDocument& text,
                                              const Options& options) {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->version = version;
  snapshot->text = text;
  snapshot->file = snapshot->sources.add(path, text.text());
  snapshot->loaded = load({snapshot->file, path, std::nullopt}, options, {},
                          snapshot->sources);
  if (snapshot->program() != nullptr) {
    snapshot->occurrences = Finder(*snapshot).run();
  }
  return snapshot;
}

const Occurrence* occurrence_at(const Snapshot& snapshot,
                                std::uint32_t offset) {
  const auto behind =
      std::upper_bound(snapshot.occurrences.begin(), snapshot.occurrences.end(),
                       offset, [](std::uint32_t at, const Occurrence& it) {
                         return at < it.where.begin;
                       });
  if (behind == snapshot.occurrences.begin()) return nullptr;
  const Occurrence& found = *std::prev(behind);
  return offset <= found.where.end ? &found : nullptr;
}

RungId rung_at(const Snapshot& snapshot, std::uint32_t offset) {
  if (snapshot.program() == nullptr) return {};
  RungId best;
  std::uint32_t size = UINT32_MAX;
  for (const RungId id : ids_of(snapshot.program()->rungs)) {
    const SourceRange where = snapshot.program()->rungs[id].where;
    if (!where.has_value() || offset < where.begin || offset > where.end) {
      continue;
    }
    if (where.end - where.begin >= size) continue;
    size = where.end - where.begin;
    best = id;
  }
  return best;
}

std::optional<std::uint32_t> property_at(const Snapshot& snapshot,
                                         std::uint32_t offset) {
  const auto& all = snapshot.loaded.report.properties.properties;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const SourceRange where = all[i].where;
    if (!all[i].built_in && where.has_value() && where.begin <= offset &&
        offset <= where.end) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace rung::lsp
