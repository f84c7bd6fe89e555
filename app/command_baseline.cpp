#include <fmt/format.h>

#include <algorithm>

#include "app/baselines.h"
#include "app/check_run.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "reports/explain.h"

namespace rung {
namespace {

using Used = Baselines::Used;

std::string shown(const BaselineEntry& entry) {
  return fmt::format("  {}: {} {}: {}\n", entry.file, entry.code, entry.rule,
                     entry.message);
}

/// Entries of `some` that are not in `all`.
std::vector<BaselineEntry> without(const Baseline& some, const Baseline& all) {
  std::vector<BaselineEntry> left;
  for (const BaselineEntry& entry : some.entries) {
    if (all.find(entry) == nullptr) left.push_back(entry);
  }
  return left;
}

void complain(const std::string& what,
              const std::vector<BaselineEntry>& entries) {
  std::string text = fmt::format("rungproof: error: {}\n", what);
  for (const BaselineEntry& entry : entries) text += shown(entry);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// What the inputs' findings are now, and what is kept about other files.
Baseline baseline_now(const Baselines& baselines, const Used& used,
                      const Report& report, const Session& session) {
  std::vector<BaselineEntry> entries;
  const Baseline gone = make_baseline(baselines.stale(used, report));
  for (const BaselineEntry& entry : used.baseline.entries) {
    if (gone.find(entry) == nullptr) entries.push_back(entry);
  }
  for (const std::size_t i : used.inputs) {
    const FileReport& file = report.files[i];
    const std::vector<Diagnostic> all = all_findings(file);
    const std::vector<BaselineEntry> now =
        entries_of(session.sources(), file, baselines.path_in(used, i));
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool allowed =
          all[k].waiver && all[k].waiver->kind == Waiver::Kind::InSource;
      if (!allowed) entries.push_back(now[k]);
    }
  }
  return make_baseline(std::move(entries));
}

int save(const Used& used, const Baseline& baseline, const std::string& said) {
  if (const auto error = write_file(used.path, write_baseline(baseline))) {
    return output_error(used.path, *error);
  }
  return print_out(said) ? 0 : kExitUsage;
}

int write(const Used& used, const Baseline& now, bool accept_new) {
  const std::vector<BaselineEntry> added = without(now, used.baseline);
  const std::size_t gone = without(used.baseline, now).size();
  if (used.exists && !added.empty() && !accept_new) {
    complain(fmt::format("{} {} not in {}; --accept-new takes {} in",
                         quantity(added.size(), "finding"),
                         added.size() == 1 ? "is" : "are", used.path,
                         added.size() == 1 ? "it" : "them"),
             added);
    return 1;
  }
  return save(
      used, now,
      fmt::format("{}: {}, {} new, {} gone\n", used.path,
                  quantity(now.entries.size(), "finding"), added.size(), gone));
}

int prune(const Used& used, const std::vector<BaselineEntry>& stale) {
  if (stale.empty()) {
    return print_out(
               fmt::format("{}: {}, none gone\n", used.path,
                           quantity(used.baseline.entries.size(), "finding")))
               ? 0
               : kExitUsage;
  }
  const Baseline left =
      make_baseline(without(used.baseline, make_baseline(stale)));
  return save(
      used, left,
      fmt::format("{}: {}, {} gone\n", used.path,
                  quantity(left.entries.size(), "finding"), stale.size()));
}

bool has_input_errors(const Report& report) {
  return summarise(report).input_errors > 0;
}

/// What cannot be read has findings that nobody knows. They are told alone:
/// among hundreds of others nobody would see them.
int refuse_input_errors(Report& report, const Options& options) {
  for (FileReport& file : report.files) {
    std::erase_if(file.findings, [](const Diagnostic& finding) {
      return !is_input_error(finding);
    });
  }
  emit(report, options);
  return usage_error(
      "the baseline stays as it is: what cannot be read has findings that "
      "nobody knows");
}

}  // namespace

int run_baseline(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  Baselines baselines(session, options.action == "write");
  if (baselines.error()) return usage_error(*baselines.error());
  if (baselines.used().empty()) {
    return usage_error(
        "no baseline is named: --baseline FILE, or `baseline = \"FILE\"` in "
        "rungproof.toml");
  }
  Report report = lint_inputs(session);
  baselines.compare(report);
  int status = 0;
  if (options.action == "check") {
    status = emit(report, options);
  } else if (has_input_errors(report)) {
    return refuse_input_errors(report, options);
  }
  for (const Used& used : baselines.used()) {
    const std::vector<BaselineEntry> stale = baselines.stale(used, report);
    if (options.action == "write") {
      const Baseline now = baseline_now(baselines, used, report, session);
      status = std::max(status, write(used, now, options.accept_new));
    } else if (options.action == "prune") {
      status = std::max(status, prune(used, stale));
    } else if (!stale.empty()) {
      complain(fmt::format("{} of {} {} gone; `rungproof baseline prune` drops "
                           "{}",
                           quantity(stale.size(), "finding"), used.path,
                           stale.size() == 1 ? "is" : "are",
                           stale.size() == 1 ? "it" : "them"),
               stale);
      status = std::max(status, 1);
    }
  }
  return status;
}

}  // namespace rung
