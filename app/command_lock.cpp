#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/behaviour.h"
#include "app/commands.h"
#include "app/locks.h"
#include "app/output.h"
#include "app/session.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    // A comma is there for the line behind it.
    const bool has_comma = end > at && text[end - 1] == ',';
    lines.push_back(text.substr(at, end - at - (has_comma ? 1 : 0)));
    at = end + 1;
  }
  return lines;
}

/// What changes of one program, line by line: gone ones and new ones.
std::string difference(const std::string& path, const Lock& before,
                       const Lock& after) {
  const auto only = [&](const Lock& lock) {
    const auto found = lock.programs.find(path);
    Lock one;
    if (found != lock.programs.end()) one.programs.insert(*found);
    return lines_of(write_lock(one));
  };
  const std::vector<std::string> old_lines = only(before);
  const std::vector<std::string> new_lines = only(after);
  std::string text;
  const auto add = [&](const auto& from, const auto& other, char sign) {
    for (const std::string& line : from) {
      const bool is_same =
          std::find(other.begin(), other.end(), line) != other.end();
      if (!is_same) text += fmt::format("{} {}\n", sign, line);
    }
  };
  add(old_lines, new_lines, '-');
  add(new_lines, old_lines, '+');
  return text;
}

/// Every program that is, or was, in the lock and is not as it was.
std::string differences(const Lock& before, const Lock& after) {
  Lock both = before;
  both.programs.insert(after.programs.begin(), after.programs.end());
  std::string text;
  for (const auto& [path, ignored] : both.programs) {
    const std::string lines = difference(path, before, after);
    if (lines.empty()) continue;
    text += fmt::format("{}\n{}", path, lines);
  }
  return text;
}

struct Measured {
  Lock lock;
  int status = 0;
};

void complain(const std::string& path, const Behaviour& behaviour,
              int& status) {
  for (const std::string& open : behaviour.open) {
    fmt::print(stderr, "rungproof: {}: {}, which can not be locked\n", path,
               open);
    status = std::max(status, kExitOpen);
  }
  for (const SelfCheckFailure& failure : behaviour.failures) {
    fmt::print(stderr, "rungproof: {}: self-check failed: {}: {}\n", path,
               failure.obligation, failure.what);
    status = kExitInternal;
  }
}

Measured measure_all(Session& session, const std::string& lock_path) {
  Measured measured;
  for (std::size_t i = 0; i < session.inputs().size(); ++i) {
    const Input& input = session.inputs()[i];
    const Loaded loaded = session.load(input);
    if (!loaded.program) {
      measured.status = std::max(
          measured.status, print_input_errors(session.sources(), loaded.report,
                                              session.options()));
      continue;
    }
    Behaviour behaviour = measure(loaded.report, session.verify_options(i));
    complain(input.path, behaviour, measured.status);
    measured.lock.programs[locked_path(input.path, lock_path)] =
        std::move(behaviour.locked);
  }
  return measured;
}

}  // namespace

int run_lock(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  const std::string path =
      options.output.empty() ? std::string(kLockName) : options.output;
  std::error_code ignored;
  const bool is_there = fs::exists(path, ignored);
  if (is_there && !options.update) {
    return usage_error(path +
                       " is there: `--update` writes it anew, and "
                       "`check --locked` compares with it");
  }
  Lock before;
  if (is_there) {
    auto read = load_lock(path);
    if (const auto* error = std::get_if<std::string>(&read)) {
      return usage_error(*error + "; remove it to begin anew");
    }
    before = std::get<Lock>(std::move(read));
  }
  const Measured measured = measure_all(session, path);
  if (measured.status != 0) {
    fmt::print(stderr, "rungproof: nothing is written\n");
    return measured.status;
  }
  if (const auto error = write_file(path, write_lock(measured.lock))) {
    return output_error(path, *error);
  }
  const std::size_t count = measured.lock.programs.size();
  std::string said = is_there ? differences(before, measured.lock) : "";
  said += fmt::format("{}: {} program{} locked{}\n", path, count,
                      count == 1 ? "" : "s",
                      is_there && said.empty() ? ", as before" : "");
  return print_out(said) ? 0 : kExitUsage;
}

}  // namespace rung
