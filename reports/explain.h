#pragma once

#include <string>
#include <vector>

#include "reports/cone.h"
#include "reports/report.h"

namespace rung {

/// What an obligation's answer means, in one sentence: "at the end of scan 2
/// `I1 -> !Q0` is false: I1 = 1, Q0 = 1". Lower case, no full stop.
std::string explain(const FileReport& file, const ObligationResult& result,
                    const Cones& cones);

/// The formulas of the property that an obligation comes from.
const std::vector<std::string>& formulas_of(const FileReport& file,
                                            const Obligation& obligation);

/// "proved", or for people who read verdicts for the first time a few words
/// more: "bounded: no violation within 20 scans, no proof".
std::string verdict_phrase(const ObligationResult& result);

/// Why there is no verdict, or what a bounded search means.
std::string why_undecided(const ObligationResult& result);

/// `NAME: TEXT`; a line that gives the name itself is enough alone.
std::string title_of(const Obligation& obligation);

/// "12 obligations", "1 obligation".
std::string quantity(std::size_t count, std::string_view noun);

}  // namespace rung
