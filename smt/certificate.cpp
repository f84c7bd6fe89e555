#include "smt/certificate.h"

#include <z3.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>

#include "smt/components.h"
#include "smt/cvc5.h"
#include "smt/sat.h"
#include "smt/script/decide.h"
#include "smt/script_file.h"
#include "smt/smtlib.h"
#include "smt/z3_script.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

/// Bytes of accepted scripts that a session keeps.
constexpr std::size_t kRemembered = std::size_t{64} << 20;

/// An independent part of a certificate, with its script.
struct Part {
  Invariant invariant;
  CertificateScript script;
  std::string body;  // of the script
};

std::vector<Part> parts_of(const TransitionSystem& ts,
                           const Invariant& invariant) {
  std::vector<Part> parts;
  for (Invariant& part : split_certificate(ts, invariant)) {
    CertificateScript script = make_certificate_script(ts, part);
    std::string body = script.body();
    parts.push_back({std::move(part), std::move(script), std::move(body)});
  }
  return parts;
}

/// What is left of a part without some of its claims; `dropped` are the lemmas
/// that went.
Invariant without(const Part& part, const std::vector<std::uint32_t>& claims,
                  std::vector<LemmaClause>& dropped) {
  std::vector<bool> open(part.script.claims.size(), false);
  for (const std::uint32_t claim : claims) open[claim] = true;
  Invariant rest;
  rest.k = part.invariant.k;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const ScriptClaim& claim = part.script.claims[i];
    if (claim.kind == ScriptClaim::Kind::Lemma) {
      const LemmaClause& lemma = part.invariant.lemmas[claim.index];
      (open[i] ? dropped : rest.lemmas).push_back(lemma);
    } else if (claim.kind == ScriptClaim::Kind::Condition && !open[i]) {
      rest.conditions.push_back(part.invariant.conditions[claim.index]);
    } else if (claim.kind == ScriptClaim::Kind::Consequence && !open[i]) {
      rest.consequences.push_back(part.invariant.consequences[claim.index]);
    }
  }
  return rest;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

Clock::time_point deadline_in(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(
             std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6)));
}

std::string describe(const TransitionSystem& ts, const Invariant& invariant,
                     const CertificateScript& script,
                     const ScriptQuery& query) {
  const ScriptClaim& claim = script.claims[query.claim];
  std::string what(to_string(query.part));
  switch (claim.kind) {
    case ScriptClaim::Kind::Lemma:
      return what + " of lemma `" +
             to_string(ts, invariant.lemmas[claim.index]) + "`";
    case ScriptClaim::Kind::Condition:
      return what + " of `" + to_string(ts, invariant.conditions[claim.index]) +
             "`";
    case ScriptClaim::Kind::Consequence:
      return what + " of the consequence `" +
             to_string(ts, invariant.consequences[claim.index]) + "`";
    case ScriptClaim::Kind::Range:
      return what + " of the range of `" +
             ts.vars[ts.states[claim.index].var].name + "`";
  }
  return what;
}

/// Says which goal no condition states; empty when all are stated.
std::string uncovered_goal(const TransitionSystem& ts,
                           const Invariant& invariant,
                           const std::vector<ExprId>& goals) {
  const std::unordered_set<ExprId> stated(invariant.conditions.begin(),
                                          invariant.conditions.end());
  for (const ExprId goal : goals) {
    if (ts.exprs.is_true(goal) || stated.count(goal) != 0) continue;
    return "it does not speak of `" + to_string(ts, goal) + "`";
  }
  return {};
}

void ask_cvc5(const TransitionSystem& ts, const std::vector<Part>& parts,
              const std::string& path, double seconds,
              CertificateReport& report) {
  const SolverAnswers said = run_cvc5(path, seconds);
  std::size_t next = 0;
  // A wrong answer counts even when the solver failed after it.
  for (const Part& part : parts) {
    for (const ScriptQuery& query : part.script.queries) {
      const std::string answer =
          next < said.answers.size() ? said.answers[next] : "unknown";
      ++next;
      if (answer == "unsat") continue;
      const bool rejected = answer == "sat";
      report.outcome = rejected ? CertificateOutcome::Rejected
                                : CertificateOutcome::Undecided;
      report.what = describe(ts, part.invariant, part.script, query) +
                    (rejected ? ": cvc5 has a counterexample, z3 has none"
                              : ": cvc5 does not decide it");
      if (!said.error.empty()) report.what += " (" + said.error + ")";
      return;
    }
  }
  if (!said.error.empty() || said.answers.size() != next) {
    report.outcome = CertificateOutcome::Undecided;
    report.what =
        said.error.empty() ? "cvc5 gave too many answers" : said.error;
    return;
  }
  report.checked_by.push_back("cvc5 " + said.version);
}

