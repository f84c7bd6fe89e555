#pragma once

#include <string>
#include <vector>

#include "smt/certificate.h"
#include "smt/invariant.h"

namespace rung {

/// The proofs of one program and their checks. Independent parts of a plant
/// have a proof each; they are checked many at a time, because a conjunction of
/// invariants over different states is one too, and a script has its price.
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

 private:
  struct Proof {
    Invariant invariant;
    std::vector<ExprId> goals;
    std::string name;
    CertificateReport report;
  };

  std::size_t batch_end(std::size_t begin) const;
  bool check_together(std::size_t begin, std::size_t end,
                      const CertificateOptions& options);

  const TransitionSystem& ts_;
  std::vector<Proof> proofs_;
  CertificateSession session_;
};

}  // namespace rung
