#include "smt/register_classes.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace rung {
namespace {

constexpr std::size_t kRounds = 300;
constexpr std::size_t kGates = 30'000'000;  // in all rounds
constexpr std::int64_t kConflicts = 2000;   // a query
constexpr std::size_t kBatch = 32;          // pairs a query

/// One scan in which the states of a class are one.
class MergedStep {
 public:
  MergedStep(Cone& cone, const std::vector<bool>& needed,
             const std::vector<std::uint32_t>& first)
      : image_(cone.circuit().aig().size(), kAigFalse) {
    const Aig& step = cone.circuit().aig();
    const auto bits = bits_of_classes(cone, first);
    std::map<Bit, AigLit> made;
    for (std::uint32_t node = 1; node < step.size(); ++node) {
      if (!needed[node]) continue;
      if (step.is_gate(node)) {
        image_[node] =
            aig_.conjunction(at(step.left(node)), at(step.right(node)));
        continue;
      }
      const auto bit = bits.find(node);
      if (bit == bits.end()) {
        image_[node] = aig_.input();
        continue;
      }
      const auto [leaf, is_new] = made.try_emplace(bit->second, kAigFalse);
      if (is_new) leaf->second = aig_.input();
      image_[node] = leaf->second;
    }
  }

  Aig& aig() { return aig_; }
  AigLit at(AigLit a) const { return image_[aig_node(a)] ^ (a & 1U); }

 private:
  using Bit = std::pair<std::uint32_t, std::size_t>;  // first of class, bit

  /// By node of a leaf.
  static std::unordered_map<std::uint32_t, Bit> bits_of_classes(
      const Cone& cone, const std::vector<std::uint32_t>& first) {
    const TransitionSystem& ts = cone.ts();
    std::unordered_map<std::uint32_t, Bit> result;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      const Word& leaves = cone.leaves(ts.states[cone.states()[i]].var);
      for (std::size_t bit = 0; bit < leaves.size(); ++bit) {
        if (aig_node(leaves[bit]) == 0) continue;  // a known sign
        result[aig_node(leaves[bit])] = {first[i], bit};
      }
    }
    return result;
  }

  Aig aig_;
  std::vector<AigLit> image_;  // by node of the step
};

class Partition {
 public:
  Partition(Cone& cone, const Known& known,
            const std::vector<std::uint64_t>& signatures,
            const std::vector<AigLit>& goals, const Deadline& deadline)
      : cone_(cone), known_(known), goals_(goals), deadline_(deadline) {
    const TransitionSystem& ts = cone.ts();
    std::map<std::tuple<Type, std::int64_t, std::int64_t, std::int64_t,
                        std::uint64_t>,
             std::uint32_t>
        first_of;
    for (std::uint32_t i = 0; i < cone.states().size(); ++i) {
      const State& state = ts.states[cone.states()[i]];
      const Variable& var = ts.vars[state.var];
      next_.push_back(cone.circuit().next(cone.states()[i]));
      first_.push_back(
          first_of
              .try_emplace(
                  {var.type, var.low, var.high, state.init, signatures[i]}, i)
              .first->second);
    }
    needed_ = cone.circuit().aig().cone(roots());
  }

  RegisterClasses run() {
    const std::size_t rounds =
        std::min(kRounds, kGates / cone_.circuit().aig().size());
    for (std::size_t round = 0; round < rounds; ++round) {
      if (deadline_.passed() || !any_pair()) return {};
      if (!refine()) return finish();
    }
    return {};
  }

 private:
  std::vector<AigLit> roots() const {
    std::vector<AigLit> result = {cone_.constraint(), cone_.ranges()};
    for (const Word& word : next_) {
      result.insert(result.end(), word.begin(), word.end());
    }
    const auto add = [&](const std::vector<AigLit>& more) {
      result.insert(result.end(), more.begin(), more.end());
    };
    add(known_.conditions);
    add(known_.lemmas);
    add(goals_);
    return result;
  }

