#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/source.h"

namespace rung {

/// One input, in memory; `error` says why there is nothing in it.
struct Input {
  FileId file;
  std::string path;
  std::optional<Diagnostic> error;
};

/// Reads a file, or standard input for `-`.
/// Errors: RP070 unreadable, RP071 above kMaxFileBytes, RP082 a postfix binary
///         that the machine would refuse.
Input read_input(const std::string& path, SourceSet& sources);

/// `path` as it is in the commit `revision` of the git repository that it is
/// in. Errors: RP070 with what git says.
Input read_committed(const std::string& revision, const std::string& path,
                     SourceSet& sources);

/// Is a file below a directory to be read? `known`: its ending is that of a
/// program.
using FileFilter = std::function<bool(const std::string& path, bool known)>;

/// The same for each path; a directory stands for the programs below it, by the
/// endings of their names, in sorted order. One without any is an error: RP072.
std::vector<Input> read_inputs(const std::vector<std::string>& paths,
                               const FileFilter& wanted, SourceSet& sources);

/// Where relative paths start; empty when that cannot be found out.
std::string working_directory();

/// An error about a whole file.
Diagnostic file_error(FileId file, std::string_view code, std::string message);

}  // namespace rung
