#pragma once

#include <optional>
#include <vector>

#include "analysis/explanation.h"
#include "analysis/result.h"
#include "smt/verify.h"

namespace rung {

/// One change of one rung after which `violated` is proved, and everything of
/// `before` that was proved still is: so no repair kills a coil, for that it
/// can be true is among what is proved. Tried in this order, on the rung to
/// blame first: a contact of the property in series, or parallel; a contact
/// less; a contact negated. The first that leaves nothing violated, else one
/// that leaves least. Nothing when none of them holds in `seconds`.
///
/// `properties`, `before`: all of the file. `property` is that of `violated`
/// there.
std::optional<Repair> find_repair(const Program& program,
                                  const PropertySet& properties,
                                  const std::vector<ObligationResult>& before,
                                  const ObligationResult& violated,
                                  std::uint32_t property, RungId blamed,
                                  const VerifyOptions& options, double seconds);

}  // namespace rung
