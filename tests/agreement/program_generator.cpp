#include "program_generator.h"

#include <array>
#include <utility>

namespace rung {
namespace {

struct Operand {
  std::string text;
  bool word = false;
};

class Generator {
 public:
  Generator(Tape& tape, const GeneratorOptions& options)
      : tape_(tape), options_(options), sim_(tape.pick(2) == 0) {}

  GeneratedProgram generate() {
    if (options_.words) word_targets_ = tape_.pick(3);
    const std::uint32_t bit_rungs = 1 + tape_.pick(options_.max_rungs);
    // Word targets are always written, so that their type is known.
    for (std::uint32_t i = 0; i < word_targets_; ++i) word_rung(i);
    for (std::uint32_t i = 0; i < bit_rungs; ++i) bit_rung();
    for (std::uint32_t i = 0; i < word_targets_; ++i) {
      if (tape_.pick(3) == 1) word_rung(i);
    }
    if (sim_) initial_values();
    return {sim_ ? "sim" : "yun", std::move(text_)};
  }

 private:
  static std::string numbered(std::string_view prefix, std::uint32_t number) {
    return std::string(prefix) + std::to_string(number);
  }

  std::string bit_target() {
    const std::uint32_t choice = tape_.pick(6);
    if (choice < 3)
      return numbered(sim_ ? "Q" : "pin", choice + (sim_ ? 0 : 8));
    return numbered(sim_ ? "M" : "y", choice);
  }
  std::string word_target(std::uint32_t number) const {
    return numbered(sim_ ? "N" : "y", number + 10);
  }

  std::string bit_leaf() {
    const std::uint32_t choice = tape_.pick(10);
    if (choice < 6) {
      return numbered(sim_ ? "I" : "pin", tape_.pick(options_.inputs));
    }
    if (choice < 9) return bit_target();
    return tape_.pick(2) == 0 ? "false" : "true";
  }

  std::string word_leaf() {
    // The larger ones take words past 16 bits in a few scans.
    constexpr std::array<std::string_view, 8> kNumbers = {
        "0", "1", "2", "7", "100", "1023", "9000", "32767"};
    const std::uint32_t choice = tape_.pick(6);
    if (choice == 0) return std::to_string(tape_.pick(60));
    if (choice == 1) return std::string(kNumbers[tape_.pick(8)]);
    if (choice < 4 || word_targets_ == 0) {
      return numbered(sim_ ? "IW" : "A", tape_.pick(2));
    }
    return word_target(tape_.pick(word_targets_));
  }

  std::string seconds() {
    constexpr std::array<std::string_view, 8> kPresets = {
        "0", "0.01", "0.0155", "0.03", "0.1", "0.25", "1", "2.5"};
    return std::string(kPresets[tape_.pick(options_.long_presets ? 8 : 4)]);
  }

  Operand pop(bool word) {
    for (std::size_t i = stack_.size(); i-- > 0;) {
      if (stack_[i].word != word) continue;
      Operand operand = std::move(stack_[i]);
      stack_.erase(stack_.begin() + static_cast<std::ptrdiff_t>(i));
      return operand;
    }
    return {word ? word_leaf() : bit_leaf(), word};
  }

  void push(std::string text, bool word) {
    stack_.push_back({std::move(text), word});
  }

  void infix(std::string_view op, bool operands, bool result) {
    const Operand right = pop(operands);
    const Operand left = pop(operands);
    push("(" + left.text + " " + std::string(op) + " " + right.text + ")",
         result);
  }

  void compare() {
    constexpr std::array<std::string_view, 6> kOperators = {
        "<", ">", "==", "!=", "<=", ">="};
    infix(kOperators[tape_.pick(6)], true, false);
  }

  void arithmetic() {
    switch (tape_.pick(6)) {
      case 0:
      case 1:
        return infix("+", true, true);
      case 2:
        return infix("-", true, true);
      case 3:
        return push("(-" + pop(true).text + ")", true);
      case 4:
        return push("(" + pop(true).text + " * " +
                        std::to_string(2 + tape_.pick(5)) + ")",
                    true);
      default:
        break;
    }
    // The quotients of sim are fractions: only comparisons take those.
    const std::string quotient =
        "(" + pop(true).text + " / " + std::to_string(2 + tape_.pick(4)) + ")";
    if (!sim_) return push(quotient, true);
    push("(" + quotient + " < " + word_leaf() + ")", false);
  }

