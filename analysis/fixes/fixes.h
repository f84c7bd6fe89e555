#pragma once

#include <vector>

#include "analysis/program.h"
#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// Gives findings of rules their fixes: changes of the text that take them
/// away. None is proved here, and some change what the program does: a missing
/// stop contact, a missing reset. The safest of a finding comes first.
///
/// Only for languages whose expressions are written with operators (scripts and
/// ST); elsewhere an instruction's place does not tell how to take it out.
/// Formatting and comments of what stays are kept.
/// Limits: the first 500 findings that a fix is known for get one.
void offer_fixes(const SourceSet& sources, const Program& program,
                 std::vector<Diagnostic>& findings);

}  // namespace rung
