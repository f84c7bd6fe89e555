// The second way to check a certificate: its text is read, encoded in bits
// anew, and refutations are followed step by step.

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "smt/script/decide.h"
#include "smt/script/encode.h"
#include "smt/script/refute.h"
#include "smt/script/syntax.h"
#include "smt/script/unit_propagation.h"

namespace rung::script {
namespace {

/// A script that claims `claim` wherever `hypothesis` holds.
CertificateScript claiming(const std::string& text, const std::string& claim) {
  CertificateScript script;
  script.text = "(set-logic QF_LIA)\n(declare-const hypothesis Bool)\n" + text +
                "(declare-const claim@0 Bool)\n(assert (= claim@0 " + claim +
                "))\n";
  script.claims.push_back({ScriptClaim::Kind::Condition, 0, "claim"});
  script.queries.push_back({ScriptQuery::Part::Safety, 0, 0, "claim@0"});
  return script;
}

// --- the text ----------------------------------------------------------------

TEST(ScriptSyntax, WhatCertificatesAreWrittenInIsRead) {
  const Script script = read_script(
      "; a comment (with\n(set-logic QF_LIA)\n(declare-const a Bool)\n"
      "(declare-const n Int)\n(assert (=> a (<= (- 3) n 5)))\n");
  ASSERT_EQ(script.error, "");
  EXPECT_EQ(script.symbols.size(), 2U);
  EXPECT_TRUE(script.symbols[1].is_int);
  ASSERT_EQ(script.assertions.size(), 1U);
  EXPECT_EQ(script.nodes[script.assertions[0].root].op, Op::Implies);
}

TEST(ScriptSyntax, AnythingElseIsRefused) {
  for (const char* text : {
           "(",
           ")",
           "a",
           "(check-sat)",
           "(assert",
           "(assert (and",
           "(assert true",
           "(assert true false)",
           "(assert ())",
           "(assert (not))",
           "(assert unknown)",
           "(assert (let ((x true)) x))",
           "(assert (forall ((x Int)) true))",
           "(assert (= 99999999999999999999 1))",
           "(assert (= -5 1))",
           "(assert (= 1.5 1))",
           "(assert \"text\")",
           "(declare-const a Real)",
           "(declare-const a Bool) (declare-const a Bool)",
           "(declare-fun f (Int) Int)",
           "(define-fun f () Bool true)",
           "(set-logic QF_LIA",
           "(assert true))",
       }) {
    EXPECT_NE(read_script(text).error, "") << text;
  }
}

TEST(ScriptSyntax, DepthIsNoDanger) {
  std::string text = "(assert ";
  for (int i = 0; i < 300'000; ++i) text += "(not ";
  EXPECT_NE(read_script(text).error, "");
  text += "true" + std::string(300'000, ')') + ")";
  const Script script = read_script(text);
  EXPECT_EQ(script.error, "");
  EXPECT_EQ(encode(script).error, "");
}

TEST(ScriptEncoding, SortsAndBoundsAreChecked) {
  const std::string names =
      "(declare-const a Bool)(declare-const b Bool)(declare-const n Int)"
      "(declare-const r Bool)(assert (<= 0 n 9))";
  EXPECT_EQ(encode(read_script(names + "(assert (= a (< n 3)))")).error, "");
  for (const char* wrong : {
           "(assert n)",
           "(assert (and a n))",
           "(assert (= a n))",
           "(assert (+ n 1))",
           "(assert (< a b))",
           "(assert (ite n a b))",
           "(assert (ite a n b))",
           "(assert (not a b))",
           "(assert (=> a b a))",
           "(assert (= a b a))",
           "(assert (= 1 (div n n)))",
           "(assert (= 1 (mod n 0)))",
           "(declare-const free Int)(assert (< free 3))",
           "(declare-const free Int)(assert (= r (<= 0 free 3)))"
           "(assert (=> b r))",
           "(assert (< (* n 4611686018427387904) 3))",
       }) {
    EXPECT_NE(encode(read_script(names + wrong)).error, "") << wrong;
  }
}

// --- what operators mean -----------------------------------------------------

struct Term {
  std::string text;
  bool known = true;  // no division by zero
  std::int64_t value = 0;
};

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  std::int64_t q = a / b;
  // SMT-LIB: the remainder is never negative.
  if (a - q * b < 0) q += b > 0 ? -1 : 1;
  return q;
}

class RandomTerms {
 public:
  explicit RandomTerms(unsigned seed) : random_(seed) {}

  int below(int n) {
    return static_cast<int>(random_() % static_cast<unsigned>(n));
  }

