#pragma once

#include <cstdint>
#include <vector>

#include "smt/script/gates.h"

namespace rung::script {

/// An integer in two's complement, lowest bit first, as wide as `low` to `high`
/// need. Its value lies in between in every model.
struct Number {
  std::vector<int> bits;
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// Arithmetic without overflow: every result is wide enough. Written for
/// certificates alone; the engines' own encoding is another one.
class Numbers {
 public:
  explicit Numbers(Gates& gates) : gates_(&gates) {}

  static Number constant(std::int64_t value);
  Number fresh(std::int64_t low, std::int64_t high);
  Number add(const Number& a, const Number& b);
  Number negate(const Number& a);
  Number multiply(const Number& x, const Number& y);
  /// Quotient and remainder of SMT-LIB. Precondition: `by` is not 0.
  struct Quotient {
    Number quotient;
    Number remainder;
  };
  Quotient divide(const Number& a, std::int64_t by);
  Number choose(int condition, const Number& yes, const Number& no);
  int less(const Number& a, const Number& b);
  int equal(const Number& a, const Number& b);

  /// Some number got wider than 62 bits; results are void.
  bool overflow() const { return overflow_; }

 private:
  Number within(Number number, std::int64_t low, std::int64_t high);
  Number sum(const Number& a, const Number& b, int carry);

  Gates* gates_;
  bool overflow_ = false;
};

}  // namespace rung::script
