#pragma once

#include <vector>

#include "analysis/rule.h"
#include "smt/certificate.h"
#include "smt/sat.h"
#include "smt/target.h"

namespace rung {

struct OracleOptions {
  /// What all questions together may cost: about the terms of a question times
  /// the questions asked about them, see Cost in oracle.cpp. The smallest parts
  /// of the program come first, and no step takes more than half of the rest.
  std::uint64_t effort = 1'200'000;
  std::uint32_t max_depth = 8;  // jump steps of the search for witnesses
  double seconds = 20;          // a safety net: the effort decides
  bool self_check = true;       // replay witnesses, re-check proofs
};

/// Answers the questions of lint rules on one transition system: joint
/// induction on each group of conditions that share state, then a short
/// bounded search for witnesses. What neither decides is Unknown: a rule that
/// is not sure says nothing, so the effort is kept small.
///
/// Yes is backed by a certificate that was checked, No by a run on which the
/// simulator has the same values as the terms.
class SolverOracle : public Oracle {
 public:
  /// `ts` is that of `program`, with its assumptions as constraints.
  SolverOracle(const Program& program, TransitionSystem& ts,
               const OracleOptions& options = {});

  std::vector<Evidence> answer(const std::vector<Question>& questions) override;

 private:
  std::vector<Target*> afford(std::vector<Target*> wanted, std::uint64_t fixed,
                              std::uint64_t each);
  void decide(const std::vector<Target*>& part, std::uint64_t terms);
  void induct(const std::vector<Target*>& targets);
  void sketch(const std::vector<Target*>& targets);
  void confirm(const std::vector<Target*>& targets, const Invariant& invariant);
  Evidence evidence(const Target& target,
                    const std::vector<Target>& targets) const;
  std::optional<Trace> replay(const Target& target) const;
  bool fault_may_matter(ExprId condition,
                        const std::vector<Target>& targets) const;

  const Program& program_;
  TransitionSystem& ts_;
  OracleOptions options_;
  Deadline deadline_;
  std::uint64_t effort_;  // left
  std::vector<ExprId> growth_;
  CertificateSession session_;
};

}  // namespace rung