  Term number(std::int64_t value) {
    return {value < 0 ? "(- " + std::to_string(-value) + ")"
                      : std::to_string(value),
            true, value};
  }

  Term make(int depth) {
    if (depth == 0 || below(6) == 0) return leaf();
    const Term a = make(depth - 1);
    const Term b = make(depth - 1);
    const auto call = [&](const std::string& op, std::int64_t value) {
      return Term{"(" + op + " " + a.text + " " + b.text + ")", true, value};
    };
    switch (below(9)) {
      case 0:
        return call("+", a.value + b.value);
      case 1:
        return call("-", a.value - b.value);
      case 2:
        return {"(- " + a.text + ")", true, -a.value};
      case 3:
        return call("*", a.value * b.value);
      case 4:
      case 5: {
        static constexpr std::int64_t kBy[] = {1, 2, 4, 64, 3, 10, -1, -2, -7};
        const std::int64_t by = kBy[below(9)];
        const std::int64_t q = floor_div(a.value, by);
        const bool mod = below(2) == 0;
        return {
            (mod ? "(mod " : "(div ") + a.text + " " + number(by).text + ")",
            true, mod ? a.value - q * by : q};
      }
      case 6:
      case 7:
        return cut(a, b);
      default: {
        const bool less = below(2) == 0;
        const bool holds = less ? a.value < b.value : a.value == b.value;
        return {std::string("(ite (") + (less ? "<" : "=") + " " + a.text +
                    " " + b.text + ") " + a.text + " (- " + b.text + "))",
                true, holds ? a.value : -b.value};
      }
    }
  }

  /// A number that is looked at where a comparison with a constant holds, or
  /// does not: `(ite (<= a 7) a b)`.
  Term cut(const Term& a, const Term& b) {
    const Term at = number(below(41) - 20);
    const std::int64_t which = below(4);
    static constexpr const char* kOps[] = {"<", "<=", ">", ">="};
    const bool turned = below(2) == 0;  // the constant stands first
    const std::int64_t left = turned ? at.value : a.value;
    const std::int64_t right = turned ? a.value : at.value;
    const bool holds = which == 0   ? left < right
                       : which == 1 ? left <= right
                       : which == 2 ? left > right
                                    : left >= right;
    const bool first = below(2) == 0;  // `a` where it holds
    const Term& yes = first ? a : b;
    const Term& no = first ? b : a;
    return {std::string("(ite (") + kOps[which] + " " +
                (turned ? at.text + " " + a.text : a.text + " " + at.text) +
                ") " + yes.text + " " + no.text + ")",
            true, holds ? yes.value : no.value};
  }

  std::int64_t x = 0;
  std::int64_t y = 0;

 private:
  Term leaf() {
    switch (below(3)) {
      case 0:
        return {"x", true, x};
      case 1:
        return {"y", true, y};
      default:
        return number(below(41) - 20);
    }
  }

