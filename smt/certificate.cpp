#include "smt/certificate.h"

#include <unistd.h>
#include <z3.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <unordered_set>
#include <utility>

#include "smt/cvc5.h"
#include "smt/smtlib.h"
#include "smt/z3_context.h"

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

/// Effort of one check, in Z3's own unit, so that an answer does not depend on
/// the machine: some minutes.
constexpr unsigned kResourceLimit = 2'000'000'000;

std::string describe(const TransitionSystem& ts, const Invariant& invariant,
                     const ScriptClaim& claim) {
  switch (claim.kind) {
    case ScriptClaim::Kind::Lemma:
      return "lemma `" + to_string(ts, invariant.lemmas[claim.index]) + "`";
    case ScriptClaim::Kind::Condition:
      return "`" + to_string(ts, invariant.conditions[claim.index]) + "`";
    case ScriptClaim::Kind::Range:
      return "the range of `" + ts.vars[ts.states[claim.index].var].name + "`";
  }
  return {};
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
           double seconds)
      : context_(context), c_(context.get()), script_(script) {
    // Without tactics: what is asked are many small refutations on one
    // encoding, and the core that keeps it is the faster one.
    solver_ = Z3_mk_simple_solver(c_);
    Z3_solver_inc_ref(c_, solver_);
    Z3_params params = Z3_mk_params(c_);
    Z3_params_inc_ref(c_, params);
    const auto set = [&](const char* name, unsigned value) {
      Z3_params_set_uint(c_, params, Z3_mk_string_symbol(c_, name), value);
    };
    set("arith.solver", 2);
    set("rlimit", kResourceLimit);
    set("timeout", static_cast<unsigned>(std::clamp(seconds * 1000, 1.0, 4e9)));
    Z3_solver_set_params(c_, solver_, params);
    Z3_params_dec_ref(c_, params);
    Z3_solver_from_string(c_, solver_, script_.text.c_str());
  }
  ~Z3Script() {
    for (const Z3_ast kept : kept_) Z3_dec_ref(c_, kept);
    Z3_solver_dec_ref(c_, solver_);
  }
  Z3Script(const Z3Script&) = delete;
  Z3Script& operator=(const Z3Script&) = delete;

  /// Sets the outcome; `broken` is a claim that a counterexample falsifies.
  CertificateOutcome decide(const ScriptQuery& query,
                            std::optional<ScriptClaim>& broken,
                            std::string& why) {
    why = context_.error();
    if (!why.empty()) return CertificateOutcome::Undecided;
    std::vector<Z3_ast> assumptions;
    for (const std::string& symbol : query.assumptions) {
      assumptions.push_back(constant(symbol));
    }
    const Z3_lbool answer = Z3_solver_check_assumptions(
        c_, solver_, static_cast<unsigned>(assumptions.size()),
        assumptions.data());
    why = context_.error();
    if (!why.empty()) return CertificateOutcome::Undecided;
    if (answer == Z3_L_FALSE) return CertificateOutcome::Accepted;
    if (answer == Z3_L_TRUE) {
      broken = find_broken(query);
      return CertificateOutcome::Rejected;
    }
    why = Z3_solver_get_reason_unknown(c_, solver_);
    return CertificateOutcome::Undecided;
  }

 private:
  Z3_ast constant(const std::string& symbol) {
    Z3_ast term = Z3_mk_const(c_, Z3_mk_string_symbol(c_, symbol.c_str()),
                              Z3_mk_bool_sort(c_));
    // Else the next call frees it.
    Z3_inc_ref(c_, term);
    kept_.push_back(term);
    return term;
  }

  std::optional<ScriptClaim> find_broken(const ScriptQuery& query) {
    Z3_model model = Z3_solver_get_model(c_, solver_);
    if (model == nullptr) return std::nullopt;
    Z3_model_inc_ref(c_, model);
    std::optional<ScriptClaim> found;
    for (const ScriptClaim& claim : script_.claims) {
      if (!query.concerns(claim)) continue;
      const Z3_ast symbol =
          constant(claim.symbol + "@" + std::to_string(query.frame));
      Z3_ast value = nullptr;
      if (!Z3_model_eval(c_, model, symbol, false, &value)) continue;
      if (Z3_get_bool_value(c_, value) != Z3_L_FALSE) continue;
      found = claim;
      break;
    }
    Z3_model_dec_ref(c_, model);
    return found;
  }

  const Z3Context& context_;
  Z3_context c_;
  const CertificateScript& script_;
  Z3_solver solver_ = nullptr;
  std::vector<Z3_ast> kept_;
};

