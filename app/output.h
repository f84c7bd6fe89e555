#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/options.h"
#include "reports/bound.h"
#include "reports/equivalence.h"
#include "reports/report.h"
#include "reports/run.h"

namespace rung {

/// Writes to standard output; false when that failed (a full disk), which was
/// said on standard error.
[[nodiscard]] bool print_out(std::string_view text);

/// Writes a file as a whole or not at all: a temporary beside it, renamed.
/// What is no regular file (/dev/stdout) is written in place. The error, or
/// nothing.
[[nodiscard]] std::optional<std::string> write_file(const std::string& path,
                                                    std::string_view bytes);

/// Says that on standard error; the exit code of an environment that fails.
int output_error(const std::string& path, const std::string& why);

/// Why the formats cannot be written, or nothing. Two on standard output
/// cannot: nobody could take them apart again.
std::optional<std::string> check_formats(const Options& options);

bool use_colour(const Options& options);

/// Prints the input errors of a command whose result is no report; kExitUsage.
int print_input_errors(const SourceSet& sources, const FileReport& report,
                       const Options& options);

/// Writes every format that was asked for, text on standard output where no
/// other format takes it. The exit code: that of the report, or kExitUsage
/// when something could not be written.
int emit(const Report& report, const Options& options);
int emit(const EquivalenceReport& report, const Options& options);
int emit(const RunReport& report, const Options& options);
int emit(const BoundReport& report, const Options& options);

}  // namespace rung
