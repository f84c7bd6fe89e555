#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "smt/bmc.h"
#include "smt/cone.h"
#include "smt/induction.h"
#include "smt/invariant.h"
#include "smt/jump.h"
#include "smt/pdr.h"
#include "smt/target.h"
#include "smt/templates.h"

namespace rung {

struct PortfolioOptions {
  std::string engine;  // empty: all of them
  std::uint32_t max_depth = 200;
  const Deadline* deadline = nullptr;
  std::uint64_t seed = 0;  // of random runs
};

/// Decides the targets of one cone, cheapest engine first; what one engine
/// shows, the next ones use. Effort is counted in conflicts, so the answers do
/// not depend on the machine unless the deadline passes.
class Portfolio {
 public:
  /// `targets` are those of the cone; they are decided in place.
  Portfolio(TransitionSystem& ts, const std::vector<ExprId>& growth,
            std::vector<Target*> targets, const PortfolioOptions& options);

  /// The cheap part, meant for all targets of a program at once: what is
  /// decided while it is built and what random runs meet.
  void prelude();
  /// The rest, meant for targets that share state.
  void run();

  /// What is cheap of run(), for questions that may stay open.
  void sketch();

  /// Random runs of prelude(); null when there were none to make.
  const Simulation* simulation() const { return simulation_.get(); }
  const Cone& cone() const { return cone_; }
  /// Shows every target with status Unreachable.
  const Invariant& invariant() const { return invariant_; }

 private:
  enum class Sought : std::uint8_t { Shown, Hidden, All };

  const JumpCircuit& jump();
  bool any_doubtful() const;
  bool uses(std::string_view engine) const {
    return options_.engine.empty() || options_.engine == engine;
  }
  void structural();
  void induction(std::uint32_t k, bool all, const InductionLimits& limits);
  bool note_hits();
  void take_hits(Sought what, std::uint32_t steps);
  std::vector<Candidate> guesses(Templates::Constants constants,
                                 Templates::Reach reach);
  void correspond();
  enum class Effort : std::uint8_t { Little, Much };
  void guess_lemmas(Effort effort);
  void learn(std::vector<Candidate> lemmas, std::uint32_t k, bool all,
             const InductionLimits& limits);
  void property_directed(const PdrLimits& limits);
  void minimise();
  bool is_sought(const Target& target, Sought what) const;
  bool any_sought(Sought what) const;
  std::vector<Target*> sought(Sought what, std::vector<AigLit>& goals) const;
  void simulate(std::uint32_t steps, bool sample, Sought wanted);
  void simulate_on(Sought wanted);
  std::uint32_t idle_steps(Sought wanted);
  void search(Sought what, std::uint32_t depth, std::int64_t conflicts);
  bool search_depth(Sought what, std::int64_t conflicts);
  void search_hidden(std::uint32_t depth, std::int64_t conflicts);
  std::uint32_t worthwhile_depth() const;
  void search_all_again();
  void found(Target& target, Run run);
  Stretches stretches() {
    return jump().exact() ? Stretches::AsOneScan : Stretches::ScanByScan;
  }
  void unreachable(std::size_t i, std::string_view engine);
  bool out_of_time() const { return options_.deadline->passed(); }

  TransitionSystem& ts_;
  std::vector<Target*> targets_;
  PortfolioOptions options_;
  Cone cone_;
  const std::vector<ExprId>& growth_;
  std::unique_ptr<JumpCircuit> jump_;  // made when first needed
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Templates> templates_;
  std::vector<PdrSignal> signals_;
  AigLit fault_ = kAigFalse;
  std::vector<ExprId> faults_;
  std::unique_ptr<BoundedSearch> search_;
  bool search_jumps_ = true;
  std::uint32_t depth_ = 0;  // searched so far
  Known known_;
  Invariant invariant_;
};

}  // namespace rung
