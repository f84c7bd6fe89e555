#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "analysis/rule.h"
#include "app/answer_cache.h"
#include "app/baselines.h"
#include "app/behaviour.h"
#include "app/check_run.h"
#include "app/commands.h"
#include "app/lint.h"
#include "app/locks.h"
#include "app/output.h"
#include "app/select.h"
#include "app/session.h"
#include "app/sweep.h"
#include "app/trace_files.h"
#include "app/version.h"
#include "boards/replay.h"
#include "smt/repair.h"

namespace rung {
namespace {

/// Which property of `all` is it?
std::uint32_t index_in(const PropertySet& all, const Property& property) {
  const auto found = std::find_if(
      all.properties.begin(), all.properties.end(),
      [&](const Property& other) { return other.name == property.name; });
  return static_cast<std::uint32_t>(found - all.properties.begin());
}

/// Why the violations come about, and what would repair them.
void explain(const Program& program, const PropertySet& all,
             const Options& options, const VerifyOptions& verify_options,
             FileReport& report) {
  constexpr std::size_t kMostRepairs = 4;
  constexpr double kMostSeconds = 10;
  report.explained = true;
  std::optional<std::vector<ObligationResult>> before;
  for (const ObligationResult& result : report.results) {
    const bool has_run = result.verdict == Verdict::Violated && result.trace &&
                         result.obligation.goal == Goal::Invariant;
    if (!has_run) continue;
    const Obligation& obligation = result.obligation;
    Explanation why =
        explain_run(program, report.properties, obligation.property,
                    obligation.part, *result.trace);
    why.obligation = obligation.name;
    if (report.explanations.size() < kMostRepairs) {
      if (!before) {
        before = options.properties.empty()
                     ? report.results
                     : verify(program, all, verify_options).results;
      }
      why.repair = find_repair(
          program, all, *before, result,
          index_in(all, report.properties.properties[obligation.property]),
          why.blamed, verify_options,
          std::min(kMostSeconds, verify_options.budget.seconds));
    }
    report.explanations.push_back(std::move(why));
  }
}

/// Runs the violations on a board, in `seconds` altogether. That one of them
/// differs there is a failed check of the tool's own answer.
void replay(const Program& program, const boards::Emulator& emulator,
            double seconds, FileReport& report) {
  using Outcome = boards::Replayed::Outcome;
  using Clock = std::chrono::steady_clock;
  const std::string board(emulator.board().name);
  const Clock::time_point start = Clock::now();
  for (const ObligationResult& result : report.results) {
    const bool has_run = result.verdict == Verdict::Violated && result.trace &&
                         !result.trace->steps.empty();
    if (!has_run) continue;
    const std::string& name = result.obligation.name;
    const std::chrono::duration<double> used = Clock::now() - start;
    boards::Replayed replayed = boards::replay_on_board(
        emulator, program, *result.trace, seconds - used.count());
    if (replayed.outcome == Outcome::Different) {
      report.failures.push_back(
          {name, fmt::format("{} disagrees with the simulator: {}", board,
                             replayed.what)});
      continue;
    }
    report.replays.push_back({name, board, result.trace->steps.back().scan,
                              std::move(replayed.what)});
  }
}

/// Of `all` properties, those that the report has. `decide`: as verify().
template <class Decide>
void prove(const Program& program, const PropertySet& all, FileReport& report,
           const Options& options, const VerifyOptions& verify_options,
           const Decide& decide) {
  VerifyOptions some = verify_options;
  some.wanted = wanted_by(options.properties);
  VerifyReport answer = decide(some);
  report.results = std::move(answer.results);
  report.failures = std::move(answer.failures);
  if (options.explain) explain(program, all, options, verify_options, report);
}

/// The properties that were asked for by name and that no program has.
std::string missing_properties(const Report& report, const Options& options) {
  std::string missing;
  for (const std::string& wanted : options.properties) {
    bool found = false;
    for (const FileReport& file : report.files) {
      for (const ObligationResult& result : file.results) {
        found = found || is_selected(result.obligation.name, wanted);
      }
    }
    if (!found) missing += fmt::format(" `{}`", wanted);
  }
  return missing;
}

class CheckRun {
 public:
  /// `emulator` may be null: violations are executed nowhere else. `cache` may
  /// be null: nothing is kept. It outlives the report, which points into it.
  /// `lock` may be null: programs may behave as they like.
  CheckRun(Session& session, const boards::Emulator* emulator,
           AnswerCache* cache, const Lock* lock)
      : session_(session), emulator_(emulator), cache_(cache), lock_(lock) {
    const Options& options = session.options();
    report_.sources = &session.sources();
    report_.command = options.command;
    report_.version = kVersion;
    report_.solvers = solver_versions();
    report_.rules = all_rules();
    report_.working_directory = working_directory();
    report_.fail_on = options.fail_on;
    report_.self_check = options.self_check;
    report_.linted = options.command != "prove";
    report_.proved = options.command == "check" || options.command == "prove";
  }

  Report& run() {
    list_readings();
    const std::size_t count = readings_.size();
    report_.files.resize(count);
    const std::size_t workers =
        std::min<std::size_t>(session_.options().jobs, count);
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < workers; ++i) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    if (session_.options().sweep) note_dependent_verdicts(report_);
    return report_;
  }

 private:
  /// One input as one preset has it; empty: as the options say.
  struct Reading {
    std::size_t input = 0;
    std::string_view semantics;
  };

