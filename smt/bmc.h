#pragma once

#include <cstdint>
#include <vector>

#include "smt/cone.h"
#include "smt/jump.h"
#include "smt/run.h"
#include "smt/sat.h"
#include "smt/slice_state.h"

namespace rung {

/// Searches runs from power-up by their length in steps of a JumpCircuit.
///
/// Source: Biere, Cimatti, Clarke, Zhu, "Symbolic Model Checking without
///         BDDs", TACAS 1999; the stretch is this project's.
class BoundedSearch {
 public:
  /// Runs of which `never` holds in some step are not considered: there the
  /// encoding is not the program.
  /// They start at power-up, or in the state `from`, by state index.
  BoundedSearch(Cone& cone, const JumpCircuit* jump, AigLit never,
                const Deadline& deadline, const SliceState* from = nullptr);

  /// Searches for a run of exactly `depth` steps (from 1) at whose end a target
  /// holds, over the cone's step graph.
  enum class Answer : std::uint8_t { Found, None, Unknown };
  struct Result {
    Answer answer = Answer::None;
    std::size_t target = 0;  // an index, of the one that was found
    Run run;
  };
  Result search(std::uint32_t depth, const std::vector<AigLit>& targets,
                std::int64_t conflicts);
  /// The same for a target at the end of any step up to `depth`, and the run
  /// may go on behind it. None says nothing: a run may end there for good.
  Result search_within(std::uint32_t depth, const std::vector<AigLit>& targets,
                       std::int64_t conflicts);
  /// Makes the run just found the shortest and calmest of its depth, as far as
  /// so many queries go.
  void minimise(Result& result, std::uint32_t queries);

 private:
  void extend(std::uint32_t depth);
  /// A target at the end of a frame from `first` on, in a run of `depth` steps.
  Result search_frames(std::uint32_t first, std::uint32_t depth,
                       const std::vector<AigLit>& targets,
                       std::int64_t conflicts);
  Run decode(std::uint32_t depth);
  std::int64_t value(std::uint32_t frame, const Word& word);
  AigLit copied(std::uint32_t frame, AigLit of) {
    return frames_.at(frame, of);
  }
  Word copied(std::uint32_t frame, const Word& word);
  /// Solves with `kept_`, the goal and one literal more.
  bool holds_with(AigLit more, std::int64_t conflicts);
  void fewest_scans(std::uint32_t depth, std::uint32_t& queries);
  void calmest_inputs(std::uint32_t depth, std::uint32_t& queries);
  void keep(AigLit wish, std::uint32_t& queries);
  AigLit unchanged(std::uint32_t frame, VarId input);

  Cone* cone_;
  const JumpCircuit* jump_;  // null: scans only
  AigLit never_;
  Unrolling frames_;
  Sat sat_;
  AigClauses clauses_;
  std::uint32_t extended_ = 0;
  std::vector<AigLit> goals_;  // of the last search
  std::vector<AigLit> kept_;   // while minimising: what the run must meet
  Run best_;
};

}  // namespace rung
