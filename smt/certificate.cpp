#include "smt/certificate.h"

#include <unistd.h>
#include <z3.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "smt/components.h"
#include "smt/cvc5.h"
#include "smt/smtlib.h"
#include "smt/z3_context.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

/// Effort of one query in Z3's own unit, so that answers do not depend on the
/// machine. The first try is without a clock: Z3 starts a thread for one, and
/// that takes longer than most queries.
constexpr unsigned kFirstTry = 5'000'000;
constexpr unsigned kLastTry = 2'000'000'000;

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

/// One script in a Z3 solver of its own.
class Z3Script {
 public:
  Z3Script(const Z3Context& context, const CertificateScript& script,
           Clock::time_point deadline)
      : context_(context),
        c_(context.get()),
        script_(script),
        deadline_(deadline) {
    // Without tactics: what is asked are many small refutations on one
    // encoding, and the core that keeps it is the faster one.
    solver_ = Z3_mk_simple_solver(c_);
    Z3_solver_inc_ref(c_, solver_);
    limit(kFirstTry, 0);
    Z3_solver_from_string(c_, solver_, script_.text.c_str());
  }
  ~Z3Script() {
    for (const auto& [name, term] : symbols_) Z3_dec_ref(c_, term);
    Z3_solver_dec_ref(c_, solver_);
  }
  Z3Script(const Z3Script&) = delete;
  Z3Script& operator=(const Z3Script&) = delete;

  CertificateOutcome decide(const ScriptQuery& query, std::string& why) {
    why = context_.error();
    if (!why.empty()) return CertificateOutcome::Undecided;
    std::vector<Z3_ast> assumptions;
    for (const std::string& symbol : script_.assumptions(query)) {
      assumptions.push_back(constant(symbol));
    }
    Z3_ast broken = Z3_mk_not(c_, constant(query.broken));
    Z3_inc_ref(c_, broken);
    assumptions.push_back(broken);
    const Z3_lbool answer = ask(assumptions, why);
    Z3_dec_ref(c_, broken);
    if (!why.empty()) return CertificateOutcome::Undecided;
    return answer == Z3_L_FALSE ? CertificateOutcome::Accepted
                                : CertificateOutcome::Rejected;
  }

 private:
  void limit(unsigned effort, unsigned milliseconds) {
    Z3_params params = Z3_mk_params(c_);
    Z3_params_inc_ref(c_, params);
    const auto set = [&](const char* name, unsigned value) {
      Z3_params_set_uint(c_, params, Z3_mk_string_symbol(c_, name), value);
    };
    set("arith.solver", 2);
    set("rlimit", effort);
    if (milliseconds != 0) set("timeout", milliseconds);
    Z3_solver_set_params(c_, solver_, params);
    Z3_params_dec_ref(c_, params);
  }

  Z3_lbool ask(const std::vector<Z3_ast>& assumptions, std::string& why) {
    while (true) {
      const double left =
          std::chrono::duration<double, std::milli>(deadline_ - Clock::now())
              .count();
      if (left <= 0) {
        why = "time-out";
        return Z3_L_UNDEF;
      }
      if (patient_) {
        limit(kLastTry, static_cast<unsigned>(std::clamp(left, 1.0, 4e9)));
      }
      const Z3_lbool answer = Z3_solver_check_assumptions(
          c_, solver_, static_cast<unsigned>(assumptions.size()),
          assumptions.data());
      why = context_.error();
      if (!why.empty() || answer != Z3_L_UNDEF) return answer;
      if (patient_) {
        why = Z3_solver_get_reason_unknown(c_, solver_);
        return answer;
      }
      patient_ = true;
    }
  }

  Z3_ast constant(const std::string& symbol) {
    const auto known = symbols_.find(symbol);
    if (known != symbols_.end()) return known->second;
    Z3_ast term = Z3_mk_const(c_, Z3_mk_string_symbol(c_, symbol.c_str()),
                              Z3_mk_bool_sort(c_));
    // Else the next call frees it.
    Z3_inc_ref(c_, term);
    symbols_.emplace(symbol, term);
    return term;
  }

  const Z3Context& context_;
  Z3_context c_;
  const CertificateScript& script_;
  Clock::time_point deadline_;
  Z3_solver solver_ = nullptr;
  std::unordered_map<std::string, Z3_ast> symbols_;
  bool patient_ = false;
};

/// The independent parts of a certificate, each with its script.
struct Part {
  Invariant invariant;
  CertificateScript script;
};

