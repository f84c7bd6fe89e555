#pragma once

#include <map>
#include <memory>
#include <optional>
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

  /// Searches for all of them: first what is quick, so that one that is hard
  /// takes no time from the others.
  void search(const std::vector<ExprId>& goals,
              const std::vector<ExprId>& growth,
              const PortfolioOptions& engines);

  /// Of an obligation whose condition was among the goals.
  CheckedAnswer answer(const Obligation& obligation);

 private:
  struct Decided {
    Recovery recovery;
    std::unique_ptr<RecoverySearch> search;  // while there is more to ask
    std::optional<Patience> asked;           // of the last answer
    double milliseconds = 0;
  };

  void conclude(const Recovery& recovery, CheckedAnswer& answer);
  void conclude_recoverable(const Recovery& recovery, CheckedAnswer& answer);
  void conclude_stuck(const Recovery& recovery, CheckedAnswer& answer);
  bool is_accepted(const CertificateReport& report, CheckedAnswer& answer);
  CertificateOptions certificate_options(const Obligation& obligation) const;

  const Program& program_;
  const PropertySet& properties_;
  TransitionSystem& ts_;
  const VerifyOptions& options_;
  CertificateSession session_;
  std::map<ExprId, Decided> decided_;  // by goal
};

}  // namespace rung
