#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/load.h"
#include "app/lsp/text_document.h"
#include "app/options.h"
#include "base/source.h"

namespace rung::lsp {

/// A place that names a cell.
struct Occurrence {
  enum class Kind : std::uint8_t { Read, Write, Mention };
  SourceRange where;
  CellId cell;
  Kind kind = Kind::Read;
};

/// One version of a document, read: nothing of it changes any more, so any
/// thread may look at it.
struct Snapshot {
  std::int64_t version = 0;
  TextDocument text;
  SourceSet sources;
  FileId file;
  Loaded loaded;
  std::vector<Occurrence> occurrences;  // sorted, without overlap

  /// Null: the text has errors.
  const Program* program() const { return loaded.program.get(); }
};

/// Reads and builds; proves nothing.
std::shared_ptr<const Snapshot> take_snapshot(const std::string& path,
                                              std::int64_t version,
                                              const TextDocument& text,
                                              const Options& options);

/// The one that touches `offset`; null when none does.
const Occurrence* occurrence_at(const Snapshot& snapshot, std::uint32_t offset);

/// The rung around `offset`; no value when there is none.
RungId rung_at(const Snapshot& snapshot, std::uint32_t offset);

/// The written property whose line has `offset` in it; its index in the set.
std::optional<std::uint32_t> property_at(const Snapshot& snapshot,
                                         std::uint32_t offset);

}  // namespace rung::lsp
