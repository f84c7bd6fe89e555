#include "app/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/output.h"
#include "frontend/props_yaml.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

/// A directory for certificates: made when it is not there.
std::optional<std::string> make_directory(const std::string& path) {
  if (path.empty()) return std::nullopt;
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && fs::is_directory(path, error)) return std::nullopt;
  return fmt::format("--certificates: cannot make the directory {}: {}", path,
                     error ? error.message() : "it is a file");
}

}  // namespace

Session::Session(const Options& options)
    : options_(options),
      finder_(options),
      progress_(options.detail != TextOptions::Detail::Quiet) {
  error_ = check_formats(options);
  if (!error_) error_ = make_directory(options.certificates);
  if (error_) return;
  if (std::count(options.files.begin(), options.files.end(), "-") > 1) {
    error_ = "standard input can be read only once";
    return;
  }
  if (!options.props.empty()) {
    const Input props = read_input(options.props, sources_);
    if (props.error) {
      error_ =
          fmt::format("--props {}: {}", options.props, props.error->message);
      return;
    }
    FileId lines = props.file;
    if (is_properties_yaml(sources_[lines].text())) {
      YamlProperties made = read_properties_yaml(sources_[lines].text());
      if (!made.error.empty()) {
        error_ = fmt::format("--props {}: {}", options.props, made.error);
        return;
      }
      lines = sources_.add(options.props, std::move(made.lines));
    }
    properties_file_ = lines;
    extra_ = property_lines(sources_, lines);
  }
  if (!options.revision.empty() && options.files.size() == 1) {
    inputs_.push_back(
        read_committed(options.revision, options.files.front(), sources_));
  }
  const FileFilter wanted = [this](const std::string& path, bool known) {
    const Config* const config = finder_.of(path);
    return config == nullptr ? known : is_wanted(*config, path, known);
  };
  for (Input& input : read_inputs(options.files, wanted, sources_)) {
    inputs_.push_back(std::move(input));
  }
  read_configurations();
}

void Session::read_configurations() {
  configured_.emplace(nullptr, options_);
  const bool committed = !options_.revision.empty();
  for (const Input& input : inputs_) {
    const Config* const config =
        finder_.of(committed ? options_.files.front() : input.path);
    const auto found = configured_.find(config);
    if (found != configured_.end()) {
      effective_.push_back(&found->second);
      continue;
    }
    const auto added =
        configured_.emplace(config, with_config(options_, *config)).first;
    effective_.push_back(&added->second);
  }
  error_ = finder_.error();
}

Loaded Session::load(const Input& input, std::string_view semantics) const {
  const Options& options = options_of(index_of(input));
  if (semantics.empty()) return rung::load(input, options, extra_, sources_);
  Options other = options;
  other.semantics = semantics;
  return rung::load(input, other, extra_, sources_);
}

VerifyOptions Session::verify_options(std::size_t index) {
  VerifyOptions verify;
  const Options& options = options_of(index);
  verify.budget.seconds = options.timeout;
  verify.engine = options.engine;
  const auto files = static_cast<unsigned>(inputs_.size());
  verify.jobs = std::max(1U, options_.jobs / std::max(1U, files));
  verify.self_check = options_.self_check;
  verify.recheck = options.recheck;
  verify.smtlib_directory = options_.certificates;
  if (!options_.certificates.empty() && inputs_.size() > 1) {
    const std::string name = fmt::format(
        "{}-{}", index + 1, fs::path(inputs_[index].path).stem().string());
    const fs::path directory = fs::path(options_.certificates) / name;
    std::error_code ignored;  // then writing into it fails, and says so
    fs::create_directories(directory, ignored);
    verify.smtlib_directory = directory.string();
  }
  verify.inject_wrong_invariant = options_.inject_wrong_invariant;
  verify.inject_wrong_trace = options_.inject_wrong_trace;
  verify.progress = progress_.of(inputs_[index].path);
  return verify;
}

}  // namespace rung
