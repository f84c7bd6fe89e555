#include "smt/pdr.h"

#include <algorithm>
#include <queue>

#include "smt/sat.h"

namespace rung {
namespace {

/// A set of states: signals with their values, sorted; signal * 2 + value.
using Cube = std::vector<std::uint32_t>;

bool subsumes(const Cube& wide, const Cube& narrow) {
  return std::includes(narrow.begin(), narrow.end(), wide.begin(), wide.end());
}

/// A cube from which the target is reached by the inputs along `next`.
struct Obligation {
  Cube cube;
  std::vector<std::int64_t> inputs;
  std::uint32_t next = 0;  // the obligation it leads to; itself: the target
};

class Pdr {
 public:
  Pdr(Cone& cone, const std::vector<PdrSignal>& signals, const Known& known,
      AigLit target, const PdrLimits& limits, const Deadline& deadline)
      : cone_(cone),
        signals_(signals),
        target_(target),
        limits_(limits),
        deadline_(deadline),
        sat_(&deadline),
        clauses_(cone.circuit().aig(), sat_),
        lift_sat_(&deadline),
        lift_clauses_(cone.circuit().aig(), lift_sat_) {
    prepare(known);
  }

  PdrResult run() {
    for (;;) {
      const PdrResult::Answer answer = block_all();
      if (answer != PdrResult::Answer::Unreachable) {
        result_.answer = answer;
        return std::move(result_);
      }
      add_frame();
      if (propagate()) {
        result_.answer = PdrResult::Answer::Unreachable;
        return std::move(result_);
      }
      if (exhausted()) return {};
    }
  }

 private:
  enum class Outcome : std::uint8_t { Yes, No, Limit };

  void prepare(const Known& known) {
    legal_ = cone_.constraint();
    for (AigLit condition : known.conditions) {
      legal_ = cone_.circuit().aig().conjunction(legal_, condition);
    }
    clauses_.require(legal_);
    clauses_.require(cone_.ranges());
    for (AigLit lemma : known.lemmas) clauses_.require(lemma);
    for (const PdrSignal& signal : signals_) {
      now_.push_back(clauses_.literal(signal.now));
      next_.push_back(clauses_.literal(signal.next));
      lift_now_.push_back(lift_clauses_.literal(signal.now));
      lift_next_.push_back(lift_clauses_.literal(signal.next));
    }
    for (VarId input : cone_.inputs()) {
      for (AigLit bit : cone_.leaves(input)) {
        if (aig_node(bit) == 0) continue;
        clauses_.literal(bit);
        input_bits_.push_back(bit);
        lift_inputs_.push_back(lift_clauses_.literal(bit));
      }
    }
    lift_legal_ = lift_clauses_.literal(legal_);
    lift_target_ = lift_clauses_.literal(target_);
    target_literal_ = clauses_.literal(target_);
    add_frame();  // the initial state
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const int value = signals_[i].init ? now_[i] : -now_[i];
      sat_.add({-active_[0], value});
    }
    add_frame();
  }

  void add_frame() {
    frames_.emplace_back();
    active_.push_back(sat_.new_variable());
  }
  std::uint32_t top() const {
    return static_cast<std::uint32_t>(frames_.size() - 1);
  }
  bool exhausted() const {
    return queries_ >= limits_.queries || deadline_.passed();
  }

  static std::size_t signal(std::uint32_t literal) { return literal >> 1U; }
  static bool positive(std::uint32_t literal) { return (literal & 1U) != 0; }
  int now(std::uint32_t l) const {
    return positive(l) ? now_[signal(l)] : -now_[signal(l)];
  }
  int next(std::uint32_t l) const {
    return positive(l) ? next_[signal(l)] : -next_[signal(l)];
  }
  bool excludes_init(std::uint32_t literal) const {
    return signals_[signal(literal)].init != positive(literal);
  }
  bool meets_init(const Cube& cube) const {
    return std::none_of(cube.begin(), cube.end(),
                        [&](std::uint32_t l) { return excludes_init(l); });
  }

  /// Assumes the states of frame `level` (all states above the last frame).
  void assume_frame(std::uint32_t level) {
    for (std::uint32_t i = level; i < active_.size(); ++i) {
      if (i > 0 || level == 0) sat_.assume(active_[i]);
    }
  }

  Outcome solve() {
    ++queries_;
    switch (sat_.solve(limits_.conflicts)) {
      case SatAnswer::Sat:
        return Outcome::Yes;
      case SatAnswer::Unsat:
        return Outcome::No;
      case SatAnswer::Unknown:
        return Outcome::Limit;
    }
    return Outcome::Limit;
  }

  /// Is `cube` reached in one scan from frame `level`, outside of the cube?
  Outcome reached(const Cube& cube, std::uint32_t level, bool outside) {
    assume_frame(level);
    if (outside) {
      std::vector<int> clause;
      for (std::uint32_t literal : cube) clause.push_back(-now(literal));
      sat_.constrain(clause);
    }
    for (std::uint32_t literal : cube) sat_.assume(next(literal));
    return solve();
  }

