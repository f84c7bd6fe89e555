#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "check/check.h"
#include "smt/verify.h"

namespace rung {

/// What a result file of this report would claim.
check::ClaimedResult claimed_by(const VerifyReport& report);

/// Many checks, and one process for all.
class Confirmation {
 public:
  /// The program outlives this.
  void add(const Program& program, const PropertySet& properties,
           const check::ClaimedResult& claimed);

  /// By add(), what the solver said of each.
  std::vector<std::vector<check::Checked>> ask() const;

 private:
  std::vector<std::unique_ptr<check::CertificateCheck>> checks_;
};

/// Empty when the checker confirms every proof of the report; else a line for
/// each that it does not.
std::string unconfirmed(const Program& program, const PropertySet& properties,
                        const VerifyReport& report);

}  // namespace rung
