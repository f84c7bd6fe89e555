#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "base/source.h"
#include "reports/locate.h"

namespace rung {

/// "motor.rung:4"
std::string rung_place(const SourceSet& sources, const Rung& rung,
                       Locator& locator);

/// The start of the rung's text, as markup.
std::string rung_caption(const SourceSet& sources, const Rung& rung);

/// The program as a ladder for the page: a figure a rung, with the id
/// FILE_ID-rung-NUMBER; those of different files beside each other. Of a
/// program with more than kMaxLadder rungs only those `used`, sorted.
inline constexpr std::size_t kMaxLadder = 400;
std::string write_ladder(const SourceSet& sources, const Program& program,
                         const std::string& file_id,
                         const std::vector<RungId>& used, Locator& locator);

}  // namespace rung
