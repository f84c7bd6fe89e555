#pragma once

#include "reports/report.h"

namespace rung {

/// `prove --sweep`: the same input under several presets of semantics gives a
/// FileReport for each, one behind the other. Says of each input which verdicts
/// depend on the preset, as notes of its first report.
void note_dependent_verdicts(Report& report);

}  // namespace rung