  bool any_pair() const {
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      if (first_[i] != i) return true;
    }
    return false;
  }

  struct Session {
    Session(MergedStep& merged, const Partition& of)
        : sat(&of.deadline_), clauses(merged.aig(), sat) {
      clauses.require(merged.at(of.cone_.constraint()));
      clauses.require(merged.at(of.cone_.ranges()));
      for (AigLit a : of.known_.conditions) clauses.require(merged.at(a));
      for (AigLit a : of.known_.lemmas) clauses.require(merged.at(a));
    }
    Sat sat;
    AigClauses clauses;
  };

  AigLit differ(MergedStep& merged, std::uint32_t i) const {
    const Word& a = next_[i];
    const Word& b = next_[first_[i]];
    AigLit result = kAigFalse;
    for (std::size_t bit = 0; bit < a.size(); ++bit) {
      result = merged.aig().disjunction(
          result,
          merged.aig().exclusive_or(merged.at(a[bit]), merged.at(b[bit])));
    }
    return result;
  }

  /// Splits classes by one scan in which two next values differ, or takes out
  /// what is too hard; false when there is nothing to split.
  bool refine() {
    MergedStep merged(cone_, needed_, first_);
    std::vector<std::pair<std::uint32_t, AigLit>> open;
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      if (first_[i] == i) continue;
      const AigLit wrong = differ(merged, i);
      if (wrong != kAigFalse) open.emplace_back(i, wrong);
    }
    if (open.empty()) return false;
    Session session(merged, *this);
    for (std::size_t from = 0; from < open.size(); from += kBatch) {
      const std::size_t end = std::min(open.size(), from + kBatch);
      std::vector<int> some;
      for (std::size_t j = from; j < end; ++j) {
        some.push_back(session.clauses.literal(open[j].second));
      }
      session.sat.constrain(some);
      switch (session.sat.solve(kConflicts)) {
        case SatAnswer::Unsat:
          break;
        case SatAnswer::Sat:
          split(merged, session.clauses);
          return true;
        case SatAnswer::Unknown:
          for (std::size_t j = from; j < end; ++j) take_out(open[j].first);
          return true;
      }
    }
    return false;
  }

  /// Members whose next values differ in the model come apart.
  void split(const MergedStep& merged, const AigClauses& clauses) {
    std::map<std::pair<std::uint32_t, std::vector<bool>>, std::uint32_t> part;
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      std::vector<bool> value;
      for (AigLit bit : next_[i]) {
        value.push_back(clauses.value(merged.at(bit)));
      }
      first_[i] =
          part.try_emplace({first_[i], std::move(value)}, i).first->second;
    }
  }

  void take_out(std::uint32_t i) { first_[i] = i; }

  RegisterClasses finish() {
    RegisterClasses result;
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      if (first_[i] == i) continue;
      result.equal.emplace_back(cone_.states()[i], cone_.states()[first_[i]]);
    }
    MergedStep merged(cone_, needed_, first_);
    Session session(merged, *this);
    for (AigLit goal : goals_) {
      const AigLit wrong = merged.at(goal);
      bool never = wrong == kAigFalse;
      if (!never && wrong != kAigTrue) {
        session.sat.assume(session.clauses.literal(wrong));
        never = session.sat.solve(kConflicts) == SatAnswer::Unsat;
      }
      result.unreachable.push_back(never);
    }
    return result;
  }

  Cone& cone_;
  const Known& known_;
  const std::vector<AigLit>& goals_;
  const Deadline& deadline_;
  std::vector<Word> next_;            // by place in Cone::states()
  std::vector<std::uint32_t> first_;  // of its class, by place
  std::vector<bool> needed_;          // by node of the step
};

}  // namespace

RegisterClasses register_classes(Cone& cone, const Known& known,
                                 const std::vector<std::uint64_t>& signatures,
                                 const std::vector<AigLit>& goals,
                                 const Deadline& deadline) {
  return Partition(cone, known, signatures, goals, deadline).run();
}

}  // namespace rung
