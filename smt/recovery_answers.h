#pragma once

#include <map>
#include <vector>

#include "smt/certificate.h"
#include "smt/portfolio.h"
#include "smt/recovery.h"
#include "smt/verdicts.h"

namespace rung {

/// Decides the obligations of one program that ask for a way back, and checks
/// the answers: those about one goal are decided once.
class RecoveryAnswers {
 public:
  RecoveryAnswers(const Program& program, const PropertySet& properties,
                  TransitionSystem& ts, const VerifyOptions& options)
      : program_(program),
        properties_(properties),
        ts_(ts),
        options_(options) {}

  CheckedAnswer decide(const Obligation& obligation,
                       const std::vector<ExprId>& growth,
                       const PortfolioOptions& engines);

 private:
  void conclude_recoverable(const Recovery& recovery, CheckedAnswer& answer);
  void conclude_stuck(const Recovery& recovery, CheckedAnswer& answer);
  bool is_accepted(const CertificateReport& report, CheckedAnswer& answer);
  CertificateOptions certificate_options(const Obligation& obligation) const;

  const Program& program_;
  const PropertySet& properties_;
  TransitionSystem& ts_;
  const VerifyOptions& options_;
  CertificateSession session_;
  std::map<ExprId, Recovery> decided_;  // by goal
};

}  // namespace rung
