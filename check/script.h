#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "check/model.h"

namespace rung::check {

/// A claim of a certificate, and how a report calls it.
struct Claim {
  Value value;
  std::string what;
};

/// What is to be shown together: lemmas about states, conditions of scans.
/// With `k` > 0 the conditions may be assumed in the k scans before.
struct Proof {
  std::uint32_t k = 0;
  std::vector<Claim> lemmas;
  std::vector<Claim> conditions;
  /// Also of every scan, and of those that the assumptions forbid, too. They
  /// are not assumed in later scans.
  std::vector<Claim> consequences;
  /// More conditions, that these may need.
  std::vector<Claim> helpers;
  /// Only what the conditions depend on stays in its ranges. They do not
  /// depend on anything else, so that may be what it likes, as long as lemmas
  /// and helpers hold: a word that they speak of may overflow.
  bool narrow = false;
};

/// The three questions of a proof in SMT-LIB 2, linear integers (or products
/// of them). The first answer is to be `sat`: there is a scan at all, so that
/// nothing follows from a contradiction. All others are to be `unsat`.
struct Script {
  std::string text;
  struct Question {
    std::string what;  // "consecution of lemma `!a || b`"
    /// Conditions and lemmas by index; claims of ranges are behind the lemmas.
    bool of_condition = false;
    std::uint32_t claim = 0;
  };
  std::vector<Question> questions;  // the answers behind the first, in order
  bool has_other_ranges = false;    // `narrow` would leave some out
};

/// A constant for every term and every scan: single assignment, nothing is
/// nested, and only what the proof depends on is there.
Script write_script(const Model& model, const Proof& proof);

}  // namespace rung::check
