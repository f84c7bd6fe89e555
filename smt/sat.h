#pragma once

#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "smt/aig.h"

namespace rung {

/// The wall clock of a whole run: engines ask it between steps, a solver
/// within one. Effort limits come first; this is the outer one.
class Deadline {
 public:
  /// `stop`, if any, outlives this and its parts: once it is true, every
  /// deadline has passed.
  explicit Deadline(double seconds, const std::atomic<bool>* stop = nullptr);
  bool passed() const;
  /// When this share of the time that is left from now on has passed.
  Deadline part(double share) const;

 private:
  std::int64_t at_ns_ = 0;
  const std::atomic<bool>* stop_ = nullptr;
};

/// The solver's version.
std::string sat_version();

enum class SatAnswer : std::uint8_t { Sat, Unsat, Unknown };

/// One incremental SAT session. Literals are non-zero integers, negation is
/// the sign.
class Sat {
 public:
  explicit Sat(const Deadline* deadline = nullptr);
  ~Sat();
  Sat(const Sat&) = delete;
  Sat& operator=(const Sat&) = delete;

  int new_variable();
  void add(std::initializer_list<int> clause);
  void add(const std::vector<int>& clause);

  void assume(int literal);
  /// A clause for the next solve() only.
  void constrain(const std::vector<int>& clause);
  /// `conflicts` < 0: no limit. The answer Unknown: a limit was reached.
  SatAnswer solve(std::int64_t conflicts = -1);
  bool value(int literal) const;   // after Sat
  bool failed(int literal) const;  // after Unsat: is the assumption to blame
  /// Prefers this value of a decision.
  void phase(int literal);

 private:
  struct Impl;
  Impl& impl() const;

  const Deadline* deadline_;
  mutable std::unique_ptr<Impl> impl_;
};

/// Gives the gates of a graph their clauses in a session, when first asked.
class AigClauses {
 public:
  AigClauses(const Aig& aig, Sat& sat);

  /// The solver's literal of `a`; its cone is in the session afterwards.
  int literal(AigLit a);
  /// 0 when `a` has none yet.
  int known_literal(AigLit a) const;
  /// Value in the last model; false when the solver never saw it.
  bool value(AigLit a) const;
  void require(AigLit a);

 private:
  void define(std::uint32_t node);

  const Aig* aig_;
  Sat* sat_;
  std::vector<int> variable_;  // by node; 0: none
  std::vector<std::uint32_t> stack_;
};

}  // namespace rung
