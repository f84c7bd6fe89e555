#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "frontend/iec/project.h"
#include "frontend/iec/token.h"

namespace rung::iec {

/// Bodies of units in the two textual languages, tokens [begin, end) of a list
/// that lives as long as the body does.
using Body = std::function<void(Scope&)>;

Body structured_text(std::shared_ptr<const TokenList> list, std::size_t begin,
                     std::size_t end);
Body instruction_list(std::shared_ptr<const TokenList> list, std::size_t begin,
                      std::size_t end);

/// Does a body look like an instruction list?
bool looks_like_list(const TokenList& list, std::size_t begin, std::size_t end);

/// Notes which pins of blocks the text speaks of (Project::mentioned); property
/// lines too.
void note_mentions(const TokenList& list, Project& project);
void note_mentions(std::string_view property, Project& project);

}  // namespace rung::iec
