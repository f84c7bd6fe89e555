#include <fmt/format.h>

#include "app/config.h"
#include "base/text.h"

// The only file that sees the library: it is slow to compile.
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace rung {
namespace {

/// More is no configuration; a parser's tables would take many times as much.
constexpr std::size_t kMaxConfigBytes = std::size_t{1} << 20;

/// `PATH:LINE:COLUMN: what is wrong`.
class ConfigError : public std::runtime_error {
 public:
  ConfigError(const toml::source_region& where, std::string_view message)
      : std::runtime_error(fmt::format("{}:{}: {}", where.begin.line,
                                       where.begin.column, message)) {}
};

std::string expected_type(std::string_view key, std::string_view type) {
  return fmt::format("`{}` is to be {}", key, type);
}

class ConfigReader {
 public:
  Config read(const toml::table& top) {
    for (const auto& [key, node] : top) {
      const std::string_view name = key.str();
      if (name == "rules") {
        read_rules(table(name, node));
      } else if (name == "check") {
        read_check(table(name, node));
      } else if (name == "baseline") {
        config_.baseline = text(name, node);
        if (config_.baseline.empty()) fail(node, "`baseline` names no file");
      } else if (name == "include") {
        config_.include = texts(name, node);
      } else if (name == "exclude") {
        config_.exclude = texts(name, node);
      } else {
        unknown(key, "", {"baseline", "check", "exclude", "include", "rules"});
      }
      config_.lines.emplace(name, key.source().begin.line);
    }
    return std::move(config_);
  }

 private:
  [[noreturn]] static void fail(const toml::node& node,
                                std::string_view message) {
    throw ConfigError(node.source(), message);
  }

  [[noreturn]] static void unknown(const toml::key& key, std::string_view where,
                                   const std::vector<std::string_view>& known) {
    throw ConfigError(key.source(),
                      fmt::format("there is no key `{}`{}{}", key.str(), where,
                                  did_you_mean(key.str(), known)));
  }

  static const toml::table& table(std::string_view key,
                                  const toml::node& node) {
    if (node.is_table()) return *node.as_table();
    fail(node, expected_type(key, fmt::format("a table, `[{}]`", key)));
  }

  static std::string text(std::string_view key, const toml::node& node) {
    if (const auto* value = node.as_string()) return value->get();
    fail(node, expected_type(key, "a text in quotes"));
  }

  static std::vector<std::string> texts(std::string_view key,
                                        const toml::node& node) {
    const toml::array* const list = node.as_array();
    if (list == nullptr) fail(node, expected_type(key, "a list of texts"));
    std::vector<std::string> all;
    for (const toml::node& one : *list) all.push_back(text(key, one));
    return all;
  }

  void read_rules(const toml::table& rules) {
    for (const auto& [key, node] : rules) {
      std::string name(key.str());
      if (name == "packs") {
        config_.packs = packs(node);
      } else {
        name = read_rule(key, node);
      }
      config_.lines["rules." + name] = key.source().begin.line;
    }
  }

  static std::vector<Pack> packs(const toml::node& node) {
    std::vector<Pack> packs;
    if (!node.is_array()) fail(node, expected_type("packs", "a list of texts"));
    for (const toml::node& one : *node.as_array()) {
      try {
        packs.push_back(parse_pack("packs", text("packs", one)));
      } catch (const BadValue& error) {
        fail(one, error.what());
      }
    }
    return packs;
  }

  /// The rule's name; the key may be its code.
  std::string read_rule(const toml::key& key, const toml::node& node) {
    RuleSetting setting;
    try {
      setting = parse_rule_setting("rules", std::string(key.str()), "off");
    } catch (const BadValue& error) {
      throw ConfigError(key.source(), error.what());
    }
    try {
      setting = parse_rule_setting(key.str(), std::string(key.str()),
                                   text(key.str(), node));
    } catch (const BadValue& error) {
      fail(node, error.what());
    }
    std::string name(setting.rule->name);
    if (config_.lines.contains("rules." + name)) {
      throw ConfigError(key.source(), fmt::format("`{}` and `{}` are one rule",
                                                  setting.rule->code, name));
    }
    config_.rules.push_back(setting);
    return name;
  }

  void read_check(const toml::table& check) {
    for (const auto& [key, node] : check) {
      const ConfigKey* known = nullptr;
      std::vector<std::string_view> names;
      for (const ConfigKey& one : config_keys()) {
        if (one.name == key.str()) known = &one;
        names.push_back(one.name);
      }
      if (known == nullptr) unknown(key, " in [check]", names);
      std::string value = value_of(*known, node);
      try {
        Options tried;
        known->set(tried, value);
      } catch (const BadValue& error) {
        fail(node, error.what());
      }
      config_.settings.emplace(key.str(), std::move(value));
      config_.lines.emplace("check." + std::string(key.str()),
                            key.source().begin.line);
    }
  }

  static std::string value_of(const ConfigKey& key, const toml::node& node) {
    switch (key.kind) {
      case ConfigKey::Kind::Text: {
        std::string value = text(key.name, node);
        if (value.empty()) fail(node, expected_type(key.name, "not empty"));
        return value;
      }
      case ConfigKey::Kind::Number:
        if (!node.is_number()) fail(node, expected_type(key.name, "a number"));
        return fmt::format("{}", *node.value<double>());
      case ConfigKey::Kind::Switch:
        if (!node.is_boolean()) {
          fail(node, expected_type(key.name, "true or false"));
        }
        return *node.value<bool>() ? "true" : "false";
    }
    return {};
  }

  Config config_;
};

}  // namespace

std::variant<Config, std::string> read_config(const std::string& path,
                                              std::string_view text) {
  if (text.size() > kMaxConfigBytes) {
    return fmt::format("{}:1:1: the configuration is larger than 1 MiB", path);
  }
  const toml::parse_result parsed = toml::parse(text, path);
  try {
    if (!parsed) {
      throw ConfigError(parsed.error().source(), parsed.error().description());
    }
    Config config = ConfigReader().read(parsed.table());
    config.path = path;
    return config;
  } catch (const ConfigError& error) {
    return fmt::format("{}:{}", path, error.what());
  }
}

}  // namespace rung
