#pragma once

#include <string_view>

#include "base/diagnostic.h"
#include "base/source.h"
#include "frontend/ast.h"

namespace rung {

/// Reads an instruction list of the FX family of Mitsubishi controllers
/// (docs/languages/il-mitsubishi.md).
///
/// The result declares everything: relays are bits, timers and counters are
/// elements of the dialect `melsec` and have their contact as a bit. The block
/// stack, the branch stack and master controls are gone: what they mean is in
/// the assignments.
///
/// Errors: everything wrong in the file goes to `sink` (RP00x, RP04x), in one
///         run; reading goes on at the next line. Linear in the text.
Ast read_il_mitsubishi(const SourceSet& sources, FileId file,
                       DiagnosticSink& sink);

/// Does the text look like one? `LD X0` alone may also be IEC 61131-3: then the
/// first instruction that only one of the two has decides.
bool is_il_mitsubishi(std::string_view text);

}  // namespace rung
