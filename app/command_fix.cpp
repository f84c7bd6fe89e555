#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "app/commands.h"
#include "app/fixer.h"
#include "app/output.h"
#include "app/session.h"
#include "app/unified_diff.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

/// On standard error: what `--format` asks for is not to be mixed with it.
void tell(const std::string& path, const FixedText& fixed) {
  std::size_t applied = 0;
  for (const FixRecord& it : fixed.records) {
    applied += it.applied ? 1U : 0U;
    fmt::print(stderr, "{}: {}: {}: {}{}\n", it.where, it.finding, it.title,
               it.applied ? "" : "not applied: ", it.reason);
  }
  if (!fixed.failure.empty()) {
    fmt::print(stderr, "{}: {}\n", path, fixed.failure);
  }
  fmt::print(stderr, "{}: {} fix{} applied, {} not{}\n", path, applied,
             applied == 1 ? "" : "es", fixed.records.size() - applied,
             applied == 0 ? ""
                          : "; the program after them is proved to do the "
                            "same");
}

/// In the place of the file, not of a link to it, and with its permissions.
std::optional<std::string> replace_file(const std::string& path,
                                        const std::string& text) {
  std::error_code error;
  const fs::path file = fs::canonical(path, error);
  if (error) return error.message();
  const fs::perms permissions = fs::status(file, error).permissions();
  if (error) return error.message();
  if (auto failed = write_file(file.string(), text)) return failed;
  fs::permissions(file, permissions, error);
  return error ? std::optional<std::string>(error.message()) : std::nullopt;
}

class FixRun {
 public:
  FixRun(Session& session, const Options& options)
      : session_(session), options_(options) {}

  /// 0, or kExitUsage when a file could not be read or written.
  int run() {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < session_.inputs().size(); ++i) {
      const Input& input = session_.inputs()[i];
      std::error_code ignored;
      const fs::path file = fs::weakly_canonical(input.path, ignored);
      if (!seen.insert(file.string()).second) continue;
      fix(i, input);
    }
    return status_;
  }

  bool changed() const { return changed_; }

 private:
  void fix(std::size_t index, const Input& input) {
    const Loaded loaded = session_.load(input);
    if (!loaded.program) {
      status_ = kExitUsage;
      // Of `lint --fix` the report that follows has the errors.
      if (options_.diff) {
        print_input_errors(session_.sources(), loaded.report, options_);
      }
      return;
    }
    const std::string text(session_.sources()[input.file].text());
    const FixedText fixed =
        fix_text(input.path, text, session_.options_of(index), session_.extra(),
                 session_.verify_options(index));
    tell(input.path, fixed);
    if (fixed.text == text) return;
    changed_ = true;
    if (options_.diff) {
      if (!print_out(unified_diff(input.path, text, fixed.text))) {
        status_ = kExitUsage;
      }
      return;
    }
    if (const auto error = replace_file(input.path, fixed.text)) {
      status_ = output_error(input.path, *error);
    }
  }

  Session& session_;
  const Options& options_;
  int status_ = 0;
  bool changed_ = false;
};

}  // namespace

int run_lint(const Options& options) {
  if (!options.fix && !options.diff) return run_check(options);
  if (options.fix && options.diff) {
    return usage_error("--diff shows what --fix would do: give one of them");
  }
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  const bool piped = std::find(options.files.begin(), options.files.end(),
                               "-") != options.files.end();
  if (options.fix && piped) {
    return usage_error("--fix changes files, and standard input is none");
  }
  FixRun run(session, options);
  const int status = run.run();
  if (options.diff) return status != 0 ? status : (run.changed() ? 1 : 0);
  return std::max(status, run_check(options));
}

}  // namespace rung