  void timer() {
    const std::string index = std::to_string(tape_.pick(2));
    const std::string input = pop(false).text;
    if (sim_) {
      const char* const name = tape_.pick(2) == 0 ? "T(" : "TOF(";
      return push(name + index + ", " + seconds() + ", " + input + ")", false);
    }
    if (tape_.pick(3) == 2) {
      return push("TR(" + index + ", " + input + ")", false);
    }
    push("T(" + index + ", " + seconds() + ", " + input + ")", false);
  }

  void counter() {
    const std::string index = std::to_string(tape_.pick(2));
    const std::string count = std::to_string(tape_.pick(4));
    const std::string input = pop(false).text;
    if (sim_) {
      const std::string down = tape_.pick(2) == 0 ? "false" : pop(false).text;
      const std::string reset = tape_.pick(2) == 0 ? "false" : pop(false).text;
      return push("C(" + index + ", " + count + ", " + input + ", " + down +
                      ", " + reset + ")",
                  false);
    }
    switch (tape_.pick(4)) {
      case 2:
        return push("CR(" + index + ", " + input + ")", false);
      case 3:
        return push("Cnt(" + index + ", " + count + ", " + input + ")", false);
      default:
        return push("C(" + index + ", " + count + ", " + input + ")", false);
    }
  }

  void function() {
    if (sim_) return timer();
    if (options_.words && tape_.pick(2) == 0) {
      constexpr std::array<std::string_view, 4> kOperators = {"<", ">", "=",
                                                              "#"};
      const std::string op(kOperators[tape_.pick(4)]);
      const std::string right = pop(true).text;
      return push("Cmp(" + pop(true).text + ", \"" + op + "\", " + right + ")",
                  false);
    }
    const std::string c = pop(false).text;
    const std::string b = pop(false).text;
    push("ORN(" + pop(false).text + ", " + b + ", " + c + ")", false);
  }

  void step() {
    switch (tape_.pick(12)) {
      case 0:
        return push(bit_leaf(), false);
      case 1:
      case 2:
        return infix("&&", false, false);
      case 3:
      case 4:
        return infix("||", false, false);
      case 5:
        return push("!" + pop(false).text, false);
      case 6:
        return infix(tape_.pick(2) == 0 ? "==" : "!=", false, false);
      case 7:
      case 8:
        return timer();
      case 9:
        return counter();
      case 10:
        return function();
      default:
        break;
    }
    if (!options_.words) return timer();
    if (tape_.pick(2) == 0) return compare();
    arithmetic();
  }

  std::string expression(bool word) {
    stack_.clear();
    const std::uint32_t steps = tape_.pick(7);
    for (std::uint32_t i = 0; i < steps; ++i) step();
    Operand result = pop(word);
    while (true) {
      bool more = false;
      for (const Operand& operand : stack_) more = more || operand.word == word;
      if (!more) return result.text;
      const std::string_view op =
          word ? " + " : (tape_.pick(2) == 0 ? " && " : " || ");
      result.text = "(" + pop(word).text + std::string(op) + result.text + ")";
    }
  }

  void bit_rung() {
    const std::string target = bit_target();
    text_ += target + " = " + expression(false) + ";\n";
  }
  void word_rung(std::uint32_t number) {
    // The sum makes it a word; the guard keeps it from running away.
    const std::string target = word_target(number);
    text_ += target + " = " + expression(true) + " + " +
             std::to_string(tape_.pick(3)) + ";\n";
  }

  void initial_values() {
    if (tape_.pick(3) != 1) return;
    text_ += "//Var\n";
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (tape_.pick(2) == 0) text_ += numbered("M", i + 3) + " = true;\n";
    }
  }

  Tape& tape_;
  GeneratorOptions options_;
  bool sim_;
  std::uint32_t word_targets_ = 0;
  std::vector<Operand> stack_;
  std::string text_;
};

}  // namespace

std::vector<std::uint32_t> random_tape(std::uint64_t seed, std::size_t count) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(count);
  std::uint64_t state = seed;
  for (std::size_t i = 0; i < count; ++i) {
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    numbers.push_back(static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32));
  }
  return numbers;
}

GeneratedProgram generate_program(Tape& tape, const GeneratorOptions& options) {
  return Generator(tape, options).generate();
}

}  // namespace rung
