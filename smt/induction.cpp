#include "smt/induction.h"

#include "smt/unroll.h"

namespace rung {
namespace {

/// One candidate: it is assumed while `active` and to be shown as `goal`.
struct Item {
  int active = 0;
  int goal = 0;
  AigLit goal_signal = kAigTrue;
  bool alive = true;
};

class Houdini {
 public:
  Houdini(Cone& cone, Unrolling::Start start, const Deadline& deadline)
      : cone_(&cone),
        frames_(cone.circuit().aig(), cone.bits(), start),
        sat_(&deadline),
        clauses_(frames_.aig(), sat_) {}

  void require(std::uint32_t frame, AigLit of) {
    clauses_.require(frames_.at(frame, of));
  }
  void require_scan(std::uint32_t frame, const Known& known) {
    require(frame, cone_->constraint());
    for (AigLit condition : known.conditions) require(frame, condition);
  }
  void require_state(std::uint32_t frame, const Known& known) {
    require(frame, cone_->ranges());
    for (AigLit lemma : known.lemmas) require(frame, lemma);
  }

  Item item(bool alive) {
    Item result;
    result.alive = alive;
    if (alive) result.active = sat_.new_variable();
    return result;
  }
  void assume_in(Item& item, std::uint32_t frame, AigLit of) {
    const AigLit signal = frames_.at(frame, of);
    if (!item.alive || signal == kAigTrue) return;
    sat_.add({-item.active, clauses_.literal(signal)});
  }
  void show_in(Item& item, std::uint32_t frame, AigLit of) {
    if (!item.alive) return;
    item.goal_signal = frames_.at(frame, of);
    if (item.goal_signal == kAigTrue) return;
    item.goal = clauses_.literal(item.goal_signal);
    sat_.phase(-item.goal);
  }

  /// Do `shown` follow from `assumed`? Fills `core` with the items assumed
  /// that were needed.
  bool follows(const std::vector<Item>& items,
               const std::vector<int>& shown_fail, std::vector<bool>& core,
               std::int64_t conflicts) {
    for (const Item& item : items) sat_.assume(item.active);
    sat_.constrain(shown_fail);
    if (sat_.solve(conflicts) != SatAnswer::Unsat) return false;
    core.assign(items.size(), false);
    for (std::size_t i = 0; i < items.size(); ++i) {
      core[i] = sat_.failed(items[i].active);
    }
    return true;
  }

  /// Drops items that fail until none does; false when a limit was reached.
  bool settle(std::vector<Item>& items, const InductionLimits& limits) {
    std::size_t shown = 0;  // items before this one follow from the rest
    std::size_t batch = kBatch;
    // Implies those goals: what follows from them need not be shown again from
    // the scan.
    int so_far = sat_.new_variable();
    for (std::uint32_t round = 0; round < limits.rounds;) {
      std::vector<int> some_fails;
      const std::size_t next = next_batch(items, shown, batch, some_fails);
      if (some_fails.empty()) return true;
      for (const Item& item : items) {
        if (item.alive && item.active != 0) sat_.assume(item.active);
      }
      sat_.assume(so_far);
      sat_.constrain(some_fails);
      switch (sat_.solve(limits.conflicts)) {
        case SatAnswer::Unsat:
          for (const int fails : some_fails) sat_.add({-so_far, -fails});
          shown = next;
          break;
        case SatAnswer::Unknown:
          if (batch == kSmallBatch) return false;
          batch = kSmallBatch;
          break;
        case SatAnswer::Sat:
          drop_failing(items);
          shown = 0;  // what was shown may have rested on them
          so_far = sat_.new_variable();
          ++round;
          break;
      }
    }
    return false;
  }

 private:
  // A few goals a query: refuting thousands at once takes one solver run
  // through all of the formula for each of them.
  static constexpr std::size_t kBatch = 64;
  static constexpr std::size_t kSmallBatch = 16;  // once that was too hard

  static std::size_t next_batch(const std::vector<Item>& items,
                                std::size_t from, std::size_t most,
                                std::vector<int>& fails) {
    for (; from < items.size() && fails.size() < most; ++from) {
      const Item& item = items[from];
      const bool trivial = item.goal_signal == kAigTrue;
      if (item.alive && !trivial) fails.push_back(-item.goal);
    }
    return from;
  }

  void drop_failing(std::vector<Item>& items) {
    for (Item& item : items) {
      const bool trivial = item.goal_signal == kAigTrue;
      if (item.alive && !trivial && !sat_.value(item.goal)) item.alive = false;
    }
  }

