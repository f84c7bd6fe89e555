#pragma once

#include <string>
#include <vector>

#include "smt/certificate.h"
#include "smt/invariant.h"

namespace rung {

/// The proofs of one program, one for each of its independent parts, and their
/// checks.
class Proofs {
 public:
  explicit Proofs(const TransitionSystem& ts) : ts_(ts) {}

  /// `invariant` shows that every one of `goals` holds in every scan.
  /// Returns the proof's index.
  std::size_t add(Invariant invariant, std::vector<ExprId> goals,
                  std::string name);

  /// Checks all that were added; `options.name` is not read.
  void check(const CertificateOptions& options);

  /// Undecided until check().
  const CertificateReport& report(std::size_t proof) const {
    return proofs_[proof].report;
  }
  /// Was this goal of the proof shown? The others may have been too hard.
  bool shows(std::size_t proof, ExprId goal) const;

 private:
  struct Proof {
    Invariant invariant;
    std::vector<ExprId> goals;
    std::string name;
    CertificateReport report;
  };

  const TransitionSystem& ts_;
  std::vector<Proof> proofs_;
  CertificateSession session_;
};

}  // namespace rung
