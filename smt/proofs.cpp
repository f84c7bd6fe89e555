#include "smt/proofs.h"

#include <algorithm>
#include <utility>

#include "smt/attempt.h"

namespace rung {

std::size_t Proofs::add(Invariant invariant, std::vector<ExprId> goals,
                        std::string name) {
  proofs_.push_back(
      {std::move(invariant), std::move(goals), std::move(name), {}});
  return proofs_.size() - 1;
}

void Proofs::check(const CertificateOptions& options) {
  CertificateOptions own = options;
  for (Proof& proof : proofs_) {
    own.name = proof.name;
    const std::string failure = attempt([&] {
      proof.report = session_.check(ts_, proof.invariant, proof.goals, own);
    });
    if (!failure.empty()) {
      proof.report = {};
      proof.report.what = failure;
    }
  }
}

bool Proofs::shows(std::size_t proof, ExprId goal) const {
  const CertificateReport& report = proofs_[proof].report;
  return report.outcome == CertificateOutcome::Accepted ||
         std::find(report.shown.begin(), report.shown.end(), goal) !=
             report.shown.end();
}

}  // namespace rung
