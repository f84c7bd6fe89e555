#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "analysis/property.h"
#include "smt/verify.h"

namespace rung {

/// As verify(), but what is known of a former state of the program is not
/// proved anew: answers to obligations whose slice (smt/slices.h) is the same.
/// Only what was decided for good is known. Of it,
///  - a run is executed again, on this program, and has to get there;
///  - a certificate is taken over where all variables that it names have the
///    slices that they had: then it is a certificate of this program, too.
/// `known`: what an earlier call gave back, or any bytes; replaced by what is
/// known now, if all obligations were wanted.
struct KnownProofs {
  VerifyReport report;
  std::size_t taken = 0;  // answers that were known
};
KnownProofs verify_unknown(const Program& program,
                           const PropertySet& properties,
                           const VerifyOptions& options, std::string& known);

}  // namespace rung
