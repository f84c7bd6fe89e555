#pragma once

#include <initializer_list>
#include <random>
#include <string>
#include <utility>

namespace rung::testing {

/// A script of the sim dialect over few names, so that states are few.
class RandomScript {
 public:
  /// `delay`: seconds of its timers.
  explicit RandomScript(unsigned seed, std::string delay = "0.2")
      : random_(seed), delay_(std::move(delay)) {}

  std::string text() {
    const int rungs = 2 + pick(5);
    std::string script;
    for (int i = 0; i < rungs; ++i) {
      script +=
          name({"Q0", "Q1", "M0", "M1", "M2"}) + " = " + expression(3) + ";\n";
    }
    return script;
  }

 private:
  int pick(int below) {
    return static_cast<int>(random_() % static_cast<unsigned>(below));
  }

  std::string name(std::initializer_list<const char*> names) {
    return *(names.begin() + pick(static_cast<int>(names.size())));
  }

  std::string contact() {
    return (pick(3) == 0 ? "!" : "") +
           name({"I0", "I1", "Q0", "Q1", "M0", "M1", "M2"});
  }

  // NOLINTNEXTLINE(misc-no-recursion): as deep as its argument
  std::string expression(int depth) {
    if (depth == 0 || pick(4) == 0) return contact();
    switch (pick(9)) {
      case 0:
        return "T(0, " + delay_ + ", " + expression(depth - 1) + ")";
      case 1:
        return "TOF(0, 0.3, " + expression(depth - 1) + ")";
      case 2:
        return "C(0, 2, " + contact() + ", false, " + contact() + ")";
      case 3:
        return "!(" + expression(depth - 1) + ")";
      case 4:
      case 5:
        return "(" + expression(depth - 1) + " || " + expression(depth - 1) +
               ")";
      default:
        return "(" + expression(depth - 1) + " && " + expression(depth - 1) +
               ")";
    }
  }

  std::mt19937 random_;
  std::string delay_;
};

}  // namespace rung::testing
