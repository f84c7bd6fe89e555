#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace rung::script {

/// Gates as clauses. Literals are non-zero integers, negation is the sign.
/// Gates of the same operands are made once; constants are folded.
class Gates {
 public:
  Gates();

  static constexpr int kTrue = 1;  // the first clause says so
  static int constant(bool value) { return value ? kTrue : -kTrue; }

  int fresh() { return ++variables_; }
  int conjunction(int a, int b);
  int disjunction(int a, int b) { return -conjunction(-a, -b); }
  int exclusive(int a, int b);
  int choice(int condition, int yes, int no);
  int majority(int a, int b, int c);
  void require(const std::vector<int>& clause);

  /// One after the other, each with a 0 behind it.
  const std::vector<int>& clauses() const { return clauses_; }
  int variables() const { return variables_; }

 private:
  struct Key {
    int a;
    int b;
    int c;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  using Known = std::unordered_map<Key, int, Hash>;

  void clause(int a, int b, int c);
  void clause(int a, int b);

  std::vector<int> clauses_;
  int variables_ = 0;
  Known conjunctions_;
  Known exclusives_;
  Known choices_;
  Known majorities_;
};

}  // namespace rung::script
