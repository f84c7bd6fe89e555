#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/option_values.h"
#include "app/options.h"

namespace rung {

/// The name under which a configuration is found.
inline constexpr std::string_view kConfigName = "rungproof.toml";

/// What a configuration says, checked, with the lines where it says it.
struct Config {
  std::string path;                             // as reports show it
  std::string directory;                        // absolute: where paths start
  std::map<std::string, std::string> settings;  // of [check]: key to value
  std::optional<std::vector<Pack>> packs;
  std::vector<RuleSetting> rules;
  std::string baseline;  // as written
  std::vector<std::string> include;
  std::vector<std::string> exclude;
  /// "check.scan", "rules.packs", "rules.double-coil" (by name), "baseline".
  std::map<std::string, std::uint32_t> lines;

  /// The baseline as a path that can be opened; empty: none.
  std::string baseline_path() const;
};

/// The configuration in `text`, or `PATH:LINE:COLUMN: what is wrong`.
std::variant<Config, std::string> read_config(const std::string& path,
                                              std::string_view text);

/// A key of [check]: an option of the same name that the command line has, too.
struct ConfigKey {
  enum class Kind : std::uint8_t { Text, Number, Switch };
  std::string_view name;
  Kind kind = Kind::Text;
  void (*set)(Options& options, const std::string& value);  // throws BadValue
  std::string (*show)(const Options& options);              // empty: not set
};
const std::vector<ConfigKey>& config_keys();

/// Options where a configuration says what the command line leaves open.
Options with_config(Options options, const Config& config);

/// All that a configuration may set and an answer depend on, as a text to tell
/// answers by.
std::string settings_text(const Options& options);

/// Is a file that was found below a directory to be read? `known`: its ending
/// is that of a program. A pattern matches a path below the configuration's
/// directory, or one of the directories on the way there; one without `/`
/// matches names. `*` stands for any text, `?` for a character.
bool is_wanted(const Config& config, const std::string& path, bool known);

/// Which configuration has a say about a file: found upward from it, nearest
/// wins, and none above the root of a repository (`.git`). Each is read once.
class ConfigFinder {
 public:
  explicit ConfigFinder(const Options& options) : options_(options) {}

  /// Null: none, or error() says why it cannot be read. `-` is a file of the
  /// working directory.
  const Config* of(const std::string& path);

  const std::optional<std::string>& error() const { return error_; }

 private:
  const Config* read(const std::string& path);

  const Options& options_;
  std::map<std::string, const Config*> by_directory_;
  std::map<std::string, Config> by_path_;
  std::optional<std::string> error_;
};

}  // namespace rung
