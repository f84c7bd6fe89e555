#include "app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "app/lock_file.h"
#include "app/version.h"
#include "base/text.h"
#include "boards/emulator.h"
#include "smt/verify.h"

namespace rung {
namespace {

/// What CLI11 fills in: texts that are checked afterwards.
struct RawOptions {
  std::vector<std::string> formats;
  std::string scan;
  std::string fail_on = "warning";
  std::string colour = "auto";
  std::string self_check = "on";
  std::vector<std::string> map;
  std::vector<std::string> inject;
  std::vector<std::string> packs;
  std::vector<std::string> rules;
  bool quiet = false;
  bool verbose = false;
  std::string file;  // of a command with one, and more arguments behind it
  std::string scans;
  std::string dt;
};

FormatRequest parse_format(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {text, ""};
  if (colon + 1 == text.size()) refuse("--format", text, "FORMAT:FILE");
  return {text.substr(0, colon), text.substr(colon + 1)};
}

RuleSetting parse_rule(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    refuse("--rule", text, "of the form NAME=SEVERITY");
  }
  return parse_rule_setting("--rule", text.substr(0, equals),
                            text.substr(equals + 1));
}

std::pair<std::string, std::string> parse_map(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    refuse("--map", text, "of the form a=b");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

ColourMode parse_colour(const std::string& text) {
  if (text == "auto") return ColourMode::Auto;
  if (text == "always") return ColourMode::Always;
  if (text == "never") return ColourMode::Never;
  refuse("--color", text, "one of auto, always, never");
}

bool parse_switch(std::string_view option, const std::string& text) {
  if (text == "on") return true;
  if (text == "off") return false;
  refuse(option, text, "one of on, off");
}

void check_board(const std::string& name) {
  if (name.empty() || boards::find_board(name) != nullptr) return;
  std::string known;
  for (const boards::Board& board : boards::all_boards()) {
    known += fmt::format("{}{}", known.empty() ? "" : ", ", board.name);
  }
  refuse("--replay-on", name, "one of " + known);
}

void check_texts(const RawOptions& raw, Options& options) {
  for (const std::string& format : raw.formats) {
    options.formats.push_back(parse_format(format));
  }
  if (!raw.file.empty()) options.files = {raw.file};
  if (!raw.scan.empty()) options.scan = parse_scan("--scan", raw.scan);
  for (const std::string& map : raw.map) options.map.push_back(parse_map(map));
  options.fail_on = parse_severity("--fail-on", raw.fail_on);
  options.colour = parse_colour(raw.colour);
  options.self_check = parse_switch("--self-check", raw.self_check);
  if (!options.locked.empty() && !options.properties.empty()) {
    refuse("--locked", "--property", "of use with it: all is compared");
  }
  if (raw.quiet && raw.verbose) refuse("--quiet", "-v", "together with it");
  if (raw.quiet) options.detail = TextOptions::Detail::Quiet;
  if (raw.verbose) options.detail = TextOptions::Detail::Verbose;
  if (!raw.scans.empty()) {
    const auto scans = whole_number(raw.scans);
    if (!scans || *scans < 1) refuse("--scans", raw.scans, "a number above 0");
    options.scans = static_cast<std::uint64_t>(*scans);
  }
  if (!raw.dt.empty()) {
    options.dt_ms = whole_number(raw.dt);
    if (!options.dt_ms || *options.dt_ms < 1 || *options.dt_ms > kMaxScanMs) {
      refuse("--dt", raw.dt, "a whole number of milliseconds above 0");
    }
  }
  for (const std::string& what : raw.inject) {
    if (what == "wrong-invariant") {
      options.inject_wrong_invariant = true;
    } else if (what == "wrong-trace") {
      options.inject_wrong_trace = true;
    } else {
      refuse("--inject", what, "one of wrong-invariant, wrong-trace");
    }
  }
  check_recheck("--recheck", options.recheck);
  check_timeout("--timeout", options.timeout);
  check_engine("--engine", options.engine);
  if (options.no_config && !options.config.empty()) {
    refuse("--no-config", "--config", "together with it");
  }
  if (!raw.packs.empty()) options.packs.clear();
  for (const std::string& pack : raw.packs) {
    options.packs.push_back(parse_pack("--pack", pack));
  }
  for (const std::string& rule : raw.rules) {
    options.rules.push_back(parse_rule(rule));
  }
  check_board(options.replay_on);
}

/// What rungproof.toml says, too, and where that is.
void add_lint_options(CLI::App& app, RawOptions& raw, Options& options) {
  app.add_option("--config", options.config,
                 "this configuration; else the nearest rungproof.toml");
  app.add_flag("--no-config", options.no_config, "no configuration");
  app.add_option("--pack", raw.packs,
                 "rules of this pack only; repeatable: default, safety, "
                 "pedantic")
      ->allow_extra_args(false);
  app.add_option("--rule", raw.rules,
                 "NAME=SEVERITY, repeatable: off, note, warning, error")
      ->allow_extra_args(false);
  app.add_option("--baseline", options.baseline,
                 "findings that are in this file do not count");
}

void add_common(CLI::App& app, RawOptions& raw, Options& options) {
  app.add_option("--format", raw.formats,
                 "FMT[:FILE], repeatable: text, json, jsonl, sarif, junit, "
                 "github, gitlab, html")
      ->allow_extra_args(false);
  app.add_option("--scan", raw.scan, "MIN..MAX: ms that a scan takes");
  app.add_option("--semantics", options.semantics,
                 "what the language means, as a tool has it: yun, sim, iec...");
  app.add_flag("--stable-inputs", options.stable_inputs,
               "inputs do not change in a scan, also where each read samples");
  app.add_flag("--rollover", options.rollover,
               "the controller's clock of 32 bits begins anew after 49.7 days");
  app.add_option("--pou", options.pou,
                 "the unit that is the program (languages of IEC 61131-3)");
  app.add_option("--dialect", options.dialect, "of scripts: yun, sim");
  app.add_option("--language", options.language,
                 "of the input; else recognised by its content");
  app.add_option("--props", options.props, "property lines in a file");
  app.add_option("--timeout", options.timeout, "seconds for one program");
  app.add_option("--engine", options.engine, "one engine instead of all");
  app.add_option("--jobs", options.jobs, "programs, or parts of one, at a time")
      ->check(CLI::Range(1U, 1024U));
  app.add_option("--fail-on", raw.fail_on,
                 "exit 1 for findings from here: note, warning, error");
  add_lint_options(app, raw, options);
  app.add_option("--color", raw.colour, "auto, always, never");
  app.add_flag("--quiet,-q", raw.quiet, "problems only");
  app.add_flag("--verbose,-v", raw.verbose, "a line for every obligation");
  app.add_option("--property", options.properties,
                 "this property only; repeatable")
      ->allow_extra_args(false);
  app.add_option("--self-check", raw.self_check,
                 "off: traces are not replayed, certificates not re-checked");
  app.add_option("--recheck", options.recheck,
                 "cvc5, z3: re-check certificates with it as well");
  app.add_option("--certificates", options.certificates,
                 "write certificates as SMT-LIB files into this directory");
  app.add_option("--cache", options.cache,
                 "DIR, on, off: keep answers, and give them again")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return text.empty() ? "a directory is missing" : "";
          },
          ""));
  app.add_flag("--explain", options.explain,
               "why a property is violated, a proved repair, proofs in words");
  app.add_option("--map", raw.map, "a=b: signal a of the first is b")
      ->allow_extra_args(false);
  app.add_option("--inject", raw.inject, "")
      ->group("")
      ->allow_extra_args(false);
}