/// A file that holds the script: the one asked for, or one that is removed.
class ScriptFile {
 public:
  ScriptFile(const CertificateScript& script, const CertificateOptions& options)
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
    out << script.file("Rungproof certificate: " + options.name);
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

  void ask_z3(const TransitionSystem& ts, const Invariant& invariant,
              const CertificateScript& script, double seconds,
              CertificateReport& report);
  static void ask_cvc5(const CertificateScript& script, const ScriptFile& file,
                       double seconds, CertificateReport& report);
};

void CertificateSession::Impl::ask_z3(const TransitionSystem& ts,
                                      const Invariant& invariant,
                                      const CertificateScript& script,
                                      double seconds,
                                      CertificateReport& report) {
  if (!context) context.emplace();
  Z3Script solver(*context, script, seconds);
  for (const ScriptQuery& query : script.queries) {
    std::optional<ScriptClaim> broken;
    std::string why;
    report.outcome = solver.decide(query, broken, why);
    if (report.outcome == CertificateOutcome::Accepted) continue;
    report.what = to_string(query.part);
    if (broken) report.what += " of " + describe(ts, invariant, *broken);
    if (report.outcome == CertificateOutcome::Undecided) {
      report.what += ": z3: " + why;
    }
    return;
  }
  report.checked_by.push_back("z3 " + z3_version());
}

void CertificateSession::Impl::ask_cvc5(const CertificateScript& script,
                                        const ScriptFile& file, double seconds,
                                        CertificateReport& report) {
  const SolverAnswers said = run_cvc5(file.path(), seconds);
  // A wrong answer counts even when the solver failed after it.
  for (std::size_t i = 0; i < script.queries.size(); ++i) {
    const std::string answer =
        i < said.answers.size() ? said.answers[i] : "unknown";
    if (answer == "unsat") continue;
    const bool rejected = answer == "sat";
    report.outcome =
        rejected ? CertificateOutcome::Rejected : CertificateOutcome::Undecided;
    report.what = std::string(to_string(script.queries[i].part)) +
                  (rejected ? ": cvc5 has a counterexample, z3 has none"
                            : ": cvc5 does not decide it");
    if (!said.error.empty()) report.what += " (" + said.error + ")";
    return;
  }
  if (!said.error.empty() || said.answers.size() != script.queries.size()) {
    report.outcome = CertificateOutcome::Undecided;
    report.what =
        said.error.empty() ? "cvc5 gave too many answers" : said.error;
    return;
  }
  report.checked_by.push_back("cvc5 " + said.version);
}

CertificateSession::CertificateSession() : impl_(std::make_unique<Impl>()) {}
CertificateSession::~CertificateSession() = default;

CertificateReport CertificateSession::check(const TransitionSystem& ts,
                                            const Invariant& invariant,
                                            const std::vector<ExprId>& goals,
                                            const CertificateOptions& options) {
  const Clock::time_point start = Clock::now();
  CertificateReport report;
  const CertificateScript script = make_certificate_script(ts, invariant);
  std::optional<ScriptFile> file;
  if (!options.smtlib_directory.empty() || !options.recheck.empty()) {
    file.emplace(script, options);
    if (!options.smtlib_directory.empty()) report.smtlib_path = file->path();
  }
  const std::string uncovered = uncovered_goal(ts, invariant, goals);
  if (!script.error.empty() || !uncovered.empty()) {
    report.outcome = CertificateOutcome::Rejected;
    report.what = script.error.empty() ? uncovered : script.error;
  } else if (file && !file->error().empty()) {
    report.what = file->error();
  } else if (!options.recheck.empty() && options.recheck != "cvc5") {
    report.what = "there is no solver `" + options.recheck + "` to ask";
  } else {
    impl_->ask_z3(ts, invariant, script, options.seconds, report);
    if (report.outcome == CertificateOutcome::Accepted && file &&
        !options.recheck.empty()) {
      Impl::ask_cvc5(script, *file, options.seconds, report);
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
