#pragma once

#include <string>
#include <string_view>

namespace rung {

/// Text for SVG and HTML, between tags and in quoted attributes: printable(),
/// with no character left that has a meaning there or that XML cannot hold.
std::string markup(std::string_view text);

/// The same, without what comes after `columns` columns; an ellipsis says so.
std::string markup(std::string_view text, std::size_t columns);

/// The entity that a character with a meaning in markup is written as; empty:
/// it has none. For what is not to be made printable too.
std::string_view entity_of(char c);

}  // namespace rung