  std::mt19937 random_;
};

TEST(ScriptEncoding, ArithmeticIsThatOfSmtLib) {
  int decided = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    RandomTerms terms(seed);
    terms.x = terms.below(27) - 13;
    terms.y = terms.below(9) - 2;
    const Term term = terms.make(3);
    const std::string text =
        "(declare-const x Int)(assert (<= (- 13) x 13))"
        "(declare-const y Int)(assert (<= (- 2) y 6))"
        "(assert (=> hypothesis (= x " +
        terms.number(terms.x).text +
        ")))"
        "(assert (=> hypothesis (= y " +
        terms.number(terms.y).text + ")))\n";
    const auto says = [&](std::int64_t value) {
      return decide(claiming(
          text, "(= " + terms.number(value).text + " " + term.text + ")"));
    };
    const Decision right = says(term.value);
    if (right == Decision::Unknown) continue;
    ++decided;
    EXPECT_EQ(right, Decision::Accepted) << term.text;
    for (const std::int64_t wrong : {term.value + 1, term.value - 1}) {
      EXPECT_EQ(says(wrong), Decision::Doubtful) << term.text;
    }
  }
  EXPECT_GT(decided, 1900);
}

// What a clock's range needs: no solver has to search for it.
TEST(ScriptEncoding, ACutNumberLiesBelowItsCut) {
  const std::string text =
      "(declare-const x Int)(assert (<= 0 x 20000))"
      "(assert (=> hypothesis (<= 1 x)))\n";
  const auto says = [&](const std::string& claim) {
    return decide(claiming(text, claim));
  };
  EXPECT_EQ(says("(<= 0 (ite (< x 900) x 900) 900)"), Decision::Accepted);
  EXPECT_EQ(says("(<= 0 (ite (>= x 900) 900 x) 900)"), Decision::Accepted);
  EXPECT_EQ(says("(<= 0 (ite (< x 900) x 900) 899)"), Decision::Doubtful);
  EXPECT_EQ(says("(<= 0 (ite (<= x 900) x 899) 899)"), Decision::Doubtful);
  EXPECT_EQ(says("(<= 0 (ite (< 900 x) x 900) 900)"), Decision::Doubtful);
  EXPECT_EQ(says("(<= 0 (ite (not (< x 900)) x 900) 900)"), Decision::Doubtful);
  // Each bound, and the number beside it.
  const struct {
    const char* term;
    int bound;
    bool above;
  } kBounds[] = {
      {"(ite (< x 900) x 5)", 899, true},
      {"(ite (<= x 900) x 5)", 900, true},
      {"(ite (> 900 x) x 5)", 899, true},
      {"(ite (>= x 900) 5 x)", 899, true},
      {"(ite (< 900 x) 5 x)", 900, true},
      {"(ite (< x 900) 5000 x)", 900, false},
      {"(ite (<= x 900) 5000 x)", 901, false},
      {"(ite (> x 900) x 5000)", 901, false},
      {"(ite (<= 900 x) x 5000)", 900, false},
      {"(ite (>= 900 x) 5000 x)", 901, false},
  };
  for (const auto& [term, bound, above] : kBounds) {
    const auto claim = [&, t = term, up = above](int limit) {
      const std::string number = std::to_string(limit);
      return says(up ? std::string("(<= 0 ") + t + " " + number + ")"
                     : "(<= " + number + " " + t + " 20000)");
    };
    EXPECT_EQ(claim(bound), Decision::Accepted) << term;
    EXPECT_EQ(claim(above ? bound - 1 : bound + 1), Decision::Doubtful) << term;
  }
}

TEST(ScriptEncoding, ComparisonsAreChains) {
  const std::string text =
      "(declare-const x Int)(assert (<= (- 3) x 12))"
      "(declare-const y Int)(assert (<= 0 y 5))\n";
  const std::pair<const char*, Decision> cases[] = {
      {"(=> (< x y 3) (and (< x y) (< y 3)))", Decision::Accepted},
      {"(=> (and (< x y) (< y 3)) (< x y 3))", Decision::Accepted},
      {"(=> (>= x y 3) (>= x 3))", Decision::Accepted},
      {"(=> (> x y 3) (> x 4))", Decision::Accepted},
      {"(=> (> x y 3) (> x 5))", Decision::Doubtful},
      {"(<= (- 3) x 12)", Decision::Accepted},
      {"(<= (- 2) x 12)", Decision::Doubtful},
      {"(<= (- 3) x 11)", Decision::Doubtful},
      {"(xor (< x y) (>= x y))", Decision::Accepted},
      {"(or (< x y) (= x y) (> x y))", Decision::Accepted},
      {"(or (< x y) (> x y))", Decision::Doubtful},
      {"(= (ite (< x y) x y) (ite (< y x) y x))", Decision::Accepted},
  };
  for (const auto& [claim, expected] : cases) {
    EXPECT_EQ(decide(claiming(text, claim)), expected) << claim;
  }
}

TEST(ScriptEncoding, ARangeThatIsNotAssumedBoundsNothing) {
  // Without `initial` or `hypothesis` a state may lie anywhere.
  const std::string text =
      "(declare-const initial Bool)(declare-const x Int)"
      "(declare-const r Bool)(assert (= r (<= 0 x 5)))"
      "(assert (=> hypothesis r))(assert (=> initial (= x 2)))\n";
  CertificateScript script = claiming(text, "(<= 0 x 5)");
  EXPECT_EQ(decide(script), Decision::Accepted);
  // And the hull of both is what it lies in, not the range alone.
  CertificateScript outside = claiming(
      "(declare-const initial Bool)(declare-const x Int)"
      "(declare-const r Bool)(assert (= r (<= 0 x 5)))"
      "(assert (=> hypothesis r))(assert (=> initial (= x 9)))\n",
      "(<= 0 x 5)");
  EXPECT_EQ(decide(outside), Decision::Accepted);
  outside.queries[0].part = ScriptQuery::Part::Initiation;
  EXPECT_EQ(decide(outside), Decision::Doubtful);
}

// --- proofs ------------------------------------------------------------------

using Clause = std::vector<int>;

bool holds(const Clause& clause, unsigned model) {
  for (const int literal : clause) {
    const bool value = (model >> (std::abs(literal) - 1) & 1U) != 0;
    if (value == (literal > 0)) return true;
  }
  return false;
}

Clause random_clause(std::mt19937& random, int variables) {
  Clause clause;
  const auto size = 1 + random() % 3;
  for (std::size_t i = 0; i < size; ++i) {
    const int variable =
        1 + static_cast<int>(random() % static_cast<unsigned>(variables));
    clause.push_back(random() % 2 == 0 ? variable : -variable);
  }
  return clause;
}

TEST(UnitPropagation, DerivesOnlyWhatFollows) {
  constexpr int kVariables = 8;
  int derived = 0;
  int refused = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    std::vector<Clause> formula;
    UnitPropagation checker;
    const auto clauses = random() % 24;
    for (std::size_t i = 0; i < clauses; ++i) {
      formula.push_back(random_clause(random, kVariables));
      checker.add(formula.back());
    }
    const auto follows = [&](const Clause& clause) {
      for (unsigned model = 0; model < 1U << kVariables; ++model) {
        bool all = !holds(clause, model);
        for (const Clause& given : formula) all = all && holds(given, model);
        if (all) return false;
      }
      return true;
    };
    for (int i = 0; i < 12; ++i) {
      const Clause clause = random_clause(random, kVariables);
      if (checker.derive(clause)) {
        ++derived;
        ASSERT_TRUE(follows(clause)) << "seed " << seed;
      } else {
        ++refused;
      }
    }
  }
  EXPECT_GT(derived, 2000);
  EXPECT_GT(refused, 2000);
}

