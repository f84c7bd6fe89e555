#pragma once

#include <rapidcheck.h>

#include <string>
#include <vector>

#include "analysis/transition_system.h"

namespace rung::test {

/// Random terms over a few inputs; every operator occurs.
struct RandomTerms {
  TransitionSystem ts;
  std::vector<ExprId> bits;
  std::vector<ExprId> words;
  std::vector<VarId> inputs;

  ExprId a_bit() {
    return bits[*rc::gen::inRange<std::size_t>(0, bits.size())];
  }
  ExprId a_word() {
    return words[*rc::gen::inRange<std::size_t>(0, words.size())];
  }

  RandomTerms() {
    const auto word_input = [&](std::int64_t low, std::int64_t high) {
      inputs.push_back(ts.add_input("w" + std::to_string(inputs.size()),
                                    VarRole::Input, Type::Word, low, high));
      words.push_back(ts.of(inputs.back()));
    };
    for (int i = 0; i < 3; ++i) {
      inputs.push_back(ts.add_input("b" + std::to_string(i), VarRole::Input,
                                    Type::Bit, 0, 1));
      bits.push_back(ts.of(inputs.back()));
    }
    word_input(0, 1023);
    word_input(-7, 12);
    word_input(-40000, 40000);
    word_input(-9, -3);
    words.push_back(ts.exprs.word(*rc::gen::inRange(-300, 300)));
    const int steps = *rc::gen::inRange(1, 40);
    for (int i = 0; i < steps; ++i) add_one();
  }

  bool small(ExprId id) const {
    const Expr& e = ts.exprs[id];
    return e.low > -(std::int64_t{1} << 28) && e.high < std::int64_t{1} << 28;
  }

  void add_one() {
    ExprArena& e = ts.exprs;
    const ExprId a = a_word();
    const ExprId b = a_word();
    switch (*rc::gen::inRange(0, 12)) {
      case 0:
        bits.push_back(e.negation(a_bit()));
        break;
      case 1:
        bits.push_back(e.conjunction(a_bit(), a_bit()));
        break;
      case 2:
        bits.push_back(e.exclusive_or(a_bit(), a_bit()));
        break;
      case 3:
        bits.push_back(e.equal(a, b));
        break;
      case 4:
        bits.push_back(e.less(a, b));
        break;
      case 5:
        words.push_back(e.wrap16(a));
        break;
      case 6:
        words.push_back(e.ite(a_bit(), a, b));
        break;
      case 7:
        bits.push_back(e.ite(a_bit(), a_bit(), a_bit()));
        break;
      case 8: {
        const std::int64_t by = *rc::gen::inRange(-20, 20);
        words.push_back(e.divide(a, by == 0 ? 7 : by));
        break;
      }
      case 9:
        words.push_back(e.minimum(a, b));
        break;
      case 10:
        if (small(a) && small(b)) words.push_back(e.multiply(a, b));
        break;
      default:
        if (small(a) && small(b)) words.push_back(e.add(a, b));
        break;
    }
  }
};

}  // namespace rung::test
