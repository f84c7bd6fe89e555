#include <fmt/format.h>

#include <algorithm>

#include "analysis/rule.h"
#include "app/commands.h"
#include "app/config.h"
#include "app/output.h"

namespace rung {
namespace {

/// As a TOML string.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    out += control ? fmt::format("\\u{:04x}", static_cast<unsigned char>(c))
                   : std::string(1, c);
  }
  return out + "\"";
}

std::string list(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) {
    out += (out.empty() ? "" : ", ") + quoted(text);
  }
  return "[" + out + "]";
}

/// Prints what holds as a configuration that says the same; a remark behind
/// each value tells where it comes from.
class ConfigWriter {
 public:
  ConfigWriter(const Options& command_line, const Config* config)
      : command_line_(command_line),
        config_(config),
        options_(config == nullptr ? command_line
                                   : with_config(command_line, *config)) {}

  std::string write() {
    write_top();
    out_ += "\n[check]\n";
    for (const ConfigKey& key : config_keys()) write_key(key);
    out_ += "\n[rules]\n";
    write_rules();
    return std::move(out_);
  }

 private:
  /// Without a value the line says what is left to the program.
  void line(std::string_view key, const std::string& value,
            std::string_view origin) {
    const std::string left = value.empty() ? fmt::format("# {}", key)
                                           : fmt::format("{} = {}", key, value);
    out_ += fmt::format("{:<34} # {}\n", left, origin);
  }

  std::string origin(const std::string& key, const std::string& option) const {
    if (!option.empty() && is_given(command_line_, option)) {
      return "command line";
    }
    if (config_ != nullptr) {
      const auto found = config_->lines.find(key);
      if (found != config_->lines.end()) {
        return fmt::format("{}:{}", config_->path, found->second);
      }
    }
    return "default";
  }

  void write_top() {
    out_ += config_ == nullptr
                ? "# no configuration\n"
                : fmt::format("# configuration: {}\n", config_->path);
    const Config none;
    const Config& config = config_ == nullptr ? none : *config_;
    const bool given = is_given(command_line_, "baseline");
    const std::string& baseline =
        given ? command_line_.baseline : config.baseline;
    line("baseline", baseline.empty() ? "" : quoted(baseline),
         origin("baseline", "baseline"));
    line("include", list(config.include), origin("include", ""));
    line("exclude", list(config.exclude), origin("exclude", ""));
  }

  void write_key(const ConfigKey& key) {
    std::string value = key.show(options_);
    if (key.kind == ConfigKey::Kind::Text && !value.empty()) {
      value = quoted(value);
    }
    const std::string name(key.name);
    line(key.name, value, origin("check." + name, name));
  }

  void write_rules() {
    std::vector<std::string> packs;
    for (const Pack pack : options_.packs) packs.emplace_back(to_string(pack));
    line("packs", list(packs), origin("rules.packs", "pack"));
    const RuleSelection selection =
        make_selection(options_.packs, options_.rules);
    for (const Rule* rule : all_rules()) {
      const auto severity = selection.severity_of(*rule);
      line(rule->name,
           quoted(severity ? to_string(*severity) : std::string_view("off")),
           rule_origin(*rule));
    }
  }

  std::string rule_origin(const Rule& rule) const {
    const bool given =
        std::any_of(command_line_.rules.begin(), command_line_.rules.end(),
                    [&](const RuleSetting& one) { return one.rule == &rule; });
    if (given) return "command line";
    std::string from = origin("rules." + std::string(rule.name), "");
    if (from != "default") return from;
    return fmt::format("pack {}", to_string(rule.pack));
  }

  const Options& command_line_;
  const Config* config_;
  const Options options_;
  std::string out_;
};

}  // namespace

int run_config(const Options& options) {
  ConfigFinder finder(options);
  const std::string file = options.files.empty() ? "-" : options.files.front();
  const Config* const config = finder.of(file);
  if (finder.error()) return usage_error(*finder.error());
  return print_out(ConfigWriter(options, config).write()) ? 0 : kExitUsage;
}

}  // namespace rung