CLI::App* add_command(CLI::App& app, const std::string& name,
                      const std::string& summary) {
  CLI::App* command = app.add_subcommand(name, summary);
  command->fallthrough();
  return command;
}

void add_files(CLI::App* command, Options& options, int least, int most) {
  command->add_option("FILE", options.files, "programs; - is standard input")
      ->required()
      ->expected(least, most);
}

constexpr int kMany = 1 << 24;
constexpr unsigned kMostDelay = 64;

void add_equiv(CLI::App& app, Options& options) {
  CLI::App* equiv = add_command(app, "equiv", "are two programs the same?");
  add_files(equiv, options, 1, 2);
  equiv
      ->add_option("--rung", options.rungs,
                   "compare this output only; repeatable")
      ->allow_extra_args(false);
  equiv
      ->add_option("--delay", options.delay,
                   "the second may lag behind by up to so many scans")
      ->check(CLI::Range(0U, kMostDelay));
  equiv->add_flag("--settled", options.settled,
                  "compare where nothing moves any more");
  equiv->add_option("--git", options.revision,
                    "REV: compare the file as it is in that commit with it");
}

constexpr double kLongestWait = 3600;

void add_link(CLI::App* command, Options& options) {
  command->add_option("--port", options.port, "a serial port");
  command->add_option("--tcp", options.tcp, "HOST:PORT instead");
  command->add_option("--baud", options.baud, "speed of the port (115200)");
  command->add_option("--wait", options.wait, "seconds for an answer (5)")
      ->check(CLI::Range(0.01, kLongestWait));
}