/// Null when no file is needed.
std::unique_ptr<ScriptFile> write_file(const std::vector<Part>& parts,
                                       const CertificateOptions& options) {
  if (options.smtlib_directory.empty() && options.recheck.empty()) return {};
  std::vector<const CertificateScript*> scripts;
  scripts.reserve(parts.size());
  for (const Part& part : parts) scripts.push_back(&part.script);
  return std::make_unique<ScriptFile>(scripts, options.smtlib_directory,
                                      options.name);
}

}  // namespace

struct CertificateSession::Impl {
  /// What one choice of solvers accepted.
  struct Accepted {
    std::unordered_set<std::string> bodies;
    std::vector<std::string> checked_by;
  };

  std::optional<Z3Context> context;
  bool used_proof = false;  // by the check under way
  bool used_z3 = false;
  std::map<std::string, Accepted> accepted;  // by CertificateOptions::recheck
  std::size_t bytes = 0;                     // of all bodies there

  void remember(Accepted& known, std::vector<Part>& parts);
  void show_rest(const TransitionSystem& ts, const Part& part,
                 const std::vector<std::uint32_t>& open, double seconds,
                 CertificateReport& report);
  script::Decision decide_on_bits(const Part& part, Clock::time_point deadline,
                                  const CertificateOptions& options) const;
  void ask(const TransitionSystem& ts, const Part& part,
           Clock::time_point deadline, const CertificateOptions& options,
           CertificateReport& report);
  void ask_all(const TransitionSystem& ts, const std::vector<Part>& parts,
               const Accepted& known, const CertificateOptions& options,
               CertificateReport& report);
  void decide(const TransitionSystem& ts, std::vector<Part>& parts,
              const ScriptFile* file, const CertificateOptions& options,
              CertificateReport& report);
};

void CertificateSession::Impl::remember(Accepted& known,
                                        std::vector<Part>& parts) {
  for (Part& part : parts) {
    if (bytes + part.body.size() > kRemembered) continue;
    const std::size_t size = part.body.size();
    if (known.bodies.insert(std::move(part.body)).second) bytes += size;
  }
}

/// A claim that is too hard for the solver takes down all that were to be
/// shown with it. Without such claims the rest may be a certificate too.
void CertificateSession::Impl::show_rest(const TransitionSystem& ts,
                                         const Part& part,
                                         const std::vector<std::uint32_t>& open,
                                         double seconds,
                                         CertificateReport& report) {
  std::vector<LemmaClause> dropped;
  const Invariant rest = without(part, open, dropped);
  const CertificateScript script = make_certificate_script(ts, rest);
  const ScriptAnswer answer = ask_z3(*context, script, deadline_in(seconds));
  if (answer.outcome == CertificateOutcome::Accepted) {
    append(report.shown, rest.conditions);
    append(report.dropped, dropped);
  } else {
    append(report.dropped, part.invariant.lemmas);
  }
}

/// Unknown when it is not tried: once Z3 runs it is the quicker one for
/// numbers.
script::Decision CertificateSession::Impl::decide_on_bits(
    const Part& part, Clock::time_point deadline,
    const CertificateOptions& options) const {
  const bool numbers = part.script.text.find(" Int)") != std::string::npos;
  const bool tried = !context || !numbers || options.recheck == "z3";
  if (!tried || Clock::now() >= deadline) return script::Decision::Unknown;
  return script::decide(part.script);
}

