#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "smt/cone.h"
#include "smt/invariant.h"
#include "smt/simulation.h"

namespace rung {

/// A lemma that may hold, in both readings.
struct Candidate {
  LemmaClause clause;
  AigLit signal = kAigTrue;  // over the cone's state leaves
};

AigLit signal_of(Cone& cone, const LemmaAtom& atom);
AigLit signal_of(Cone& cone, const LemmaClause& clause);

/// Guesses lemmas of the shapes that rung programs need: constants,
/// implications between bits and between comparisons of words (`x == 0`,
/// `x >= P`) that read each other, `x == y`, `x <= y` and `x == min(y, cap)`
/// of clocks and counters, also under a bit, and how far a clock that runs is
/// behind another: `runs -> x >= P || y <= x + c`, with c as runs show it (sums
/// of presets along a chain of timers). What a random run refutes is left
/// out; the rest is for an induction to thin out.
///
/// Pairs are taken among all of a small cone, else among structural
/// neighbours, so the number of candidates stays linear.
class Templates {
 public:
  /// Adds terms to `ts`, which must be the cone's. `roots` are what is to be
  /// shown: the states that one of them reads are neighbours.
  Templates(TransitionSystem& ts, Cone& cone, const std::vector<ExprId>& roots);

  /// Remembers the states of one simulation step.
  void sample(const Simulation& simulation);

  /// Of what was sampled of each state, by place in Cone::states(): equal for
  /// states that were equal.
  std::vector<std::uint64_t> signatures() const;

  /// What a literal that never changed in the samples is good for.
  enum class Constants : std::uint8_t {
    Alone,  // it is a candidate, and makes no pairs
    Pairs,  // it was not to be shown alone: the samples did not come that far;
            // relations of words may also hold under a bit only
  };
  /// Those that all samples meet.
  /// Implications between states that read each other, or between others; the
  /// first are fewer and more often what is needed.
  enum class Reach : std::uint8_t { Near, Far };
  std::vector<Candidate> candidates(Constants constants, Reach reach);

 private:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  using Lanes64 = std::vector<std::uint64_t>;  // by sample

  /// A bit term over one or two states, and where it is true.
  struct Literal {
    ExprId term;
    std::uint32_t state = 0;
    Lanes64 holds;
  };
  struct Column {  // what was sampled of a state
    bool word = false;
    ExprId running;  // of a clock
    Lanes64 runs;
    Lanes64 bits;
    std::vector<std::int64_t> words;  // sample * 64 + lane
  };

  void find_neighbours(const std::vector<ExprId>& roots);
  std::vector<std::uint32_t> read_by(ExprId term, std::size_t limit) const;
  void connect(const std::vector<std::uint32_t>& group);
  bool near(std::uint32_t x, std::uint32_t y) const;
  void make_literals();
  void add_literal(std::uint32_t state, ExprId term, Lanes64 holds);
  void pair_up(Constants constants, const Pairs& pairs,
               std::vector<Candidate>& result);
  void relate(std::uint32_t x, std::uint32_t y, bool guarded,
              std::vector<Candidate>& result);
  struct Lags {
    std::optional<std::int64_t> any;
    std::optional<std::int64_t> both;
  };
  Lags lags(const Column& x, const Column& y, std::int64_t p) const;
  void follow(std::uint32_t x, std::uint32_t y, Reach reach,
              std::vector<Candidate>& result);
  void offer(ExprId relation, const Lanes64& holds,
             const std::vector<std::uint32_t>& guards,
             std::vector<Candidate>& result);
  bool always(const Lanes64& holds, bool value) const;
  bool always_either(const Lanes64& a, bool not_a, const Lanes64& b,
                     bool not_b) const;
  void add(LemmaClause clause, std::vector<Candidate>& result);

  TransitionSystem& ts_;
  Cone* cone_;
  std::unordered_map<std::uint32_t, std::uint32_t> place_;  // of a state
  std::vector<Column> columns_;                             // by place
  std::vector<std::vector<std::uint32_t>> literals_of_;     // by place
  std::vector<std::vector<std::int64_t>> thresholds_;       // by place
  Pairs near_;                                              // of places
  Pairs far_;  // all others, in a small cone
  std::vector<Literal> literals_;
  Lanes64 alive_;
  std::unordered_set<AigLit> offered_;
};

}  // namespace rung