  Cone* cone_;
  Unrolling frames_;
  Sat sat_;
  AigClauses clauses_;
};

/// Scans 0 .. k-1 from power-up.
bool base(Cone& cone, const Known& known, std::uint32_t k, Candidates& c,
          const InductionLimits& limits, const Deadline& deadline) {
  if (k == 0 && c.lemmas.empty()) return true;
  Houdini session(cone, Unrolling::Start::Initial, deadline);
  for (std::uint32_t frame = 0; frame <= k; ++frame) {
    if (frame > 0) session.require_scan(frame - 1, known);
    std::vector<Item> items;
    std::vector<std::pair<std::vector<bool>*, std::size_t>> of;
    const auto add = [&](AigLit signal, std::uint32_t at,
                         std::vector<bool>& holds, std::size_t i) {
      if (!holds[i]) return;
      Item item;
      session.show_in(item, at, signal);
      items.push_back(item);
      of.emplace_back(&holds, i);
    };
    for (std::size_t i = 0; i < c.lemmas.size(); ++i) {
      add(c.lemmas[i], frame, c.lemma_holds, i);
    }
    for (std::size_t i = 0; frame > 0 && i < c.conditions.size(); ++i) {
      add(c.conditions[i], frame - 1, c.condition_holds, i);
    }
    if (!session.settle(items, limits)) return false;
    for (std::size_t i = 0; i < items.size(); ++i) {
      (*of[i].first)[of[i].second] = items[i].alive;
    }
  }
  return true;
}

bool step(Cone& cone, const Known& known, std::uint32_t k, Candidates& c,
          const InductionLimits& limits, const Deadline& deadline) {
  Houdini session(cone, Unrolling::Start::Any, deadline);
  for (std::uint32_t frame = 0; frame <= k; ++frame) {
    session.require_scan(frame, known);
    session.require_state(frame, known);
  }
  std::vector<Item> items;
  for (std::size_t i = 0; i < c.conditions.size(); ++i) {
    Item item = session.item(c.condition_holds[i]);
    for (std::uint32_t frame = 0; frame < k; ++frame) {
      session.assume_in(item, frame, c.conditions[i]);
    }
    session.show_in(item, k, c.conditions[i]);
    items.push_back(item);
  }
  for (std::size_t i = 0; i < c.lemmas.size(); ++i) {
    Item item = session.item(c.lemma_holds[i]);
    for (std::uint32_t frame = 0; frame <= k; ++frame) {
      session.assume_in(item, frame, c.lemmas[i]);
    }
    session.show_in(item, k + 1, c.lemmas[i]);
    items.push_back(item);
  }
  if (!session.settle(items, limits)) return false;
  const std::size_t conditions = c.conditions.size();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i < conditions) {
      c.condition_holds[i] = items[i].alive;
    } else {
      c.lemma_holds[i - conditions] = items[i].alive;
    }
  }
  return true;
}

}  // namespace

std::vector<bool> needed_lemmas(Cone& cone, const Known& known,
                                std::int64_t conflicts,
                                const Deadline& deadline) {
  Known facts;
  facts.k = known.k;
  Houdini session(cone, Unrolling::Start::Any, deadline);
  for (std::uint32_t frame = 0; frame <= known.k; ++frame) {
    session.require_scan(frame, facts);
    session.require_state(frame, facts);
  }
  std::vector<int> open;  // negations of what is still to be shown
  for (AigLit condition : known.conditions) {
    for (std::uint32_t frame = 0; frame < known.k; ++frame) {
      session.require(frame, condition);
    }
    Item item;
    session.show_in(item, known.k, condition);
    if (item.goal_signal != kAigTrue) open.push_back(-item.goal);
  }
  std::vector<Item> items;
  for (AigLit lemma : known.lemmas) {
    Item item = session.item(true);
    for (std::uint32_t frame = 0; frame <= known.k; ++frame) {
      session.assume_in(item, frame, lemma);
    }
    session.show_in(item, known.k + 1, lemma);
    items.push_back(item);
  }
  std::vector<bool> needed(items.size(), false);
  std::vector<bool> core;
  while (!open.empty()) {
    if (!session.follows(items, open, core, conflicts)) {
      return std::vector<bool>(items.size(), true);
    }
    open.clear();
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!core[i] || needed[i]) continue;
      needed[i] = true;
      if (items[i].goal_signal != kAigTrue) open.push_back(-items[i].goal);
    }
  }
  return needed;
}

bool prove_by_induction(Cone& cone, const Known& known, std::uint32_t k,
                        Candidates& candidates, const InductionLimits& limits,
                        const Deadline& deadline) {
  candidates.condition_holds.assign(candidates.conditions.size(), true);
  candidates.lemma_holds.assign(candidates.lemmas.size(), true);
  return base(cone, known, k, candidates, limits, deadline) &&
         step(cone, known, k, candidates, limits, deadline);
}

}  // namespace rung
