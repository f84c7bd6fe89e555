#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "analysis/property_line.h"
#include "app/inputs.h"
#include "app/load.h"
#include "app/options.h"
#include "app/version.h"
#include "base/diagnostic.h"
#include "check/check.h"
#include "check/solver.h"

namespace rung::check {
namespace {

constexpr int kConfirmed = 0;
constexpr int kRejected = 1;
constexpr int kBadInput = 2;
constexpr int kOpen = 3;

struct Command {
  std::vector<std::string> files;  // one or two sources, and the result
  std::string solver = "z3";
  std::string scan;
  std::vector<std::pair<std::string, std::string>> map;
  std::vector<std::string> properties;
  double seconds = 60;
  Options reading;  // how the source is to be read, as for `prove`
};

int bad_input(const std::string& message) {
  fmt::print(stderr, "rungproof-check: error: {}\n", message);
  return kBadInput;
}

void add_options(CLI::App& app, Command& command) {
  app.add_option("FILES", command.files,
                 "the program, or the two that were compared, and what "
                 "`rungproof prove` or `equiv` wrote with --format json")
      ->expected(2, 3)
      ->required();
  app.add_option("--solver", command.solver, "z3 (default) or cvc5, from PATH")
      ->check(CLI::IsMember({"z3", "cvc5"}));
  app.add_option("--property", command.properties,
                 "this property only; repeatable")
      ->allow_extra_args(false);
  app.add_option("--timeout", command.seconds, "seconds for the solver")
      ->check(CLI::Range(0.001, 1e6));
  Options& reading = command.reading;
  app.add_option("--scan", command.scan, "as for `rungproof prove`");
  app.add_option("--semantics", reading.semantics, "as for `rungproof prove`");
  app.add_option("--dialect", reading.dialect, "as for `rungproof prove`");
  app.add_option("--language", reading.language, "as for `rungproof prove`");
  app.add_option("--pou", reading.pou, "as for `rungproof prove`");
  app.add_option("--props", reading.props, "as for `rungproof prove`");
  app.add_flag("--rollover", reading.rollover, "as for `rungproof prove`");
  app.add_flag("--stable-inputs", reading.stable_inputs,
               "as for `rungproof prove`");
  app.set_version_flag("--version", fmt::format("rungproof {}", kVersion));
}

/// `1..100`, `1..100ms`: what a property line may say behind `scan`.
bool read_scan(Command& command) {
  if (command.scan.empty()) return true;
  std::string line = "scan " + command.scan;
  if (!line.ends_with("s")) line += " ms";
  DiagnosticList ignored;
  const auto statement = parse_statement({line, {}}, ignored);
  if (!statement || statement->kind != Statement::Kind::Scan) return false;
  command.reading.scan = {statement->low, statement->high};
  return true;
}

/// Errors of the source, where it is not a program.
int report_errors(const FileReport& report, const SourceSet& sources) {
  for (const Diagnostic& error : report.findings) {
    if (error.severity != Severity::Error) continue;
    std::string place = report.path;
    if (error.where.has_value()) {
      const LineColumn at =
          sources[error.where.file].position(error.where.begin);
      place += fmt::format(":{}:{}", at.line, at.column);
    }
    fmt::print(stderr, "{}: {}: {}\n", place, error.code, error.message);
  }
  return kBadInput;
}

/// What the result is about, where that is something else than the source.
std::string difference(const ClaimedResult& claimed, const FileReport& read,
                       const Program& program) {
  if (claimed.language != read.language) {
    return fmt::format("language `{}`, and this is `{}`", claimed.language,
                       read.language);
  }
  if (claimed.semantics != read.semantics || claimed.dialect != read.dialect) {
    return fmt::format("semantics `{}`, and this is `{}`", claimed.semantics,
                       read.semantics);
  }
  if (claimed.scan_min_ms != program.scan.min_ms ||
      claimed.scan_max_ms != program.scan.max_ms) {
    return fmt::format("scans of {}..{} ms, and these are of {}..{} ms",
                       claimed.scan_min_ms, claimed.scan_max_ms,
                       program.scan.min_ms, program.scan.max_ms);
  }
  return {};
}

std::string unknown_name(const Command& command, const ClaimedResult& claimed) {
  for (const std::string& name : command.properties) {
    const bool found = std::any_of(
        claimed.properties.begin(), claimed.properties.end(),
        [&](const ClaimedProperty& one) { return one.name == name; });
    if (!found) return name;
  }
  return {};
}

int conclude(const std::vector<Checked>& checked, const Program& program,
             const FileReport& read) {
  std::size_t count[5] = {0, 0, 0, 0, 0};
  for (const Checked& one : checked) {
    ++count[static_cast<std::size_t>(one.outcome)];
    if (one.outcome == Outcome::Open) continue;
    fmt::print("{}: {}{}{}\n", to_string(one.outcome), one.name,
               one.reason.empty() ? "" : ": ", one.reason);
  }
  const auto of = [&](Outcome outcome) {
    return count[static_cast<std::size_t>(outcome)];
  };
  fmt::print(
      "{} confirmed, {} rejected, {} not checked; {} shown by runs, which "
      "the replay has checked ({}, scans of {}..{} ms)\n",
      of(Outcome::Confirmed), of(Outcome::Rejected), of(Outcome::NotChecked),
      of(Outcome::ByRun), read.semantics, program.scan.min_ms,
      program.scan.max_ms);
  if (of(Outcome::Rejected) > 0) return kRejected;
  return of(Outcome::NotChecked) > 0 ? kOpen : kConfirmed;
}

int check_claims(const Command& command, const ClaimedResult& claimed,
                 Claims claims, const Loaded& loaded) {
  const CertificateCheck check(std::move(claims), claimed, command.properties);
  Answers answers;
  if (!check.scripts().empty()) {
    answers = ask_solver(command.solver, check.scripts(), command.seconds);
  }
  // A failure in the middle: what was said before it is not to be trusted.
  if (!answers.error.empty()) answers.list.clear();
  return conclude(check.conclude(answers.list, answers.error), *loaded.program,
                  loaded.report);
}

int check_properties(const Command& command, const ClaimedResult& claimed,
                     const Loaded& loaded) {
  const std::string other = difference(claimed, loaded.report, *loaded.program);
  if (!other.empty()) {
    fmt::print("rejected: the result is about {}\n", other);
    return kRejected;
  }
  return check_claims(command, claimed,
                      claims_of(*loaded.program, loaded.report.properties),
                      loaded);
}

int check_equivalence(const Command& command, const ClaimedResult& claimed,
                      const std::vector<Loaded>& loaded) {
  if (claimed.is_settled) {
    fmt::print("not checked: `equiv --settled` is not known here\n");
    return kOpen;
  }
  Claims claims = claims_of({*loaded[0].program, loaded[0].report.properties},
                            {*loaded[1].program, loaded[1].report.properties},
                            command.map, claimed);
  if (!claims.error.empty()) {
    fmt::print("rejected: {}\n", claims.error);
    return kRejected;
  }
  return check_claims(command, claimed, std::move(claims), loaded[0]);
}

/// `a=b`, as for `rungproof equiv`.
bool read_map(Command& command, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals >= text.size() - 1) return false;
    command.map.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return true;
}

/// The sources; less than were named where one is no program.
std::vector<Loaded> load_sources(const Command& command, SourceSet& sources,
                                 int& status) {
  std::vector<AstAnnotation> extra;
  std::vector<Loaded> all;
  if (!command.reading.props.empty()) {
    const Input lines = read_input(command.reading.props, sources);
    if (lines.error) {
      status = bad_input(lines.error->message);
      return all;
    }
    extra = property_lines(sources, lines.file);
  }
  for (std::size_t i = 0; i + 1 < command.files.size(); ++i) {
    const Input source = read_input(command.files[i], sources);
    Loaded loaded = load(source, command.reading, extra, sources);
    if (!loaded.program) {
      status = report_errors(loaded.report, sources);
      return all;
    }
    all.push_back(std::move(loaded));
  }
  return all;
}

int run(const Command& command) {
  SourceSet sources;
  const Input result = read_input(command.files.back(), sources);
  if (result.error) return bad_input(result.error->message);
  const ClaimedResult claimed = read_result(sources[result.file].text());
  if (!claimed.error.empty()) {
    return bad_input(command.files.back() + ": " + claimed.error);
  }
  const std::size_t wanted = claimed.is_equivalence ? 2 : 1;
  if (command.files.size() != wanted + 1) {
    return bad_input(fmt::format("the result is about {} program{}", wanted,
                                 wanted == 1 ? "" : "s"));
  }
  const std::string unknown = unknown_name(command, claimed);
  if (!unknown.empty()) {
    return bad_input("the result has no property `" + unknown + "`");
  }
  int status = kBadInput;
  const std::vector<Loaded> loaded = load_sources(command, sources, status);
  if (loaded.size() != wanted) return status;
  return claimed.is_equivalence ? check_equivalence(command, claimed, loaded)
                                : check_properties(command, claimed, loaded[0]);
}

int run(int argc, char** argv) {
  CLI::App app("Re-checks the proofs of rungproof against the source.",
               "rungproof-check");
  Command command;
  std::vector<std::string> map;
  add_options(app, command);
  app.add_option("--map", map, "as for `rungproof equiv`")
      ->allow_extra_args(false);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::Error& error) {
    return bad_input(std::string(error.what()));
  }
  if (!read_scan(command)) return bad_input("--scan: MIN..MAX is expected");
  if (!read_map(command, map)) return bad_input("--map: a=b is expected");
  return run(command);
}

}  // namespace
}  // namespace rung::check

int main(int argc, char** argv) {
  try {
    return rung::check::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rungproof-check: internal error: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "rungproof-check: internal error\n");
  }
  return rung::kExitInternal;  // nothing was confirmed
}
