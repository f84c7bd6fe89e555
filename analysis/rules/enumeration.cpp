#include "analysis/rules/enumeration.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rung {
namespace {

using Bits = std::uint64_t;  // one combination a bit

/// Leaf i of the first six in 64 combinations.
constexpr std::array<Bits, 6> kPatterns = {
    0xaaaa'aaaa'aaaa'aaaa, 0xcccc'cccc'cccc'cccc, 0xf0f0'f0f0'f0f0'f0f0,
    0xff00'ff00'ff00'ff00, 0xffff'0000'ffff'0000, 0xffff'ffff'0000'0000};

class Enumeration {
 public:
  explicit Enumeration(const TransitionSystem& ts)
      : exprs_(ts.exprs),
        exact_words_(ts.faults.empty()),
        value_(ts.exprs.size()) {}

  bool always(ExprId condition) {
    return cut(condition) && holds_everywhere(condition);
  }

 private:
  static constexpr std::size_t kMostTerms = 96;  // above the leaves

  static bool is_gate(const Expr& term) {
    return term.op == ExprOp::Not || term.op == ExprOp::And ||
           term.op == ExprOp::Xor || term.op == ExprOp::Ite;
  }

  /// Keeps `frontier_` sorted; the terms in it cover all of the condition.
  void cover(ExprId id) {
    const auto at = std::lower_bound(frontier_.begin(), frontier_.end(), id);
    if (at == frontier_.end() || *at != id) frontier_.insert(at, id);
  }

  /// Opens terms from the condition downwards, those with the largest ids
  /// first: all that uses a term is open before it.
  bool cut(ExprId condition) {
    frontier_.assign(1, condition);
    gates_.clear();
    leaves_.clear();
    while (!frontier_.empty()) {
      const ExprId id = frontier_.back();
      frontier_.pop_back();
      const Expr& term = exprs_[id];
      const bool full = leaves_.size() + frontier_.size() + 3 > kMostLeaves ||
                        gates_.size() == kMostTerms;
      if (is_gate(term) && !full) {
        gates_.push_back(id);
        cover(term.a);
        if (term.b.has_value()) cover(term.b);
        if (term.c.has_value()) cover(term.c);
      } else if (term.op == ExprOp::Constant) {
        value_[id.index()] = term.value != 0 ? ~Bits{0} : 0;
      } else {
        // A value outside its range makes the encoding inexact from then on;
        // bits of gates are not concerned.
        const bool compares =
            term.op == ExprOp::Less || term.op == ExprOp::Equal;
        if (compares && !exact_words_) return false;
        leaves_.push_back(id);
      }
    }
    return leaves_.size() <= kMostLeaves;
  }

  bool holds_everywhere(ExprId condition) {
    const std::size_t low = std::min(leaves_.size(), kPatterns.size());
    for (std::size_t i = 0; i < low; ++i) {
      value_[leaves_[i].index()] = kPatterns[i];
    }
    const std::uint32_t rounds = 1U << (leaves_.size() - low);
    for (std::uint32_t round = 0; round < rounds; ++round) {
      for (std::size_t i = low; i < leaves_.size(); ++i) {
        const bool set = (round >> (i - low) & 1U) != 0;
        value_[leaves_[i].index()] = set ? ~Bits{0} : 0;
      }
      for (std::size_t i = gates_.size(); i-- > 0;) compute(gates_[i]);
      if (value_[condition.index()] != ~Bits{0}) return false;
    }
    return true;
  }

  Bits value(ExprId id) const { return value_[id.index()]; }

  void compute(ExprId id) {
    const Expr& term = exprs_[id];
    Bits& out = value_[id.index()];
    if (term.op == ExprOp::Not) {
      out = ~value(term.a);
    } else if (term.op == ExprOp::And) {
      out = value(term.a) & value(term.b);
    } else if (term.op == ExprOp::Xor) {
      out = value(term.a) ^ value(term.b);
    } else {
      out = (value(term.a) & value(term.b)) | (~value(term.a) & value(term.c));
    }
  }

  const ExprArena& exprs_;
  const bool exact_words_;
  std::vector<Bits> value_;  // by term
  std::vector<ExprId> frontier_;
  std::vector<ExprId> gates_;  // opened, each before its operands
  std::vector<ExprId> leaves_;
};

}  // namespace

std::vector<bool> enumerate(const TransitionSystem& ts,
                            const std::vector<ExprId>& conditions) {
  Enumeration enumeration(ts);
  std::vector<bool> known(conditions.size());
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    known[i] = enumeration.always(conditions[i]);
  }
  return known;
}

}  // namespace rung
