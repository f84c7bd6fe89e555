#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/program.h"
#include "analysis/result.h"
#include "analysis/state_relation.h"
#include "smt/verify.h"

namespace rung {

enum class EquivalenceVerdict : std::uint8_t {
  Equivalent,
  Different,
  Bounded,
  Unknown
};

struct EquivalenceOptions {
  Budget budget;
  bool self_check = true;
  /// Signal of the first program, signal of the second.
  std::vector<std::pair<std::string, std::string>> map;
  std::vector<std::string> rungs;  // outputs to compare; empty: all shared
  /// In each scan the second program's outputs may be those of the first that
  /// many scans ago: the same number in all scans, from 0 up to this.
  std::uint32_t delay = 0;
  bool settled = false;                    // see Comparison
  std::vector<std::string> assumptions;    // over the first's inputs, checked
  std::vector<std::string> assumptions_b;  // the same, over the second's
  std::vector<StateRelation> relations;
  std::string recheck;           // "cvc5": re-check with that binary as well
  std::string smtlib_directory;  // write the certificate there; empty: nowhere
};

struct EquivalenceResult {
  EquivalenceVerdict verdict = EquivalenceVerdict::Unknown;
  std::vector<std::string> outputs;  // compared, names of the first program
  std::string engine;
  std::string reason;
  std::vector<std::string> not_compared;  // outputs of one side: "a.y3"
  std::string differs;  // the output that does, as the first program names it
  std::vector<std::string> also_different;  // others, in runs of their own
  std::uint32_t delay = 0;  // of the second program, where they are equivalent
  std::optional<Certificate> certificate;
  std::optional<Stimulus> stimulus_a;  // inputs of both are the same values
  std::optional<Stimulus> stimulus_b;
  std::optional<Trace> trace_a;
  std::optional<Trace> trace_b;
  std::vector<SelfCheckFailure> failures;
  std::string error;  // usage: nothing shared, an unknown name in the map
};

/// Are two programs the same, scan for scan from power-up, on the outputs that
/// they share by name or by `map`, under the same inputs and dt? An input that
/// only one side has is free.
///
/// Equal structure decides first, without a solver (smt/correspondence.h);
/// then registers that stay equal, and the engines on what is left.
/// Only runs that the assumptions of both allow are compared.
EquivalenceResult check_equivalence(const Program& a, const Program& b,
                                    const EquivalenceOptions& options);

}  // namespace rung
