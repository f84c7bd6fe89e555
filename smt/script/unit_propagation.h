#pragma once

#include <cstdint>
#include <vector>

namespace rung::script {

/// Follows a solver's proof: a clause is accepted when assuming all of its
/// literals false leads to a conflict by unit propagation alone ("RUP":
/// E. Goldberg, Y. Novikov, Verification of proofs of unsatisfiability for CNF
/// formulas, DATE 2003). Nothing is ever deleted, which only helps.
class UnitPropagation {
 public:
  /// A clause of the formula.
  void add(const std::vector<int>& clause);
  /// A clause that the formula and what was derived imply; false: not so, as
  /// far as unit propagation sees.
  bool implies(const std::vector<int>& clause);
  /// The same, and it is a clause of the formula from then on.
  bool derive(const std::vector<int>& clause);

 private:
  struct Watch {
    std::uint32_t clause;  // where it starts
    int other;             // when this is true, the clause need not be visited
  };

  static std::size_t slot(int literal) {
    return literal > 0 ? 2 * static_cast<std::size_t>(literal)
                       : 2 * static_cast<std::size_t>(-literal) + 1;
  }
  bool is_true(int literal) const { return values_[slot(literal)] > 0; }
  bool is_false(int literal) const { return values_[slot(literal)] < 0; }
  void make_room(const std::vector<int>& clause);
  void assign(int literal);
  bool propagate();
  bool visit(int falsified);
  bool find_watch(std::uint32_t clause, int falsified);
  void undo(std::size_t size);

  std::vector<int> literals_;  // of all clauses, each behind its length
  std::vector<std::vector<Watch>> watches_;  // by slot of a literal: when false
  std::vector<std::int8_t> values_;          // by slot
  std::vector<int> trail_;
  std::size_t propagated_ = 0;
  bool contradiction_ = false;  // without any assumption
};

}  // namespace rung::script
