#include "app/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "analysis/rule.h"
#include "app/inputs.h"
#include "frontend/semantics.h"
#include "reports/paths.h"

namespace rung {
namespace {

namespace fs = std::filesystem;
using Kind = ConfigKey::Kind;

void set_semantics(Options& options, const std::string& value) {
  if (find_semantics(value) == nullptr) {
    std::string known;
    for (const Semantics& one : semantics_presets()) {
      known += (known.empty() ? "" : ", ") + std::string(one.name);
    }
    refuse("semantics", value, "one of " + known);
  }
  options.semantics = value;
}

void set_dialect(Options& options, const std::string& value) {
  if (value != "yun" && value != "sim") {
    refuse("dialect", value, "one of yun, sim");
  }
  options.dialect = value;
}

std::string show_scan(const Options& options) {
  if (!options.scan) return {};
  return fmt::format("{}..{}", options.scan->min_ms, options.scan->max_ms);
}

std::string show_switch(bool on) { return on ? "true" : "false"; }

/// `*` and `?`; two places to go back to suffice, so it takes no more than the
/// product of both lengths.
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;  // behind the last one
  std::size_t again = 0;                      // where it is to go on in `text`
  for (std::size_t t = 0; t < text.size();) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = ++p;
      again = t;
    } else if (p < pattern.size() &&
               (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star;
      t = ++again;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

/// The path itself or a directory on the way to it.
bool matches_path(std::string_view pattern, std::string_view path) {
  while (pattern.ends_with('/')) pattern.remove_suffix(1);
  const bool names_only = pattern.find('/') == std::string_view::npos;
  std::size_t begin = 0;  // of the last name
  for (std::size_t end = 0; end != std::string_view::npos; begin = end + 1) {
    end = path.find('/', begin);
    const std::string_view whole = path.substr(0, end);
    if (matches(pattern, names_only ? whole.substr(begin) : whole)) return true;
    if (end == std::string_view::npos) break;
  }
  return false;
}

/// An absolute path, `.` and `..` resolved, links not.
fs::path absolute(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  return error ? fs::path(path) : whole.lexically_normal();
}

}  // namespace

const std::vector<ConfigKey>& config_keys() {
  static const std::vector<ConfigKey> keys = {
      {"dialect", Kind::Text, set_dialect,
       [](const Options& o) { return o.dialect; }},
      {"engine", Kind::Text,
       [](Options& o, const std::string& value) {
         check_engine("engine", value);
         o.engine = value;
       },
       [](const Options& o) { return o.engine; }},
      {"fail-on", Kind::Text,
       [](Options& o, const std::string& value) {
         o.fail_on = parse_severity("fail-on", value);
       },
       [](const Options& o) { return std::string(to_string(o.fail_on)); }},
      {"pou", Kind::Text,
       [](Options& o, const std::string& value) { o.pou = value; },
       [](const Options& o) { return o.pou; }},
      {"recheck", Kind::Text,
       [](Options& o, const std::string& value) {
         check_recheck("recheck", value);
         o.recheck = value;
       },
       [](const Options& o) { return o.recheck; }},
      {"rollover", Kind::Switch,
       [](Options& o, const std::string& value) {
         o.rollover = value == "true";
       },
       [](const Options& o) { return show_switch(o.rollover); }},
      {"scan", Kind::Text,
       [](Options& o, const std::string& value) {
         o.scan = parse_scan("scan", value);
       },
       show_scan},
      {"semantics", Kind::Text, set_semantics,
       [](const Options& o) { return o.semantics; }},
      {"stable-inputs", Kind::Switch,
       [](Options& o, const std::string& value) {
         o.stable_inputs = value == "true";
       },
       [](const Options& o) { return show_switch(o.stable_inputs); }},
      {"timeout", Kind::Number,
       [](Options& o, const std::string& value) {
         o.timeout = check_timeout("timeout", std::stod(value));
       },
       [](const Options& o) { return fmt::format("{}", o.timeout); }},
  };
  return keys;
}

std::string Config::baseline_path() const {
  if (baseline.empty()) return {};
  const fs::path whole = (fs::path(directory) / baseline).lexically_normal();
  return relative_path(whole.string(), working_directory());
}

Options with_config(Options options, const Config& config) {
  // What is written in another language has no clock that could roll over.
  const bool writes = options.command == "lower" || options.command == "upload";
  for (const ConfigKey& key : config_keys()) {
    const auto setting = config.settings.find(std::string(key.name));
    if (setting == config.settings.end()) continue;
    if (is_given(options, setting->first)) continue;
    if (writes && key.name == "rollover") continue;
    key.set(options, setting->second);
    options.configured.insert(setting->first);
  }
  if (config.packs && !is_given(options, "pack")) {
    options.packs = *config.packs;
  }
  options.rules.insert(options.rules.begin(), config.rules.begin(),
                       config.rules.end());
  if (!is_given(options, "baseline")) {
    options.baseline = config.baseline_path();
  }
  return options;
}

std::string settings_text(const Options& options) {
  std::string text;
  for (const ConfigKey& key : config_keys()) {
    text += fmt::format("{}={}\n", key.name, key.show(options));
  }
  for (const std::string& key : options.configured) text += key + '\n';
  for (const Pack pack : options.packs) {
    text += fmt::format("pack {}\n", to_string(pack));
  }
  for (const RuleSetting& one : options.rules) {
    text += fmt::format("{} {}\n", one.rule->code,
                        one.severity ? to_string(*one.severity) : "off");
  }
  return text;
}

bool is_wanted(const Config& config, const std::string& path, bool known) {
  const std::string whole = absolute(path).string();
  const std::string below = relative_path(whole, config.directory);
  const auto matches_one = [&](const std::vector<std::string>& patterns) {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) {
                         return matches_path(pattern, below);
                       });
  };
  if (matches_one(config.exclude)) return false;
  return known || matches_one(config.include);
}

const Config* ConfigFinder::read(const std::string& path) {
  const std::string shown = relative_path(path, working_directory());
  const auto known = by_path_.find(path);
  if (known != by_path_.end()) return &known->second;
  SourceSet sources;
  const Input input = read_input(path, sources);
  if (input.error) {
    error_ = fmt::format("{}: {}", shown, input.error->message);
    return nullptr;
  }
  auto config = read_config(shown, sources[input.file].text());
  if (std::string* const message = std::get_if<std::string>(&config)) {
    error_ = std::move(*message);
    return nullptr;
  }
  Config& kept = by_path_[path] = std::move(std::get<Config>(config));
  kept.directory = fs::path(path).parent_path().string();
  return &kept;
}

const Config* ConfigFinder::of(const std::string& path) {
  if (options_.no_config || error_) return nullptr;
  if (!options_.config.empty()) return read(absolute(options_.config).string());
  std::vector<std::string> passed;  // directories that learn what is found
  const Config* found = nullptr;
  fs::path at = absolute(path == "-" ? "./-" : path).parent_path();
  while (!error_) {
    const std::string directory = at.string();
    const auto known = by_directory_.find(directory);
    if (known != by_directory_.end()) {
      found = known->second;
      break;
    }
    passed.push_back(directory);
    std::error_code ignored;
    if (fs::exists(at / kConfigName, ignored)) {
      found = read((at / kConfigName).string());
      break;
    }
    const bool top = at == at.parent_path() || fs::exists(at / ".git", ignored);
    if (top) break;
    at = at.parent_path();
  }
  for (const std::string& directory : passed) by_directory_[directory] = found;
  return found;
}

}  // namespace rung
