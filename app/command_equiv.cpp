#include <algorithm>
#include <chrono>

#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "app/version.h"
#include "reports/explain.h"
#include "smt/blame.h"
#include "smt/equivalence.h"

namespace rung {
namespace {

std::string_view to_word(EquivalenceVerdict verdict) {
  switch (verdict) {
    case EquivalenceVerdict::Equivalent:
      return "equivalent";
    case EquivalenceVerdict::Different:
      return "different";
    case EquivalenceVerdict::Bounded:
      return "bounded";
    case EquivalenceVerdict::Unknown:
      return "unknown";
  }
  return "unknown";
}

EquivalenceReport empty_report(Session& session) {
  EquivalenceReport report;
  report.sources = &session.sources();
  report.version = kVersion;
  report.solvers = solver_versions();
  report.working_directory = working_directory();
  report.self_check = session.options().self_check;
  report.map = session.options().map;
  report.settled = session.options().settled;
  return report;
}

/// Only runs that both programs allow are compared. What just one of them
/// assumes is said: the other may be meant for more.
void note_assumptions(const Loaded& one, const Loaded& other,
                      EquivalenceReport& report) {
  const auto& known = other.report.properties.assumptions;
  for (const std::string& text : one.report.properties.assumptions) {
    if (std::find(known.begin(), known.end(), text) != known.end()) continue;
    report.notes.push_back("compared only where `" + text +
                           "` holds: " + one.report.path + " assumes it, " +
                           other.report.path + " does not");
  }
}

void take(EquivalenceResult result, EquivalenceReport& report) {
  report.verdict = to_word(result.verdict);
  report.outputs = std::move(result.outputs);
  for (const std::string& name : result.not_compared) {
    report.notes.push_back("`" + name +
                           "` is not compared: the other program has no "
                           "output of that name");
  }
  for (const std::string& name : result.also_different) {
    report.notes.push_back("`" + name + "` differs too, in another run");
  }
  report.delay = result.delay;
  if (result.delay > 0) {
    report.notes.push_back("the second program lags behind by " +
                           quantity(result.delay, "scan"));
  }
  report.engine = std::move(result.engine);
  report.reason = std::move(result.reason);
  report.certificate = std::move(result.certificate);
  report.trace_a = std::move(result.trace_a);
  report.trace_b = std::move(result.trace_b);
  report.failures = std::move(result.failures);
  if (report.trace_a && !report.trace_a->steps.empty()) {
    report.scans = report.trace_a->steps.back().scan;
  }
}

/// A search on top of the answer: it ends soon, found or not.
void search_repair(const Program& a, const Program& b,
                   const EquivalenceOptions& options,
                   const EquivalenceResult& result, EquivalenceReport& report) {
  constexpr double kMostSeconds = 3;
  const std::optional<Blame> blame = find_blame(
      a, b, options, result, std::min(kMostSeconds, options.budget.seconds));
  if (!blame) return;
  report.repair = blame->message;
  report.repair_where = blame->where;
}

}  // namespace

int run_equiv(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  const std::size_t named = options.revision.empty() ? 2 : 1;
  if (options.files.size() != named || session.inputs().size() != 2) {
    return usage_error(named == 2
                           ? "equiv takes two programs, and a directory is none"
                           : "equiv --git REV takes one file");
  }
  EquivalenceReport report = empty_report(session);
  Loaded a = session.load(session.inputs()[0]);
  Loaded b = session.load(session.inputs()[1]);
  report.a = a.report;
  report.b = b.report;
  if (!a.program || !b.program) return emit(report, options);
  EquivalenceOptions equivalence;
  equivalence.budget.seconds = options.timeout;
  equivalence.self_check = options.self_check;
  equivalence.map = options.map;
  equivalence.rungs = options.rungs;
  equivalence.delay = options.delay;
  equivalence.settled = options.settled;
  equivalence.assumptions = a.report.properties.assumptions;
  equivalence.assumptions_b = b.report.properties.assumptions;
  equivalence.recheck = options.recheck;
  equivalence.smtlib_directory = options.certificates;
  const auto start = std::chrono::steady_clock::now();
  EquivalenceResult result =
      check_equivalence(*a.program, *b.program, equivalence);
  report.milliseconds = std::chrono::duration<double, std::milli>(
                            std::chrono::steady_clock::now() - start)
                            .count();
  if (!result.error.empty()) return usage_error(result.error);
  // What is to be repaired is the same in every scan.
  const bool plain = !options.settled && options.delay == 0;
  if (plain && result.verdict == EquivalenceVerdict::Different) {
    search_repair(*a.program, *b.program, equivalence, result, report);
  }
  take(std::move(result), report);
  if (options.settled) {
    report.notes.emplace_back(
        "compared only in scans in which nothing moves any more");
  }
  note_assumptions(a, b, report);
  note_assumptions(b, a, report);
  return emit(report, options);
}

}  // namespace rung
