#include "app/baselines.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "analysis/rule.h"
#include "reports/unicode.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

fs::path absolute(const std::string& path) {
  return (fs::path(working_directory()) / path).lexically_normal();
}

}  // namespace

Baselines::Baselines(const Session& session, bool may_miss)
    : session_(session) {
  for (std::size_t i = 0; i < session.inputs().size(); ++i) {
    const std::string& path = session.options_of(i).baseline;
    if (path.empty()) continue;
    const auto known =
        std::find_if(used_.begin(), used_.end(),
                     [&](const Used& one) { return one.path == path; });
    if (known != used_.end()) {
      known->inputs.push_back(i);
      continue;
    }
    Used& added = used_.emplace_back();
    added.path = path;
    added.directory = absolute(path).parent_path().string();
    added.inputs = {i};
    read(added, may_miss);
  }
}

void Baselines::read(Used& used, bool may_miss) {
  std::error_code ignored;
  if (may_miss && !fs::exists(used.path, ignored)) return;
  SourceSet sources;
  const Input input = read_input(used.path, sources);
  if (input.error) {
    error_ =
        fmt::format("the baseline {}: {}", used.path, input.error->message);
    if (!fs::exists(used.path, ignored)) {
      *error_ += "; `rungproof baseline write` makes it";
    }
    return;
  }
  auto baseline = read_baseline(sources[input.file].text());
  if (const std::string* const why = std::get_if<std::string>(&baseline)) {
    error_ = fmt::format("the baseline {}: {}", used.path, *why);
    return;
  }
  used.baseline = std::move(std::get<Baseline>(baseline));
  used.exists = true;
}

std::string Baselines::path_in(const Used& used, std::size_t input) const {
  const std::string& path = session_.inputs()[input].path;
  if (path == "-") return path;
  return absolute(path).lexically_relative(used.directory).string();
}

void Baselines::compare(Report& report) {
  for (Used& used : used_) {
    for (const std::size_t i : used.inputs) {
      compare_with(used.baseline, session_.sources(), path_in(used, i),
                   report.files[i], used.met);
    }
  }
}

std::vector<BaselineEntry> Baselines::stale(const Used& used,
                                            const Report& report) const {
  const Baseline met = make_baseline(used.met);
  std::map<std::string, std::size_t> inputs;  // by path
  for (const std::size_t i : used.inputs) {
    inputs.emplace(valid_utf8(path_in(used, i)), i);
  }
  std::vector<BaselineEntry> stale;
  for (const BaselineEntry& entry : used.baseline.entries) {
    if (met.find(entry) != nullptr) continue;
    const auto input = inputs.find(entry.file);
    if (input == inputs.end()) {
      std::error_code ignored;
      const fs::path path = fs::path(used.directory) / entry.file;
      if (!fs::exists(path, ignored)) stale.push_back(entry);
      continue;
    }
    if (report.files[input->second].program == nullptr) continue;
    const Options& options = session_.options_of(input->second);
    const Rule* const rule = find_rule(entry.code);
    const bool off = rule != nullptr &&
                     !make_selection(options.packs, options.rules).is_on(*rule);
    if (!off) stale.push_back(entry);
  }
  return stale;
}

void Baselines::apply(Report& report) {
  compare(report);
  for (const Used& used : used_) {
    const std::size_t gone = stale(used, report).size();
    if (gone == 0) continue;
    report.files[used.inputs.front()].notes.push_back(fmt::format(
        "{} of the baseline {} {} gone: `rungproof baseline prune` drops {}",
        gone == 1 ? "a finding" : fmt::format("{} findings", gone), used.path,
        gone == 1 ? "is" : "are", gone == 1 ? "it" : "them"));
  }
}

}  // namespace rung
