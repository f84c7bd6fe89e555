#pragma once

#include <string>
#include <string_view>

#include "analysis/program.h"
#include "app/options.h"
#include "backend/unit/unit.h"

namespace rung {

/// Whether a written program is its source: the answer of its validation.
struct Validation {
  int status = 0;      // an exit code; 0: proved equivalent
  std::string reason;  // why not
  std::string engine;  // that proved it; empty where there was no rung
};

/// Reads back what was lowered (postfix, text or bytes) and proves it equal to
/// its source, scan for scan on every cell that a rung writes. Bytes must also
/// pass the loader that the controller has.
///
/// Status: kExitInternal when it differs, is refused or cannot be read; 3 when
/// the time ran out before a proof.
Validation validate_translation(const Program& source,
                                const std::string& written,
                                const Options& options);

/// The same for the other languages, read back by their readers; the signals
/// that the source's text names are compared.
Validation validate_written(const Program& source,
                            const backend::Written& written,
                            const Options& options);

/// Prints why a translation goes no further (`consequence`: "it is not
/// written"): a fault of ours, or a proof that did not come to an end.
/// Returns the exit code.
int unproved(const Validation& validation, std::string_view consequence);

}  // namespace rung
