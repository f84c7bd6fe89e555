#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/result.h"
#include "analysis/trace.h"

namespace rung {

/// Parts that several JSON writers share. Only .cpp files include this: the
/// library is slow to compile.
using Json = nlohmann::ordered_json;

/// `cells` are the signals, in this order.
Json json_of(const Program& program, const Trace& trace,
             const std::vector<CellId>& cells);
Json json_of(const Certificate& certificate);

/// Times have microseconds, not the noise below them.
double rounded_ms(double milliseconds);

/// Indented by 2, or on one line; bytes that are not UTF-8 become U+FFFD.
std::string dump(const Json& json);
std::string dump_line(const Json& json);

std::string_view to_string(CellRole role);

}  // namespace rung