  /// What is left of a cube that reached() said No to; still excludes init.
  Cube core(const Cube& cube) {
    Cube kept;
    for (std::uint32_t literal : cube) {
      if (sat_.failed(next(literal))) kept.push_back(literal);
    }
    if (!meets_init(kept)) return kept;
    for (std::uint32_t literal : cube) {
      if (!excludes_init(literal)) continue;
      kept.insert(std::lower_bound(kept.begin(), kept.end(), literal), literal);
      break;
    }
    return kept;
  }

  // --- predecessors
  // -----------------------------------------------------------

  std::vector<std::int64_t> model_inputs() {
    std::vector<std::int64_t> values;
    for (VarId input : cone_.inputs()) {
      const Word& leaves = cone_.leaves(input);
      const bool word = cone_.ts().vars[input].type == Type::Word;
      std::uint64_t value = 0;
      for (std::size_t i = 0; i < (word ? 64 : 1); ++i) {
        const AigLit bit = leaves[std::min(i, leaves.size() - 1)];
        const bool set =
            aig_node(bit) == 0 ? bit == kAigTrue : clauses_.value(bit);
        value |= std::uint64_t{set} << i;
      }
      values.push_back(static_cast<std::int64_t>(value));
    }
    return values;
  }

  /// The states, as many as can be told, that the model's inputs take where
  /// the model's state goes: to `cube`, or to the target when it is empty.
  Cube lifted(const Cube& cube) {
    Cube full;
    for (std::uint32_t i = 0; i < signals_.size(); ++i) {
      full.push_back(i * 2 + (sat_.value(now_[i]) ? 1U : 0U));
    }
    std::vector<int> inputs;
    for (std::size_t i = 0; i < input_bits_.size(); ++i) {
      const bool set = clauses_.value(input_bits_[i]);
      inputs.push_back(set ? lift_inputs_[i] : -lift_inputs_[i]);
    }
    // Coarse signals first; bits of words only when those do not suffice.
    for (const bool fine : {false, true}) {
      std::vector<int> miss = {-lift_legal_};
      for (std::uint32_t l : cube) {
        miss.push_back(positive(l) ? -lift_next_[signal(l)]
                                   : lift_next_[signal(l)]);
      }
      if (cube.empty()) miss.push_back(-lift_target_);
      lift_sat_.constrain(miss);
      for (int input : inputs) lift_sat_.assume(input);
      const auto assumed = [&](std::uint32_t l) {
        return positive(l) ? lift_now_[signal(l)] : -lift_now_[signal(l)];
      };
      for (std::uint32_t l : full) {
        if (fine || !signals_[signal(l)].fine) lift_sat_.assume(assumed(l));
      }
      ++queries_;
      if (lift_sat_.solve(limits_.conflicts) != SatAnswer::Unsat) continue;
      Cube kept;
      for (std::uint32_t l : full) {
        const bool used = fine || !signals_[signal(l)].fine;
        if (used && lift_sat_.failed(assumed(l))) kept.push_back(l);
      }
      return kept;
    }
    return full;
  }

  // --- blocking
  // ---------------------------------------------------------------

  PdrResult::Answer block_all() {
    for (;;) {
      if (exhausted()) return PdrResult::Answer::Unknown;
      assume_frame(top());
      sat_.assume(target_literal_);
      switch (solve()) {
        case Outcome::No:
          return PdrResult::Answer::Unreachable;
        case Outcome::Limit:
          return PdrResult::Answer::Unknown;
        case Outcome::Yes:
          break;
      }
      obligations_.clear();
      obligations_.push_back({{}, model_inputs(), 0});
      obligations_[0].cube = lifted({});
      switch (block(0)) {
        case Outcome::Yes:
          break;
        case Outcome::No:
          return PdrResult::Answer::Reachable;
        case Outcome::Limit:
          return PdrResult::Answer::Unknown;
      }
    }
  }

  void take_run(std::uint32_t from) {
    for (;;) {
      result_.run.push_back({obligations_[from].inputs, 0});
      if (obligations_[from].next == from) return;
      from = obligations_[from].next;
    }
  }

  /// Blocks the obligation and all it leads to; No: a run was found.
  Outcome block(std::uint32_t first) {
    using Entry = std::pair<std::uint32_t, std::uint32_t>;  // level, index
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.emplace(top(), first);
    while (!queue.empty()) {
      if (exhausted()) return Outcome::Limit;
      const auto [level, index] = queue.top();
      queue.pop();
      const Cube cube = obligations_[index].cube;
      if (meets_init(cube)) {
        take_run(index);
        return Outcome::No;
      }
      if (level == 0 || is_blocked(cube, level)) continue;
      switch (reached(cube, level - 1, true)) {
        case Outcome::Limit:
          return Outcome::Limit;
        case Outcome::No: {
          const std::uint32_t reach = learn(core(cube), level);
          if (reach < top()) queue.emplace(reach + 1, index);
          break;
        }
        case Outcome::Yes: {
          Obligation before{{}, model_inputs(), index};
          before.cube = lifted(cube);
          obligations_.push_back(std::move(before));
          queue.emplace(level - 1,
                        static_cast<std::uint32_t>(obligations_.size() - 1));
          queue.emplace(level, index);
          break;
        }
      }
    }
    return Outcome::Yes;
  }