void CertificateSession::Impl::ask(const TransitionSystem& ts, const Part& part,
                                   Clock::time_point deadline,
                                   const CertificateOptions& options,
                                   CertificateReport& report) {
  const script::Decision on_bits = decide_on_bits(part, deadline, options);
  if (on_bits == script::Decision::Accepted) {
    used_proof = true;
    if (options.recheck != "z3") {
      return append(report.shown, part.invariant.conditions);
    }
  }
  used_z3 = true;
  if (!context) context.emplace();
  const ScriptAnswer answer = ask_z3(*context, part.script, deadline);
  if (answer.outcome == CertificateOutcome::Accepted) {
    if (on_bits != script::Decision::Doubtful) {
      return append(report.shown, part.invariant.conditions);
    }
    report.outcome = CertificateOutcome::Rejected;
    report.what = "some claim: on bits it has a counterexample, z3 has none";
    return;
  }
  report.outcome = answer.outcome;
  report.what = describe(ts, part.invariant, part.script,
                         part.script.queries[answer.query]);
  if (answer.outcome == CertificateOutcome::Rejected) return;
  report.what += ": z3: " + answer.why;
  show_rest(ts, part, answer.open_claims, options.seconds, report);
}

void CertificateSession::Impl::ask_all(const TransitionSystem& ts,
                                       const std::vector<Part>& parts,
                                       const Accepted& known,
                                       const CertificateOptions& options,
                                       CertificateReport& report) {
  const Clock::time_point deadline = deadline_in(options.seconds);
  report.outcome = CertificateOutcome::Accepted;
  report.reused = true;
  for (const Part& part : parts) {
    if (known.bodies.count(part.body) != 0) {
      append(report.shown, part.invariant.conditions);
      continue;
    }
    report.reused = false;
    ask(ts, part, deadline, options, report);
    if (report.outcome == CertificateOutcome::Rejected) return;
  }
}

void CertificateSession::Impl::decide(const TransitionSystem& ts,
                                      std::vector<Part>& parts,
                                      const ScriptFile* file,
                                      const CertificateOptions& options,
                                      CertificateReport& report) {
  Accepted& known = accepted[options.recheck];
  used_proof = false;
  used_z3 = false;
  ask_all(ts, parts, known, options, report);
  if (report.outcome == CertificateOutcome::Rejected) return;
  if (used_proof) {
    report.checked_by.push_back("cadical " + sat_version() +
                                " (proof followed)");
  }
  if (used_z3) report.checked_by.push_back("z3 " + z3_version());
  if (report.outcome == CertificateOutcome::Undecided) return;
  if (report.reused) {
    report.checked_by = known.checked_by;
    return;
  }
  if (options.recheck == "cvc5") {
    ask_cvc5(ts, parts, file->path(), options.seconds, report);
    if (report.outcome != CertificateOutcome::Accepted) return;
  }
  known.checked_by = report.checked_by;
  remember(known, parts);
}

CertificateSession::CertificateSession() : impl_(std::make_unique<Impl>()) {}
CertificateSession::~CertificateSession() = default;

CertificateReport CertificateSession::check(const TransitionSystem& ts,
                                            const Invariant& invariant,
                                            const std::vector<ExprId>& goals,
                                            const CertificateOptions& options) {
  const Clock::time_point start = Clock::now();
  CertificateReport report;
  std::vector<Part> parts = parts_of(ts, invariant);
  const std::unique_ptr<ScriptFile> file = write_file(parts, options);
  if (file && !options.smtlib_directory.empty()) {
    report.smtlib_path = file->path();
  }
  std::string wrong = uncovered_goal(ts, invariant, goals);
  for (const Part& part : parts) {
    if (!part.script.error.empty()) wrong = part.script.error;
  }
  if (!wrong.empty()) {
    report.outcome = CertificateOutcome::Rejected;
    report.what = wrong;
  } else if (file && !file->error().empty()) {
    report.what = file->error();
  } else if (!options.recheck.empty() && options.recheck != "cvc5" &&
             options.recheck != "z3") {
    report.what = "there is no solver `" + options.recheck + "` to ask";
  } else {
    impl_->decide(ts, parts, file.get(), options, report);
  }
  // Another solver was to agree, and was not asked; or there is no proof.
  if (report.outcome != CertificateOutcome::Undecided ||
      !options.recheck.empty()) {
    report.shown.clear();
  }
  report.milliseconds =
      std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return report;
}

std::string z3_version() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned build = 0;
  unsigned revision = 0;
  Z3_get_version(&major, &minor, &build, &revision);
  return std::to_string(major) + "." + std::to_string(minor) + "." +
         std::to_string(build);
}

}  // namespace rung