  void list_readings() {
    for (std::size_t i = 0; i < session_.inputs().size(); ++i) {
      std::vector<std::string_view> presets;
      if (session_.options().sweep) {
        presets = session_.presets_of(session_.inputs()[i]);
      }
      if (presets.empty()) presets.emplace_back();
      for (const std::string_view preset : presets) {
        readings_.push_back({i, preset});
      }
    }
  }

  void work() {
    try {
      while (true) {
        const std::size_t i = next_++;
        if (i >= report_.files.size()) return;
        report_.files[i] = check(i);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex_);
      failure_ = std::current_exception();
    }
  }

  FileReport check(std::size_t reading) {
    const std::size_t index = readings_[reading].input;
    const std::string_view preset = readings_[reading].semantics;
    const Options& options = session_.options_of(index);
    Loaded loaded = session_.load(session_.inputs()[index], preset);
    loaded.report.fail_on = options.fail_on;
    if (!loaded.program) return std::move(loaded.report);
    if (!may_know(options) || lock_ != nullptr) {
      answer(reading, loaded);
      return std::move(loaded.report);
    }
    const AnswerCache::Question question =
        cache_->question(session_.sources(), loaded.report,
                         session_.properties_file(), preset, options);
    if (cache_->find(question, loaded.report)) {
      select_properties(loaded.report);
    } else {
      answer(reading, loaded);
      cache_->keep(question, loaded.report);
    }
    return std::move(loaded.report);
  }

  /// A checker of another program is asked each time.
  bool may_know(const Options& options) const {
    return cache_ != nullptr && options.recheck.empty();
  }

  /// Null: the lock does not have it, or there is none.
  const LockedProgram* locked_program(const FileReport& report) const {
    if (lock_ == nullptr) return nullptr;
    const auto found = lock_->programs.find(
        locked_path(report.path, session_.options().locked));
    return found == lock_->programs.end() ? nullptr : &found->second;
  }

  void select_properties(FileReport& report) const {
    if (!report_.proved) return;
    report.properties =
        select(std::move(report.properties), session_.options().properties);
  }

  void answer(std::size_t reading, Loaded& loaded) {
    const std::size_t index = readings_[reading].input;
    const VerifyOptions options = session_.verify_options(index);
    if (report_.linted) {
      const Options& wanted = session_.options_of(index);
      lint(session_.sources(), *loaded.program, loaded.report, options,
           make_selection(wanted.packs, wanted.rules));
    }
    if (report_.proved) {
      const LockedProgram* const locked = locked_program(loaded.report);
      if (locked != nullptr) add_locked(*locked, loaded.report);
      const PropertySet all = loaded.report.properties;
      select_properties(loaded.report);
      FileReport& report = loaded.report;
      const auto decide = [&](const VerifyOptions& some) {
        const Options& own = session_.options_of(index);
        return may_know(own)
                   ? cache_->verify(report, readings_[reading].semantics, own,
                                    some)
                   : verify(*loaded.program, report.properties, some);
      };
      prove(*loaded.program, all, report, session_.options(), options, decide);
      if (lock_ != nullptr) compare_locked(locked, report);
      if (emulator_ != nullptr) {
        replay(*loaded.program, *emulator_, options.budget.seconds,
               loaded.report);
      }
    }
  }

  Session& session_;
  const boards::Emulator* emulator_;
  AnswerCache* cache_;
  const Lock* lock_;
  std::vector<Reading> readings_;
  Report report_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

/// The answer stands; the next run will have to find it again.
void warn_of_cache(const AnswerCache& cache) {
  const std::string failure = cache.failure();
  if (failure.empty()) return;
  fmt::print(stderr, "rungproof: warning: the cache cannot be written: {}\n",
             failure);
}

}  // namespace

Report lint_inputs(Session& session) {
  CheckRun run(session, nullptr, nullptr, nullptr);
  return std::move(run.run());
}

int run_check(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  // What is missing is said before anything is proved.
  std::optional<Baselines> baselines;
  if (options.command != "prove") {
    baselines.emplace(session, false);
    if (baselines->error()) return usage_error(*baselines->error());
  }
  std::optional<boards::Emulator> emulator;
  if (!options.replay_on.empty()) {
    emulator.emplace(*boards::find_board(options.replay_on));
    if (!emulator->error().empty()) {
      return usage_error("--replay-on: " + emulator->error());
    }
  }
  auto cache = AnswerCache::open(options);
  if (const auto* error = std::get_if<std::string>(&cache)) {
    return usage_error(*error);
  }
  AnswerCache* const kept = std::get<std::unique_ptr<AnswerCache>>(cache).get();
  std::variant<Lock, std::string> lock;
  if (!options.locked.empty()) lock = load_lock(options.locked);
  if (const auto* error = std::get_if<std::string>(&lock)) {
    return usage_error(*error);
  }
  CheckRun run(session, emulator ? &*emulator : nullptr, kept,
               options.locked.empty() ? nullptr : std::get_if<Lock>(&lock));
  Report& report = run.run();
  if (baselines) baselines->apply(report);
  int status = emit(report, options);
  if (kept != nullptr) warn_of_cache(*kept);
  if (const auto error = write_traces(report, options.traces)) {
    status = std::max(status, usage_error("--traces: " + *error));
  }
  const std::string missing = missing_properties(report, options);
  if (missing.empty() || !report.proved) return status;
  usage_error("no property is called" + missing);
  return std::max(status, kExitUsage);
}

}  // namespace rung
