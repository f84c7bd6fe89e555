#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rung {

/// What another program said, on standard output and standard error alike.
struct ProcessOutput {
  std::string text;
  int status = 0;     // as waitpid() gives it
  std::string error;  // it did not run, or not to its end
};

/// Runs `arguments[0]`, looked up in PATH, without a shell and without input.
/// Text beyond `most_bytes` is read and dropped; after `seconds` it is killed.
ProcessOutput run_process(const std::vector<std::string>& arguments,
                          double seconds, std::size_t most_bytes);

}  // namespace rung