TEST(UnitPropagation, AChainIsSeenAndARiddleIsNot) {
  UnitPropagation checker;
  for (int i = 1; i < 100; ++i) checker.add({-i, i + 1});
  EXPECT_TRUE(checker.implies({-1, 100}));
  EXPECT_FALSE(checker.implies({1, -100}));
  EXPECT_FALSE(checker.implies({100}));
  // Implied, but only by cases.
  checker.add({201, 202});
  checker.add({-201, 202});
  EXPECT_TRUE(checker.implies({202}));
  checker.add({301, 302, 303});
  checker.add({301, 302, -303});
  checker.add({301, -302, 303});
  checker.add({301, -302, -303});
  EXPECT_FALSE(checker.implies({301}));
  EXPECT_TRUE(checker.derive({301, 302}));
  EXPECT_TRUE(checker.derive({301}));
}

TEST(Refuter, AnswersAreRight) {
  constexpr int kVariables = 8;
  std::map<Refuter::Answer, int> count;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    std::mt19937 random(seed);
    std::vector<Clause> formula;
    std::vector<int> flat;
    for (int i = 0; i < 12; ++i) {
      formula.push_back(random_clause(random, kVariables));
      flat.insert(flat.end(), formula.back().begin(), formula.back().end());
      flat.push_back(0);
    }
    const Clause assumed = {1, -2};
    Refuter refuter(flat, kVariables, assumed);
    for (int i = 0; i < 4; ++i) {
      const Clause claims = random_clause(random, kVariables);
      bool broken = false;
      for (unsigned model = 0; model < 1U << kVariables; ++model) {
        bool all = (model & 3U) == 1;
        for (const Clause& given : formula) all = all && holds(given, model);
        for (const int claim : claims) {
          broken = broken || (all && !holds({claim}, model));
        }
      }
      const Refuter::Answer answer = refuter.refute(claims, 1000);
      ++count[answer];
      EXPECT_EQ(answer,
                broken ? Refuter::Answer::Model : Refuter::Answer::Refuted)
          << "seed " << seed;
    }
  }
  EXPECT_GT(count[Refuter::Answer::Model], 200);
  EXPECT_GT(count[Refuter::Answer::Refuted], 200);
}

TEST(Refuter, EffortIsLimited) {
  // Seven pigeons, six holes.
  std::vector<int> clauses;
  const auto in = [](int pigeon, int hole) { return 1 + pigeon * 6 + hole; };
  for (int pigeon = 0; pigeon < 7; ++pigeon) {
    for (int hole = 0; hole < 6; ++hole) clauses.push_back(in(pigeon, hole));
    clauses.push_back(0);
    for (int other = 0; other < pigeon; ++other) {
      for (int hole = 0; hole < 6; ++hole) {
        clauses.insert(clauses.end(), {-in(pigeon, hole), -in(other, hole), 0});
      }
    }
  }
  Refuter impatient(clauses, 42, {});
  EXPECT_EQ(impatient.refute({1, 2}, 5), Refuter::Answer::Unknown);
  Refuter patient(clauses, 42, {});
  EXPECT_EQ(patient.refute({1, 2}, 100'000), Refuter::Answer::Refuted);
  EXPECT_GT(patient.steps(), 5);
}

}  // namespace
}  // namespace rung::script
