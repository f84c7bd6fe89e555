#pragma once

#include <map>
#include <optional>
#include <vector>

#include "app/config.h"
#include "app/load.h"
#include "app/options.h"
#include "app/progress.h"
#include "reports/report.h"
#include "smt/verify.h"

namespace rung {

/// What all commands that read programs have in common: the inputs, the
/// property file, and the options of the proofs.
class Session {
 public:
  explicit Session(const Options& options);

  /// Why the command line cannot be followed; nothing when it can.
  const std::optional<std::string>& error() const { return error_; }

  const std::vector<Input>& inputs() const { return inputs_; }
  SourceSet& sources() { return sources_; }
  const SourceSet& sources() const { return sources_; }
  const std::vector<AstAnnotation>& extra() const { return extra_; }
  const Options& options() const { return options_; }
  /// Of `--props`, as lines; no value: there are none.
  FileId properties_file() const { return properties_file_; }
  /// With what the configuration of that input says.
  const Options& options_of(std::size_t index) const {
    return *effective_[index];
  }

  /// `semantics`: instead of what the options say; empty: what they say.
  Loaded load(const Input& input, std::string_view semantics = {}) const;
  std::vector<std::string_view> presets_of(const Input& input) const {
    return rung::presets_of(input, options_of(index_of(input)), sources_);
  }
  /// For the input at `index`. With several inputs each has a directory of
  /// its own for certificates: properties of two programs may share a name.
  VerifyOptions verify_options(std::size_t index);

 private:
  std::size_t index_of(const Input& input) const {
    return static_cast<std::size_t>(&input - inputs_.data());
  }
  void read_configurations();

  const Options& options_;
  SourceSet sources_;
  std::vector<Input> inputs_;
  FileId properties_file_;
  ConfigFinder finder_;
  std::map<const Config*, Options> configured_;
  std::vector<const Options*> effective_;  // by input
  std::vector<AstAnnotation> extra_;
  std::optional<std::string> error_;
  Progress progress_;
};

}  // namespace rung
