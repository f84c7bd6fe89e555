#pragma once

#include <cstdint>

#include "smt/smtlib.h"

namespace rung::script {

enum class Decision : std::uint8_t {
  Accepted,
  Doubtful,  // some claim has a model that breaks it
  Unknown,   // not understood, or too hard
};

/// The queries of a certificate, decided on the bits of the script's text: it
/// is read and encoded anew, and every refutation is checked. Much quicker to
/// start than an SMT solver; what is too hard here is its business.
/// Limits: some conflicts, fewer when the script is large: about what it takes
/// to start an SMT solver.
Decision decide(const CertificateScript& script);

}  // namespace rung::script