/// The commands that speak with a controller.
void add_links(CLI::App& app, RawOptions& raw, Options& options) {
  CLI::App* upload =
      add_command(app, "upload", "replace the program of a running controller");
  add_files(upload, options, 1, 1);
  add_link(upload, options);
  upload->add_flag("--clear-outputs", options.clear_outputs,
                   "safe values until the new program's first scan");
  CLI::App* monitor =
      add_command(app, "monitor", "the values in a running controller");
  add_link(monitor, options);
  monitor->add_option("--scans", raw.scans, "how many scans; else until ^C");
}

/// What goes with `lint`.
void add_lint_commands(CLI::App& app, RawOptions& raw, Options& options) {
  CLI::App* baseline = add_command(
      app, "baseline", "findings that are known: write, prune, check");
  baseline->add_option("ACTION", options.action, "write, prune or check")
      ->required()
      ->check(CLI::IsMember({"write", "prune", "check"}));
  add_files(baseline, options, 1, kMany);
  baseline->add_flag("--accept-new", options.accept_new,
                     "write: also what the baseline does not have yet");
  CLI::App* config =
      add_command(app, "config", "the configuration of a file, and its origin");
  config->add_option("ACTION", options.action, "show")
      ->required()
      ->check(CLI::IsMember({"show"}));
  config->add_option("FILE", raw.file, "a program; else any of this directory");
}

void add_server(CLI::App& app) {
  add_command(app, "lsp", "serve an editor, by the language server protocol")
      ->add_flag("--stdio")
      ->description("what editors say; there is no other way");
}

/// The command that reports all, and the lock that it may compare with.
void add_check(CLI::App& app, Options& options) {
  CLI::App* check =
      add_command(app, "check", "findings and proofs, one report");
  add_files(check, options, 1, kMany);
  check->add_flag(fmt::format("--locked{{{}}}", kLockName), options.locked,
                  "behaviour is as in the lock, or in --locked=FILE");
  CLI::App* lock =
      add_command(app, "lock", "write down what is proved of programs");
  add_files(lock, options, 1, kMany);
  lock->add_option("-o,--output", options.output, "the lock (rungproof.lock)");
  lock->add_flag("--update", options.update,
                 "write it anew, and say what has changed");
}

