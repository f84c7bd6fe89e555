#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "app/load.h"
#include "app/options.h"

namespace rung {

/// Is a changed text the same program? Answers by reading it as a whole and
/// deciding equivalence, as `equiv` does, on all outputs and on every memory
/// cell that both have; what was there to be read, proved or simulated must be
/// there still.
class FixProof {
 public:
  /// `before` was read from `path` without errors, with these options and
  /// property lines.
  FixProof(const Loaded& before, const std::string& path,
           const Options& options, const std::vector<AstAnnotation>& extra)
      : before_(before), path_(path), options_(options), extra_(extra) {}

  struct Answer {
    bool proved = false;
    std::string reason;  // how it was proved, or why not
  };
  /// `seconds` that ran out, or a `stop`, are no proof.
  Answer prove(const std::string& after, double seconds,
               const std::atomic<bool>* stop = nullptr) const;

 private:
  const Loaded& before_;
  std::string path_;
  const Options& options_;
  const std::vector<AstAnnotation>& extra_;
};

}  // namespace rung
