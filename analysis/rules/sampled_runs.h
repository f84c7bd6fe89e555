#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {

/// 64 random runs of a transition system side by side, a scan at a time:
/// choose_inputs() or the same inputs again, evaluate(), advance(). What they
/// show is real: every value is one that the system has in some run.
/// Deterministic: the generator starts from a constant.
class SampledRuns {
 public:
  static constexpr std::size_t kLanes = 64;
  using Bits = std::uint64_t;  // one run a bit
  using Words = std::array<std::int64_t, kLanes>;

  /// Only what `observed` and the states depend on is computed.
  SampledRuns(const TransitionSystem& ts, const std::vector<ExprId>& observed);

  /// How many scans `work`, about that many evaluations of terms, allows.
  std::uint64_t scans_for(std::uint64_t work) const { return work / cost_; }

  void start();  // before the first scan
  void choose_inputs();
  void freeze();  // no time passes from now on

  /// Computes one scan; the lanes whose inputs meet the assumptions.
  Bits evaluate();
  /// The values at the scan's end become the state, in the lanes of `valid`.
  void advance(Bits valid);

  /// In place of advance(): computes the next scan too, with the same inputs,
  /// and returns its lanes. Where nothing but elapsed times moves between the
  /// two, the scans until a comparison changes are all alike: the next
  /// advance() skips them.
  Bits hold(Bits valid);

  Bits bits(ExprId id) const { return bits_[id.index()]; }
  std::int64_t value(ExprId id, std::size_t lane) const;
  bool needed(ExprId id) const { return needed_[id.index()]; }

 private:
  static constexpr std::uint32_t kHabit = 96;  // scans

  /// What a bit input does in each lane.
  struct Habit {
    Bits rests = 0;  // at `value`
    Bits value = 0;
  };

  const Expr& expr(std::size_t index) const {
    return ts_.exprs[ExprId(static_cast<std::uint32_t>(index))];
  }
  bool is_word(const State& state) const {
    return ts_.vars[state.var].type == Type::Word;
  }
  Words& words_of(ExprId id) { return words_[slot_[id.index()]]; }
  const Words& words_of(ExprId id) const { return words_[slot_[id.index()]]; }

  void mark_needed(const std::vector<ExprId>& observed);
  void collect_constants();
  void reset();
  void choose_habits();
  void choose_words(const Variable& var, Bits change);
  void choose_dt();
  void compute(const Expr& it, std::size_t i);
  Bits compute_bits(const Expr& it) const;
  Bits compare(const Expr& it) const;
  void compute_words(const Expr& it, Words& out) const;
  Bits unmoved() const;
  void limit_skip(const Expr& comparison);

  const TransitionSystem& ts_;
  std::uint64_t cost_ = 1;  // of a scan, about
  std::mt19937_64 random_{20200712};
  std::vector<std::uint32_t> slot_;  // by term: of a word, in words_
  std::vector<bool> needed_;
  std::vector<std::uint32_t> order_;  // the needed terms that are computed
  std::vector<Bits> bits_;
  std::vector<Words> words_;
  std::vector<std::int64_t> constants_;
  std::vector<Habit> habits_;  // by term
  std::uint32_t chosen_ = 0;   // scans with new inputs
  std::vector<Bits> next_bits_;
  std::vector<Words> next_words_;
  Words skipped_{};                 // scans, by lane
  std::vector<Bits> earlier_bits_;  // of the scan before, in hold()
  std::vector<Words> earlier_words_;
};

}  // namespace rung