/// A file that holds the scripts: the one asked for, or one that is removed.
class ScriptFile {
 public:
  ScriptFile(const std::vector<Part>& parts, const CertificateOptions& options)
      : temporary_(options.smtlib_directory.empty()) {
    std::error_code ignored;
    if (temporary_) {
      path_ = make_temporary();
    } else {
      std::filesystem::create_directories(options.smtlib_directory, ignored);
      path_ = (std::filesystem::path(options.smtlib_directory) /
               (file_stem(options.name) + ".smt2"))
                  .string();
    }
    std::ofstream out(path_, std::ios::binary);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0) out << "(reset)\n";
      out << parts[i].script.file("Rungproof certificate: " + options.name +
                                  ", part " + std::to_string(i + 1) + " of " +
                                  std::to_string(parts.size()));
    }
    out << "(exit)\n";
    out.close();
    if (!out) error_ = "cannot write `" + path_ + "`";
  }
  ~ScriptFile() {
    std::error_code ignored;
    if (temporary_) std::filesystem::remove(path_, ignored);
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& error() const { return error_; }

 private:
  static std::string make_temporary() {
    std::error_code ignored;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path(ignored);
    std::string path = (folder / "rungproof-XXXXXX").string();
    const int file = mkstemp(path.data());
    if (file >= 0) close(file);
    return path;
  }

  /// Names of properties are the user's: nothing in them may leave the folder.
  static std::string file_stem(const std::string& name) {
    std::string stem;
    for (const char c : name) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '-' || c == '_' ||
                         (c == '.' && !stem.empty());
      stem += plain ? c : '_';
    }
    return stem.empty() ? "certificate" : stem.substr(0, 200);
  }

  bool temporary_;
  std::string path_;
  std::string error_;
};

}  // namespace

struct CertificateSession::Impl {
  std::optional<Z3Context> context;

  void ask_z3(const TransitionSystem& ts, const std::vector<Part>& parts,
              Clock::time_point deadline, CertificateReport& report);
  bool ask_z3(const TransitionSystem& ts, const Part& part,
              Clock::time_point deadline, CertificateReport& report);
};

bool CertificateSession::Impl::ask_z3(const TransitionSystem& ts,
                                      const Part& part,
                                      Clock::time_point deadline,
                                      CertificateReport& report) {
  Z3Script solver(*context, part.script, deadline);
  for (const ScriptQuery& query : part.script.queries) {
    std::string why;
    report.outcome = solver.decide(query, why);
    if (report.outcome == CertificateOutcome::Accepted) continue;
    report.what = describe(ts, part.invariant, part.script, query);
    if (!why.empty()) report.what += ": z3: " + why;
    return false;
  }
  return true;
}

void CertificateSession::Impl::ask_z3(const TransitionSystem& ts,
                                      const std::vector<Part>& parts,
                                      Clock::time_point deadline,
                                      CertificateReport& report) {
  if (!context) context.emplace();
  for (const Part& part : parts) {
    if (!ask_z3(ts, part, deadline, report)) return;
  }
  report.outcome = CertificateOutcome::Accepted;
  report.checked_by.push_back("z3 " + z3_version());
}

namespace {

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

std::vector<Part> parts_of(const TransitionSystem& ts,
                           const Invariant& invariant) {
  std::vector<Part> parts;
  for (Invariant& part : split_certificate(ts, invariant)) {
    CertificateScript script = make_certificate_script(ts, part);
    parts.push_back({std::move(part), std::move(script)});
  }
  return parts;
}

}  // namespace

CertificateSession::CertificateSession() : impl_(std::make_unique<Impl>()) {}
CertificateSession::~CertificateSession() = default;

CertificateReport CertificateSession::check(const TransitionSystem& ts,
                                            const Invariant& invariant,
                                            const std::vector<ExprId>& goals,
                                            const CertificateOptions& options) {
  const Clock::time_point start = Clock::now();
  CertificateReport report;
  const std::vector<Part> parts = parts_of(ts, invariant);
  std::optional<ScriptFile> file;
  if (!options.smtlib_directory.empty() || !options.recheck.empty()) {
    file.emplace(parts, options);
    if (!options.smtlib_directory.empty()) report.smtlib_path = file->path();
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
  } else if (!options.recheck.empty() && options.recheck != "cvc5") {
    report.what = "there is no solver `" + options.recheck + "` to ask";
  } else {
    const auto limit = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(std::clamp(options.seconds, 0.0, 1e6)));
    impl_->ask_z3(ts, parts, start + limit, report);
    if (report.outcome == CertificateOutcome::Accepted && file &&
        !options.recheck.empty()) {
      ask_cvc5(ts, parts, file->path(), options.seconds, report);
    }
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
