#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "smt/invariant.h"

namespace rung {

/// What a certificate claims of one scan's end, as a named Bool of the script.
struct ScriptClaim {
  enum class Kind : std::uint8_t { Lemma, Condition, Range, Consequence };
  Kind kind = Kind::Lemma;
  std::uint32_t index = 0;  // in a list of the Invariant; of the state
  std::string symbol;       // "lemma3"; "lemma3@1" is its value in frame 1
};

/// One check-sat: with its assumptions the script is unsatisfiable when this
/// claim is right there. One query a claim, and not one for the disjunction of
/// all negations: that took 62 s and more where these take 0.2 s in all
/// (1,000 motors, Z3 4.8.12).
struct ScriptQuery {
  enum class Part : std::uint8_t { Initiation, Consecution, Safety };
  Part part = Part::Initiation;
  std::uint32_t frame = 0;  // in which the claim would be broken
  std::uint32_t claim = 0;  // index of CertificateScript::claims
  std::string broken;       // the Bool to be assumed false: "lemma3@1"
};

std::string_view to_string(ScriptQuery::Part part);

/// An Invariant and the transition relation in SMT-LIB 2, quantifier-free
/// linear integer arithmetic (nonlinear where the program multiplies words).
/// It is made from the terms of the transition system alone: bits are Bool,
/// words are Int with their ranges as claims to be proved like any lemma.
///
/// A fresh constant per shared term and frame, no `let` and no `define-fun`:
/// solvers keep the sharing, and text and nesting stay small.
///
/// No name of the program is in it and symbols are numbered in the order of
/// their first use, so equal parts of a plant have one script: what a solver
/// says of it is said of each of them.
struct CertificateScript {
  std::string text;                // declarations and assertions
  std::vector<std::string> names;  // of the variables v0, v1, ...
  std::vector<ScriptClaim> claims;
  std::vector<ScriptQuery> queries;
  std::uint32_t k = 0;
  bool constrained = false;  // the system has constraints
  std::string error;         // not a certificate: a lemma over an input

  /// Bools of the script that `query` assumes to be true.
  std::vector<std::string> assumptions(const ScriptQuery& query) const;

  /// All that a solver is told and asked: the text and one check-sat a query.
  std::string body() const;

  /// The same as a file, with `title` and the names as comments; every answer
  /// must be unsat.
  std::string file(const std::string& title) const;
};

/// Shapes: frame 0 is the state before the first of k + 1 scans; only the
///         states that the certificate depends on are in the script.
/// Limits: linear in the cone, times k + 1; no recursion.
CertificateScript make_certificate_script(const TransitionSystem& ts,
                                          const Invariant& invariant);

}  // namespace rung
