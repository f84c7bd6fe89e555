#pragma once

#include <string_view>
#include <vector>

#include "frontend/error_limit.h"
#include "frontend/iec/cursor.h"
#include "frontend/iec/project.h"

namespace rung::iec {

/// Reads VAR ... END_VAR blocks, as long as there are any, into `variables`.
/// False: there was none.
bool read_declarations(Cursor& cursor, std::vector<Variable>& variables,
                       ErrorLimit& errors);

/// Is the word, in capitals, one that no variable may have as its name?
bool is_reserved(std::string_view upper_word);

}  // namespace rung::iec
