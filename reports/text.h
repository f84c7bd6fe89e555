#pragma once

#include <cstdint>
#include <string>

#include "reports/report.h"

namespace rung {

struct TextOptions {
  enum class Detail : std::uint8_t {
    Quiet,    // problems only
    Normal,   // problems and a summary
    Verbose,  // a line an obligation, with engine, time and invariant
  };
  Detail detail = Detail::Normal;
  bool colour = false;
};

/// The report for people. Deterministic, but for the times of Verbose.
std::string write_text(const Report& report, const TextOptions& options);

/// One finding as compilers show it; for usage errors and `lower` as well.
std::string write_diagnostic(const SourceSet& sources,
                             const Diagnostic& diagnostic, bool colour);

}  // namespace rung
