#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/program.h"
#include "app/option_values.h"
#include "base/diagnostic.h"
#include "reports/text.h"

namespace rung {

/// `--format FMT[:FILE]`; an empty path is standard output.
struct FormatRequest {
  std::string format;
  std::string path;
};

enum class ColourMode : std::uint8_t { Auto, Always, Never };

/// The command line, checked and typed.
struct Options {
  std::string command;
  /// Every option as it was given, by its name, with its values: what an answer
  /// may depend on, also where nobody thought of it.
  std::vector<std::pair<std::string, std::string>> given;
  std::vector<std::string> files;
  std::vector<FormatRequest> formats;
  std::optional<ScanInterval> scan;
  std::string semantics;
  std::string dialect;
  std::string language;
  bool stable_inputs = false;
  bool rollover = false;  // millis() begins anew at 2^32
  std::string pou;
  bool sweep = false;     // prove
  std::string replay_on;  // prove: a board
  std::string traces;     // prove: a directory
  bool explain = false;   // check, prove
  std::string props;
  std::vector<std::string> properties;  // --property; empty: all
  double timeout = 60;
  std::string engine;
  unsigned jobs = 1;
  Severity fail_on = Severity::Warning;
  std::set<std::string> configured;  // what a configuration says
  std::string config;                // empty: the nearest rungproof.toml
  bool no_config = false;
  std::vector<Pack> packs = {Pack::Default};
  std::vector<RuleSetting> rules;  // the last one about a rule counts
  std::string baseline;            // empty: none
  bool accept_new = false;         // baseline write
  std::string action;              // config, baseline: `show`, `write`...
  ColourMode colour = ColourMode::Auto;
  TextOptions::Detail detail = TextOptions::Detail::Normal;
  bool self_check = true;
  std::string recheck;
  std::string certificates;
  std::string cache;  // on, off or a directory; empty: the environment says
  std::vector<std::pair<std::string, std::string>> map;
  // lint
  bool fix = false;
  bool diff = false;
  // equiv
  std::vector<std::string> rungs;
  std::uint32_t delay = 0;
  bool settled = false;
  std::string revision;  // compare with it: --git REV

  std::string locked;   // check: the lock to compare with; empty: none
  bool update = false;  // lock

  std::string question;  // bound: "P -> Q"

  bool inject_wrong_invariant = false;
  bool inject_wrong_trace = false;
  // lower, run, render, rule
  std::string to;
  bool binary = false;
  bool header = false;
  bool report = false;
  std::string output;
  std::string stimulus;
  std::optional<std::uint64_t> scans;
  std::optional<std::int64_t> dt_ms;
  bool ascii = false;
  // upload, monitor
  std::string port;
  std::string tcp;
  unsigned baud = 115200;
  double wait = 5;  // seconds for an answer
  bool clear_outputs = false;
  std::string rule;
};

/// Does the command line say it? `option` without its dashes.
bool is_given(const Options& options, std::string_view option);

/// Exit codes of the program; interfaces.md has what they mean.
inline constexpr int kExitUsage = 2;
inline constexpr int kExitOpen = 3;
inline constexpr int kExitInternal = 4;

/// The options, or the exit code after help, a version or an error was
/// printed.
std::variant<Options, int> parse_options(int argc, char** argv);

/// Prints `rungproof: error: MESSAGE` and returns kExitUsage.
int usage_error(const std::string& message);

}  // namespace rung
