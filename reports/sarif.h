#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// SARIF 2.1.0, made for GitHub code scanning and for SARIF viewers.
///
/// Results: findings, input errors, and obligations that are not proved; a
///          violation has a code flow with a location and the signals' values
///          (`state`) a step. What is proved is not a result.
/// Paths:   relative to Report::working_directory where they lie below it.
/// Fingerprint: rule, path, the text of the line without its white space, and
///          how many equal ones stand before: no line number, so that it stays
///          when lines move.
/// Limits:  what GitHub reads: kMaxFlowSteps steps in all code flows together;
///          later flows keep their last step, and a notification says so.
inline constexpr std::size_t kMaxFlowSteps = 10'000;
std::string write_sarif(const Report& report);

}  // namespace rung
