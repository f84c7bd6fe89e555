#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "smt/invariant.h"

namespace rung {

struct CertificateOptions {
  double seconds = 60;           // outer limit of one check
  std::string recheck;           // "z3", "cvc5": ask that one as well
  std::string smtlib_directory;  // write the script there; empty: nowhere
  std::string name;              // the file's stem: "pump.interlock"
};

enum class CertificateOutcome : std::uint8_t { Accepted, Rejected, Undecided };

struct CertificateReport {
  CertificateOutcome outcome = CertificateOutcome::Undecided;
  /// Rejected: which part, of what ("consecution of `run -> stop`").
  /// Undecided: why.
  std::string what;
  /// Undecided: conditions that were shown all the same, by a part of the
  /// certificate that is one without what the solver could not decide.
  std::vector<ExprId> shown;
  std::vector<LemmaClause> dropped;  // lemmas that these do without
  /// "cadical sc2021 (proof followed)", "z3 4.8.12", "cvc5 1.0.3"
  std::vector<std::string> checked_by;
  /// Accepted, and no solver was asked: it had accepted the same scripts, word
  /// for word, for equal parts of the program.
  bool reused = false;
  std::string smtlib_path;  // the file, when one was asked for
  double milliseconds = 0;
};

/// Decides certificates by means that share neither state nor encoding with
/// the engines: an SMT-LIB script made from the word-level terms is decided on
/// bits of its own, with every refutation followed (smt/script/). What is too
/// hard there is given to Z3 in this process (one context for all certificates
/// of a session), and all of it to Z3 or the cvc5 binary when asked.
///
/// Scripts that were accepted are kept, whole, and an equal one is not asked
/// again: nothing of the program is in a script but what is asked of it.
///
/// Errors: never throws; a solver's error is Undecided with its text.
class CertificateSession {
 public:
  CertificateSession();  // cheap: Z3 starts when it is first asked
  ~CertificateSession();
  CertificateSession(const CertificateSession&) = delete;
  CertificateSession& operator=(const CertificateSession&) = delete;

  /// Does `invariant` prove that every one of `goals` holds at every scan's
  /// end? A goal that is not among its conditions is Rejected. Conditions
  /// that rule out the faults of the cone are the caller's to include.
  CertificateReport check(const TransitionSystem& ts,
                          const Invariant& invariant,
                          const std::vector<ExprId>& goals,
                          const CertificateOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "4.8.12", without starting Z3.
std::string z3_version();

}  // namespace rung
