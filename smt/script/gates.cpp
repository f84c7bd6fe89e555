#include "smt/script/gates.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace rung::script {

std::size_t Gates::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  for (const int literal : {key.a, key.b, key.c}) {
    hash = (hash ^ static_cast<std::uint32_t>(literal)) * 0x9e37'79b9'7f4a'7c15;
    hash ^= hash >> 29U;
  }
  return hash;
}

Gates::Gates() { require({fresh()}); }

void Gates::require(const std::vector<int>& clause) {
  clauses_.insert(clauses_.end(), clause.begin(), clause.end());
  clauses_.push_back(0);
}

void Gates::clause(int a, int b) { clauses_.insert(clauses_.end(), {a, b, 0}); }

void Gates::clause(int a, int b, int c) {
  clauses_.insert(clauses_.end(), {a, b, c, 0});
}

int Gates::conjunction(int a, int b) {
  if (a > b) std::swap(a, b);
  if (a == -b || a == -kTrue || b == -kTrue) return -kTrue;
  if (a == b || b == kTrue) return a;
  if (a == kTrue) return b;
  const auto [known, made] = conjunctions_.try_emplace({a, b, 0});
  if (!made) return known->second;
  const int gate = fresh();
  known->second = gate;
  clause(-gate, a);
  clause(-gate, b);
  clause(gate, -a, -b);
  return gate;
}

int Gates::exclusive(int a, int b) {
  if (std::abs(a) > std::abs(b)) std::swap(a, b);
  const bool negated = (a < 0) != (b < 0);
  a = std::abs(a);
  b = std::abs(b);
  if (a == b) return constant(negated);
  if (a == kTrue) return negated ? b : -b;
  const auto [known, made] = exclusives_.try_emplace({a, b, 0});
  if (made) {
    const int gate = fresh();
    known->second = gate;
    clause(-gate, a, b);
    clause(-gate, -a, -b);
    clause(gate, -a, b);
    clause(gate, a, -b);
  }
  return negated ? -known->second : known->second;
}

int Gates::choice(int condition, int yes, int no) {
  if (condition < 0) {
    condition = -condition;
    std::swap(yes, no);
  }
  if (condition == kTrue || yes == no) return yes;
  if (yes == -no) return -exclusive(condition, yes);
  if (yes == kTrue || yes == condition) return disjunction(condition, no);
  if (yes == -kTrue || yes == -condition) return conjunction(-condition, no);
  if (no == kTrue || no == -condition) return disjunction(-condition, yes);
  if (no == -kTrue || no == condition) return conjunction(condition, yes);
  const auto [known, made] = choices_.try_emplace({condition, yes, no});
  if (!made) return known->second;
  const int gate = fresh();
  known->second = gate;
  clause(-condition, -yes, gate);
  clause(-condition, yes, -gate);
  clause(condition, -no, gate);
  clause(condition, no, -gate);
  // Not needed, but what they say is seen without a decision.
  clause(-yes, -no, gate);
  clause(yes, no, -gate);
  return gate;
}

int Gates::majority(int a, int b, int c) {
  std::array<int, 3> of = {a, b, c};
  std::sort(of.begin(), of.end());
  for (int i = 0; i < 3; ++i) {
    const auto [x, y, z] = of;
    if (x == y) return x;
    if (x == -y) return z;
    if (z == kTrue) return disjunction(x, y);
    if (z == -kTrue) return conjunction(x, y);
    std::rotate(of.begin(), of.begin() + 1, of.end());
  }
  std::tie(a, b, c) = std::tie(of[0], of[1], of[2]);
  const auto [known, made] = majorities_.try_emplace({a, b, c});
  if (!made) return known->second;
  const int gate = fresh();
  known->second = gate;
  for (const auto& [x, y] : {std::pair{a, b}, {a, c}, {b, c}}) {
    clause(-x, -y, gate);
    clause(x, y, -gate);
  }
  return gate;
}

}  // namespace rung::script
