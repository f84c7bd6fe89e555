#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "analysis/trace.h"
#include "smt/certificate.h"
#include "smt/recovery.h"
#include "smt/slice_state.h"

namespace rung {

/// The claims that the regions make: what follows from the invariant alone for
/// each, and that every scan arrives. Made anew from the regions, so nothing
/// that the engine says of its terms is trusted.
/// Errors: a region that is none: in `error`.
struct WayClaims {
  std::vector<ExprId> consequences;
  ExprId arrived;
  std::string error;
};
WayClaims way_claims(TransitionSystem& ts, ExprId goal,
                     const std::vector<Region>& regions);

/// Decides the certificate of an answer Recoverable: the invariant, that every
/// scan arrives, and that every region leads on.
CertificateReport check_ways(CertificateSession& session, TransitionSystem& ts,
                             ExprId goal, const Recovery& recovery,
                             const CertificateOptions& options);

/// The end of a run as the terms have it, scan by scan.
struct RunEnd {
  bool allowed = false;               // the assumptions hold throughout
  std::vector<std::uint32_t> states;  // those that the goal depends on
  SliceState values;                  // of these
  Stimulus onward;                    // the run, and random scans behind it
};
RunEnd end_of_run(const TransitionSystem& ts, ExprId goal,
                  const Stimulus& stimulus);

/// Decides the certificate of an answer Stuck: that from `end` on no scan ends
/// with the goal.
CertificateReport check_trap(CertificateSession& session, TransitionSystem& ts,
                             ExprId goal, const Invariant& trap,
                             const RunEnd& end,
                             const CertificateOptions& options);

/// Does the simulator contradict that the run ends where the terms say, and
/// that no scan from its last one on, as far as the random scans go, ends with
/// the goal of this obligation? Empty: it does not.
std::string disagreement(const Program& program, const PropertySet& properties,
                         const TransitionSystem& ts,
                         const Obligation& obligation, const Stimulus& stimulus,
                         const RunEnd& end);

}  // namespace rung
