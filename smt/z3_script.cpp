#include "smt/z3_script.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

/// Effort of one query in Z3's own unit, so that answers do not depend on the
/// machine. The first try is without a clock: Z3 starts a thread for one, and
/// that takes longer than most queries.
constexpr unsigned kFirstTry = 5'000'000;
constexpr unsigned kLastTry = 2'000'000'000;

class Z3Script {
 public:
  Z3Script(const Z3Context& context, const CertificateScript& script)
      : context_(context), c_(context.get()), script_(script) {
    // Without tactics: what is asked are many small refutations on one
    // encoding, and the core that keeps it is the faster one.
    solver_ = Z3_mk_simple_solver(c_);
    Z3_solver_inc_ref(c_, solver_);
    limit(kFirstTry, 0);
    Z3_solver_from_string(c_, solver_, script_.text.c_str());
    unreadable_ = context_.error();
  }
  ~Z3Script() {
    for (const auto& [name, term] : symbols_) Z3_dec_ref(c_, term);
    Z3_solver_dec_ref(c_, solver_);
  }
  Z3Script(const Z3Script&) = delete;
  Z3Script& operator=(const Z3Script&) = delete;

  ScriptAnswer decide(Clock::time_point deadline) {
    ScriptAnswer answer;
    std::vector<std::uint32_t> hard;
    for (std::uint32_t i = 0; i < script_.queries.size(); ++i) {
      if (!ask(i, deadline, answer)) hard.push_back(i);
      if (answer.outcome == CertificateOutcome::Rejected) return answer;
    }
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < hard.size(); ++i) {
      share_time(deadline, hard.size() - i);
      if (!ask(hard[i], deadline, answer)) open.push_back(hard[i]);
      if (answer.outcome == CertificateOutcome::Rejected) return answer;
    }
    answer.outcome = open.empty() ? CertificateOutcome::Accepted
                                  : CertificateOutcome::Undecided;
    if (!open.empty()) answer.query = open.front();
    for (const std::uint32_t query : open) {
      answer.open_claims.push_back(script_.queries[query].claim);
    }
    return answer;
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

  static double milliseconds_to(Clock::time_point deadline) {
    return std::chrono::duration<double, std::milli>(deadline - Clock::now())
        .count();
  }

  void share_time(Clock::time_point deadline, std::size_t queries) {
    const double share =
        milliseconds_to(deadline) / static_cast<double>(queries);
    limit(kLastTry, static_cast<unsigned>(std::clamp(share, 1.0, 4e9)));
  }

  /// False when it was not answered, and `answer` says why.
  bool ask(std::uint32_t index, Clock::time_point deadline,
           ScriptAnswer& answer) {
    std::string why = unreadable_;
    if (why.empty() && milliseconds_to(deadline) <= 0) why = "time-out";
    if (why.empty()) {
      const Z3_lbool said = check(script_.queries[index]);
      why = context_.error();
      if (why.empty() && said == Z3_L_FALSE) return true;
      if (why.empty() && said == Z3_L_TRUE) {
        answer.outcome = CertificateOutcome::Rejected;
        answer.query = index;
        return true;
      }
      if (why.empty()) why = Z3_solver_get_reason_unknown(c_, solver_);
    }
    answer.why = std::move(why);
    return false;
  }

  Z3_lbool check(const ScriptQuery& query) {
    std::vector<Z3_ast> assumptions;
    for (const std::string& symbol : script_.assumptions(query)) {
      assumptions.push_back(constant(symbol));
    }
    Z3_ast broken = Z3_mk_not(c_, constant(query.broken));
    Z3_inc_ref(c_, broken);
    assumptions.push_back(broken);
    const Z3_lbool said = Z3_solver_check_assumptions(
        c_, solver_, static_cast<unsigned>(assumptions.size()),
        assumptions.data());
    Z3_dec_ref(c_, broken);
    return said;
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
  Z3_solver solver_ = nullptr;
  std::string unreadable_;  // not empty: what Z3 has against the script
  std::unordered_map<std::string, Z3_ast> symbols_;
};

}  // namespace

ScriptAnswer ask_z3(const Z3Context& context, const CertificateScript& script,
                    Clock::time_point deadline) {
  if (context.get() == nullptr) {
    ScriptAnswer answer;
    answer.why = context.error();
    for (std::uint32_t i = 0; i < script.claims.size(); ++i) {
      answer.open_claims.push_back(i);
    }
    return answer;
  }
  return Z3Script(context, script).decide(deadline);
}

}  // namespace rung
