#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace rung::script {

/// Refutes claims about clauses: a SAT solver finds the proof, and unit
/// propagation of our own follows it step by step, so that no answer of the
/// solver is taken for granted.
class Refuter {
 public:
  /// `clauses` one after the other, each with a 0 behind it; all `assumed` are
  /// true as well.
  Refuter(const std::vector<int>& clauses, int variables,
          const std::vector<int>& assumed);
  ~Refuter();
  Refuter(const Refuter&) = delete;
  Refuter& operator=(const Refuter&) = delete;

  enum class Answer : std::uint8_t {
    Refuted,
    Model,
    Unknown,   // a limit was reached
    Unproved,  // the solver's proof is none
  };
  /// Is it false that one of `claims` is false? What unit propagation sees
  /// alone is not asked of the solver.
  Answer refute(const std::vector<int>& claims, std::int64_t conflicts);

  /// Steps of proofs so far, a measure of effort.
  std::int64_t steps() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rung::script
