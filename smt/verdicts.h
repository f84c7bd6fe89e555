#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/property.h"
#include "analysis/transition_system.h"
#include "smt/invariant.h"
#include "smt/proofs.h"
#include "smt/target.h"
#include "smt/verify.h"

namespace rung {

/// Obligations as targets: what is asked of the engines. One term is asked of
/// once, however many obligations need its answer.
struct Questions {
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::vector<Obligation> obligations;
  std::vector<Target> targets;
  std::vector<std::size_t> goal;     // by obligation: its target, or kNone
  std::vector<std::size_t> trigger;  // the same
  std::vector<std::size_t> fault;    // by TransitionSystem::faults
};
/// `wanted` as VerifyOptions::wanted.
Questions make_questions(const Program& program, const PropertySet& properties,
                         const std::function<bool(std::string_view)>& wanted,
                         TransitionSystem& ts);

/// Is the run of its answer part of the report? Built-in obligations and the
/// parts of a latch only say that there is one: a plant has thousands.
bool shows_run(const Obligation& obligation);

/// What a run is hoped to show: it meets the goal of an obligation, or its
/// trigger.
struct Claim {
  std::size_t obligation = 0;
  bool trigger = false;
};

/// A result that was checked already.
struct CheckedAnswer {
  ObligationResult result;
  std::string failure;  // of the check; empty: none
};

/// Turns what engines found into verdicts, after checking it: traces by
/// replay, proofs by the certificate's check. What fails its check is reported
/// as a failure and never as a verdict.
class Verdicts {
 public:
  Verdicts(const Program& program, const PropertySet& properties,
           const TransitionSystem& ts, const Questions& questions,
           const VerifyOptions& options);

  /// Replays a run, which is not shown, and notes which claims it meets.
  void replay_together(const FoundRun& run, const std::vector<Claim>& claims);
  bool is_confirmed(const Claim& claim) const {
    return claim.trigger ? replayed_[target_of(claim)]
                         : confirmed_[claim.obligation] != 0;
  }
  std::size_t target_of(const Claim& claim) const {
    return (claim.trigger ? questions_.trigger
                          : questions_.goal)[claim.obligation];
  }

  /// Engines are done with these targets; `invariant` shows the unreachable
  /// ones. `overflow`: their terms have no exact encoding.
  void decided(const std::vector<std::size_t>& group,
               const Invariant& invariant, bool overflow, double milliseconds);

  /// An obligation that no target stands for is decided, and checked.
  void answered(std::size_t obligation, CheckedAnswer answer) {
    answered_.emplace(obligation, std::move(answer));
  }

  /// Every obligation, in order.
  VerifyReport report();
  /// The same when no scan at all meets the assumptions.
  VerifyReport no_run_at_all();

 private:
  struct Group {  // of targets that one invariant shows
    std::uint32_t k = 0;
    std::vector<std::string> lemmas;
    std::vector<std::string> conditions;
    std::size_t proof = Questions::kNone;
    bool overflow = false;
    double milliseconds = 0;  // a target
  };

  bool is_shown(std::size_t target) const;
  Certificate certificate(const Group& group) const;
  ObligationResult conclude(std::size_t i);
  void conclude_reached(const Target& target, ObligationResult& result);
  void conclude_unreachable(std::size_t i, ObligationResult& result);
  void conclude_open(const Target& target, ObligationResult& result);
  void replay_into(const Target& target, ObligationResult& result);
  void fail(ObligationResult& result, const std::string& what);
  void judge_vacuity(std::size_t i, ObligationResult& result);
  std::string open_fault(const Target& target) const;
  std::string wider_than_program(const Target& target) const;

  const Program& program_;
  const PropertySet& properties_;
  const TransitionSystem& ts_;
  const Questions& questions_;
  const VerifyOptions& options_;
  Proofs proofs_;
  std::vector<Group> groups_;
  std::map<std::size_t, CheckedAnswer> answered_;  // by obligation
  std::vector<std::size_t> group_of_;              // by target
  std::vector<std::uint64_t> confirmed_;  // by obligation: scans of the run
  std::vector<bool> replayed_;            // by target: a replayed run meets it
  std::vector<SelfCheckFailure> failures_;
};

}  // namespace rung
