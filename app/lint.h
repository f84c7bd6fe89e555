#pragma once

#include "analysis/program.h"
#include "base/source.h"
#include "reports/report.h"
#include "smt/verify.h"

namespace rung {

/// Runs the rules over a program that was read; of `report` it reads the
/// properties, and sets the findings.
void lint(const SourceSet& sources, const Program& program, FileReport& report,
          const VerifyOptions& options, const RuleSelection& rules = {});

}  // namespace rung
