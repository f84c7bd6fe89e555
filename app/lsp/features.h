#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/lsp/view.h"

namespace rung::lsp {

// What a view says about a document, in the protocol's words. Pure functions:
// nothing is read, proved or sent here.

/// Errors of the text are all there is while there are any; else findings, and
/// properties that are violated.
Json diagnostics_of(const View& view);

Json hover_at(const View& view, std::uint32_t offset);
Json code_lenses_of(const View& view);
Json symbols_of(const View& view);
Json definition_at(const View& view, std::uint32_t offset);
Json references_at(const View& view, std::uint32_t offset, bool declaration);
Json highlights_at(const View& view, std::uint32_t offset);
Json code_actions_in(const View& view, SourceRange range);

/// The range of the name at `offset`, or null: nothing there has a name.
Json rename_range_at(const View& view, std::uint32_t offset);

/// An edit of all places; `refusal` says why there is none: a name that the
/// language does not have, one that is taken, or a program that would not be
/// the same but for the name.
struct Rename {
  Json edit;
  std::string refusal;
};
Rename rename_at(const View& view, std::uint32_t offset,
                 const std::string& name, const Options& options);

}  // namespace rung::lsp
