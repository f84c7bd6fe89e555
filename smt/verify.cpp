#include "smt/verify.h"

#include <chrono>
#include <unordered_map>
#include <utility>

#include "smt/certificate.h"
#include "smt/partition.h"
#include "smt/portfolio.h"
#include "smt/verdicts.h"

namespace rung {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now() - start)
      .count();
}

/// Is there a first scan that the assumptions allow?
bool satisfiable(const TransitionSystem& ts, const Deadline& deadline) {
  if (ts.constraints.empty()) return true;
  Cone cone(ts, {});
  Unrolling frames(cone.circuit().aig(), cone.bits(),
                   Unrolling::Start::Initial);
  Sat sat(&deadline);
  AigClauses clauses(frames.aig(), sat);
  clauses.require(frames.at(0, cone.constraint()));
  return sat.solve() != SatAnswer::Unsat;
}

class Verifier {
 public:
  Verifier(const Program& program, const PropertySet& properties,
           const VerifyOptions& options)
      : options_(options),
        deadline_(options.budget.seconds),
        ts_(build_transition_system(program)),
        questions_(make_questions(program, properties, ts_)),
        growth_(growth_terms(ts_)),
        verdicts_(program, properties, ts_, questions_, options) {}

  VerifyReport run() {
    if (!satisfiable(ts_, deadline_)) return verdicts_.no_run_at_all();
    std::vector<ExprId> roots;
    for (const Target& target : questions_.targets) {
      roots.push_back(target.term);
    }
    const auto groups = partition(ts_, roots);
    std::size_t done = 0;
    for (const std::vector<std::size_t>& group : groups) {
      if (options_.progress) progress(done, groups.size());
      decide(group);
      ++done;
    }
    return verdicts_.report();
  }

 private:
  void progress(std::size_t done, std::size_t all) {
    options_.progress("proving: part " + std::to_string(done + 1) + " of " +
                      std::to_string(all));
  }

  void decide(const std::vector<std::size_t>& group) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Target*> targets;
    for (std::size_t i : group) targets.push_back(&questions_.targets[i]);
    const PortfolioOptions portfolio_options{
        options_.engine, options_.budget.max_depth, &deadline_};
    Portfolio portfolio(ts_, growth_, std::move(targets), portfolio_options);
    portfolio.run();
    const double share =
        milliseconds_since(start) / static_cast<double>(group.size());
    verdicts_.decided(group, portfolio.invariant(),
                      portfolio.cone().circuit().overflow(), share);
  }

  const VerifyOptions& options_;
  Deadline deadline_;
  TransitionSystem ts_;
  Questions questions_;
  std::vector<ExprId> growth_;
  Verdicts verdicts_;
};

}  // namespace

VerifyReport verify(const Program& program, const PropertySet& properties,
                    const VerifyOptions& options) {
  return Verifier(program, properties, options).run();
}

const std::vector<EngineInfo>& engines() {
  static const std::vector<EngineInfo> kEngines = {
      {"bmc", "bounded search for runs, with jumps over quiet scans"},
      {"induction", "joint k-induction over all properties of a cone"},
  };
  return kEngines;
}

std::vector<std::pair<std::string, std::string>> solver_versions() {
  return {{"z3", z3_version()}, {"cadical", sat_version()}};
}

}  // namespace rung