void add_commands(CLI::App& app, RawOptions& raw, Options& options) {
  add_check(app, options);
  CLI::App* lint = add_command(app, "lint", "findings only");
  add_files(lint, options, 1, kMany);
  lint->add_flag("--fix", options.fix,
                 "apply the fixes after which the program is proved the same");
  lint->add_flag("--diff", options.diff,
                 "print what --fix would change, and change nothing");
  CLI::App* prove = add_command(app, "prove", "properties only");
  add_files(prove, options, 1, kMany);
  prove->add_flag("--sweep", options.sweep,
                  "under every preset of semantics that fits the language");
  prove->add_option("--replay-on", options.replay_on,
                    "execute violations on an emulated board: uno, yun, arm");
  prove->add_option("--traces", options.traces,
                    "write runs into this directory: VCD, WaveJSON, stimulus");
  add_equiv(app, options);
  CLI::App* bound =
      add_command(app, "bound", "how long from P to Q, at worst and at best");
  bound->add_option("FILE", raw.file, "a program; - is standard input")
      ->required();
  bound->add_option("QUESTION", options.question, "P -> Q")->required();
  CLI::App* lower =
      add_command(app, "lower", "write a program in another language");
  add_files(lower, options, 1, 1);
  lower
      ->add_option("--to", options.to,
                   "the language: postfix, il-iec, st, script, il-mitsubishi, "
                   "ascii, plcopen, plclib")
      ->required();
  lower->add_option("-o,--output", options.output, "the file to write");
  lower->add_flag("--binary", options.binary,
                  "postfix: the bytes that a controller executes");
  lower->add_flag("--header", options.header,
                  "postfix: these bytes as an array that a sketch includes");
  lower->add_flag("--report", options.report,
                  "postfix: what it takes on a controller; written is only "
                  "what --output names");
  CLI::App* to_checker = add_command(
      app, "export", "what is to be proved, for other model checkers");
  add_files(to_checker, options, 1, 1);
  to_checker->add_option("--to", options.to, "the format: aiger, btor2, chc")
      ->required();
  to_checker->add_option("-o,--output", options.output, "the file to write");
  CLI::App* run = add_command(app, "run", "simulate");
  add_files(run, options, 1, 1);
  run->add_option("--stimulus", options.stimulus, "inputs, scan by scan (CSV)");
  run->add_option("--scans", raw.scans, "how many scans");
  run->add_option("--dt", raw.dt, "ms that a scan takes");
  run->add_option("--out", options.output, "a VCD file for wave viewers");
  CLI::App* render = add_command(app, "render", "draw the ladder");
  add_files(render, options, 1, 1);
  render->add_flag("--ascii", options.ascii, "no box-drawing characters");
  add_links(app, raw, options);
  add_lint_commands(app, raw, options);
  add_server(app);
  CLI::App* rule = add_command(app, "rule", "what a lint rule finds, and why");
  rule->add_option("CODE", options.rule, "a code or a name; else a list");
}

constexpr std::string_view kCommandNames[] = {
    "check", "lint",   "prove",   "equiv",    "bound",  "lower",
    "run",   "export", "render",  "baseline", "config", "lock",
    "rule",  "upload", "monitor", "lsp"};

/// CLI11 would say that a command is missing, and not which ones there are.
std::optional<std::string> unknown_command(int argc, char** argv) {
  if (argc < 2) {
    return fmt::format("a command is missing: {}",
                       fmt::join(kCommandNames, ", "));
  }
  if (argv[1][0] == '-') return std::nullopt;
  const std::string_view wanted = argv[1];
  const std::vector<std::string_view> known(std::begin(kCommandNames),
                                            std::end(kCommandNames));
  if (std::find(known.begin(), known.end(), wanted) != known.end()) {
    return std::nullopt;
  }
  std::error_code ignored;
  if (std::filesystem::exists(wanted, ignored)) {
    return fmt::format("`{0}` is a file: rungproof check {0}", wanted);
  }
  return fmt::format("there is no command `{}`{}", wanted,
                     did_you_mean(wanted, known));
}

/// Each value behind its length, so that no two lists are one text.
void note_given(const CLI::App& app, Options& options) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0) continue;
    std::string values;
    for (const std::string& value : option->results()) {
      values += fmt::format("{}:{}", value.size(), value);
    }
    options.given.emplace_back(option->get_name(), std::move(values));
  }
}

std::string version_text() {
  std::string out = fmt::format("rungproof {}", kVersion);
  for (const auto& [name, version] : solver_versions()) {
    out += fmt::format("\n{} {}", name, version);
  }
  return out;
}

}  // namespace

int usage_error(const std::string& message) {
  fmt::print(stderr, "rungproof: error: {}\n", message);
  return kExitUsage;
}

std::variant<Options, int> parse_options(int argc, char** argv) {
  if (const auto error = unknown_command(argc, argv)) {
    return usage_error(*error + "\nRun with --help for more information.");
  }
  Options options;
  RawOptions raw;
  CLI::App app("Proves and checks rung programs.", "rungproof");
  try {
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text);
    add_common(app, raw, options);
    add_commands(app, raw, options);
    app.parse(argc, argv);
    const CLI::App& command = *app.get_subcommands().front();
    options.command = command.get_name();
    note_given(app, options);
    note_given(command, options);
    check_texts(raw, options);
    return options;
  } catch (const BadValue& error) {
    return usage_error(std::string(error.what()) +
                       "\nRun with --help for more information.");
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::Error& error) {
    return usage_error(std::string(error.what()) +
                       "\nRun with --help for more information.");
  }
}

}  // namespace rung