  bool is_blocked(const Cube& cube, std::uint32_t level) const {
    for (std::uint32_t i = level; i < frames_.size(); ++i) {
      for (const Cube& blocked : frames_[i]) {
        if (subsumes(blocked, cube)) return true;
      }
    }
    return false;
  }

  /// Generalises a cube blocked at `level` and adds it; returns how far up.
  std::uint32_t learn(Cube cube, std::uint32_t level) {
    generalise(cube, level);
    while (level < top() && !exhausted() &&
           reached(cube, level, true) == Outcome::No) {
      cube = core(cube);
      ++level;
    }
    add_blocked(cube, level);
    return level;
  }

  /// Drops literals as long as the cube stays unreachable from below.
  void generalise(Cube& cube, std::uint32_t level) {
    Cube order = cube;
    std::stable_sort(
        order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
          return signals_[signal(a)].fine > signals_[signal(b)].fine;
        });
    for (std::uint32_t literal : order) {
      if (cube.size() <= 1 || exhausted()) return;
      const auto at = std::lower_bound(cube.begin(), cube.end(), literal);
      if (at == cube.end() || *at != literal) continue;  // dropped by a core
      Cube smaller = cube;
      smaller.erase(smaller.begin() + (at - cube.begin()));
      if (meets_init(smaller)) continue;
      if (reached(smaller, level - 1, true) == Outcome::No) {
        cube = core(smaller);
      }
    }
  }

  void add_blocked(const Cube& cube, std::uint32_t level) {
    for (std::uint32_t i = 1; i <= level; ++i) {
      std::erase_if(frames_[i],
                    [&](const Cube& other) { return subsumes(cube, other); });
    }
    add_clause(cube, level);
    frames_[level].push_back(cube);
  }

  void add_clause(const Cube& cube, std::uint32_t level) {
    std::vector<int> clause = {-active_[level]};
    for (std::uint32_t literal : cube) clause.push_back(-now(literal));
    sat_.add(clause);
  }

  /// Moves cubes up; true when two frames have become the same.
  bool propagate() {
    for (std::uint32_t level = 1; level < top(); ++level) {
      const std::vector<Cube> cubes = frames_[level];
      std::vector<Cube> stay;
      for (const Cube& cube : cubes) {
        if (!exhausted() && reached(cube, level, false) == Outcome::No) {
          frames_[level + 1].push_back(cube);
          add_clause(cube, level + 1);
        } else {
          stay.push_back(cube);
        }
      }
      frames_[level] = std::move(stay);
      if (frames_[level].empty()) {
        collect(level + 1);
        return true;
      }
    }
    return false;
  }

  void collect(std::uint32_t from) {
    for (std::uint32_t i = from; i < frames_.size(); ++i) {
      for (const Cube& cube : frames_[i]) {
        LemmaClause lemma;
        for (std::uint32_t literal : cube) {
          LemmaAtom atom = signals_[signal(literal)].atom;
          atom.negated = atom.negated != positive(literal);
          lemma.push_back(atom);
        }
        result_.lemmas.push_back(std::move(lemma));
      }
    }
  }

  Cone& cone_;
  const std::vector<PdrSignal>& signals_;
  AigLit target_;
  const PdrLimits& limits_;
  const Deadline& deadline_;
  Sat sat_;
  AigClauses clauses_;
  // Lifting asks about single states, legal or not: a session without facts.
  Sat lift_sat_;
  AigClauses lift_clauses_;
  AigLit legal_ = kAigTrue;
  int target_literal_ = 0;
  int lift_legal_ = 0;
  int lift_target_ = 0;
  std::vector<int> now_;  // by signal
  std::vector<int> next_;
  std::vector<int> lift_now_;
  std::vector<int> lift_next_;
  std::vector<AigLit> input_bits_;
  std::vector<int> lift_inputs_;
  std::vector<std::vector<Cube>> frames_;  // cubes blocked up to this frame
  std::vector<int> active_;                // by frame
  std::vector<Obligation> obligations_;
  std::uint32_t queries_ = 0;
  PdrResult result_;
};

}  // namespace

PdrResult property_directed_reachability(Cone& cone,
                                         const std::vector<PdrSignal>& signals,
                                         const Known& known, AigLit target,
                                         const PdrLimits& limits,
                                         const Deadline& deadline) {
  return Pdr(cone, signals, known, target, limits, deadline).run();
}

}  // namespace rung
