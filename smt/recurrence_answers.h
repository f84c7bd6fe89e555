#pragma once

#include "smt/certificate.h"
#include "smt/liveness.h"
#include "smt/verdicts.h"

namespace rung {

/// Decides the obligations of one program that ask what comes again and again,
/// and checks the answers: proofs by their certificates, loops by executing
/// them, on the terms and on the simulator.
class RecurrenceAnswers {
 public:
  /// `ts` has the monitors of all obligations.
  RecurrenceAnswers(const Program& program, const PropertySet& properties,
                    const TransitionSystem& ts, const VerifyOptions& options)
      : program_(program),
        properties_(properties),
        ts_(ts),
        options_(options) {}

  /// Short: what is quick; an answer Unknown may be asked for again.
  CheckedAnswer answer(const Obligation& obligation, Patience patience,
                       const PortfolioOptions& engines);

 private:
  void decide(Patience patience, const PortfolioOptions& engines,
              CheckedAnswer& answer);
  std::int64_t counts_below(const std::vector<bool>& cone) const;
  bool is_accepted(LivenessProof& proof, const Obligation& obligation,
                   CheckedAnswer& answer);
  void conclude_always(LivenessAnswer& found, CheckedAnswer& answer);
  void conclude_loops(const LivenessAnswer& found, CheckedAnswer& answer);
  void judge_vacuity(const PortfolioOptions& engines, CheckedAnswer& answer);

  const Program& program_;
  const PropertySet& properties_;
  const TransitionSystem& ts_;
  const VerifyOptions& options_;
  CertificateSession session_;
};

}  // namespace rung
