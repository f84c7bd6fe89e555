#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "app/inputs.h"
#include "app/options.h"
#include "base/diagnostic.h"
#include "reports/report.h"

namespace rung {

/// The property lines of a `--props` file: each line that is neither empty nor
/// a comment (`//`).
std::vector<AstAnnotation> property_lines(const SourceSet& sources,
                                          FileId file);

/// What loading one input gave: in `report` the language, the findings, the
/// properties and, without input errors, the program.
struct Loaded {
  FileReport report;
  std::shared_ptr<Program> program;  // null: input errors
};

/// The presets that fit the input's language, for `--sweep`; empty where no
/// reader accepts it.
std::vector<std::string_view> presets_of(const Input& input,
                                         const Options& options,
                                         const SourceSet& sources);

/// Bytes to a program with its properties.
/// Errors: input errors are in the report's findings: RP07x for what no
///         reader accepts, and those of the reader.
Loaded load(const Input& input, const Options& options,
            const std::vector<AstAnnotation>& extra, const SourceSet& sources);

}  // namespace rung
