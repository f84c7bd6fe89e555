#pragma once

#include <optional>

#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// Why a file is not text that a reader can take, as an error (RP001); nothing
/// when it is UTF-8 without control characters other than tab, line ends and
/// form feed. Only the first such place is reported: what follows it is not
/// text either.
std::optional<Diagnostic> check_text(const SourceSet& sources, FileId file);

}  // namespace rung
