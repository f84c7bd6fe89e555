#pragma once

#include <string>

#include "analysis/program.h"
#include "base/source.h"

namespace rung {

/// The program as a ladder, in box-drawing characters or in ASCII:
///
///     1 motor.rung:2
///      │   I0        I1        Q0
///      ├─┬─┤ ├─┬─────┤/├───────( )──┤
///      │ │ Q0  │
///      │ └─┤ ├─┘
///
/// Every rung is drawn; coils stand in one column.
std::string draw_ladder(const SourceSet& sources, const Program& program,
                        bool ascii);

}  // namespace rung
