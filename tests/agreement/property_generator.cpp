#include "property_generator.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace rung {
namespace {

class PropertyGenerator {
 public:
  PropertyGenerator(const Program& program, Tape& tape, PropertyTimes times)
      : program_(program), tape_(tape), times_(times) {
    for (const Cell& cell : program.cells) {
      (cell.type == Type::Bit ? bits_ : words_).push_back(cell.name);
      const bool input = cell.role == CellRole::Input;
      if (input && cell.type == Type::Bit) inputs_.push_back(cell.name);
    }
  }

  std::string property() {
    switch (tape_.pick(10)) {
      case 0:
        return "never " + expression();
      case 1:
        return "always " + expression();
      case 2:
        return "always " + expression() + " -> " + expression();
      case 3:
        return "reach " + expression();
      case 4:
        return "interlock " + expression() + ", " + expression() +
               (tape_.pick(2) == 0 ? "" : ", " + expression()) +
               (tape_.pick(2) == 0 ? "" : " gap " + milliseconds());
      case 5:
        return "latch " + any(bits_) + " set " + expression() + " reset " +
               expression() + (tape_.pick(3) == 2 ? " dominant set" : "");
      case 6:
        return response();
      case 7:
        return expression() + " for " + milliseconds() + " implies " +
               expression();
      case 8:
        return recoverable();
      default:
        return expression() + " only after " + expression();
    }
  }

  std::string response() {
    const std::string cause = "after " + expression();
    const std::string answer = expression();
    const std::string time = tape_.pick(2) == 0
                                 ? std::to_string(tape_.pick(5)) + " scans"
                                 : milliseconds();
    return tape_.pick(2) == 0 ? cause + ", " + answer + " within " + time
                              : cause + ", no " + answer + " for " + time;
  }

  std::string question() {
    const std::string cause = expression();
    return "(" + cause + ") -> (" + expression() + ")";
  }

  std::string recoverable() { return "recoverable " + expression(); }

  std::string assumption() {
    if (inputs_.empty()) return {};
    const std::string a = any(inputs_);
    const std::string b = any(inputs_);
    return tape_.pick(2) == 0 ? "!(" + a + " && " + b + ")"
                              : "(" + a + " || !" + b + ")";
  }

 private:
  const std::string& any(const std::vector<std::string>& names) {
    return names[tape_.pick(static_cast<std::uint32_t>(names.size()))];
  }

  std::string milliseconds() {
    constexpr std::array<std::string_view, 6> kTimes = {"0",  "10", "20",
                                                        "25", "70", "200"};
    const std::uint32_t count = times_ == PropertyTimes::Short ? 4 : 6;
    return std::string(kTimes[tape_.pick(count)]) + " ms";
  }

  std::string element() {
    const Instance& instance = program_.instances[InstanceId(
        tape_.pick(static_cast<std::uint32_t>(program_.instances.size())))];
    constexpr std::array<std::string_view, 6> kOperators = {
        "<", ">", "==", "!=", "<=", ">="};
    const std::uint32_t choice = tape_.pick(4);
    if (choice < 2) return instance.name + (choice == 0 ? ".q" : ".fired");
    const bool timer = instance.kind->family == ElementFamily::Timer;
    return "(" + instance.name + (timer ? ".elapsed " : ".value ") +
           std::string(kOperators[tape_.pick(6)]) + " " +
           std::to_string(tape_.pick(timer ? 40 : 4)) + ")";
  }

  std::string leaf() {
    const std::uint32_t choice = tape_.pick(8);
    if (choice == 6 && !program_.instances.empty()) return element();
    if (choice == 7 && !words_.empty()) {
      return "(" + any(words_) + (tape_.pick(2) == 0 ? " < " : " >= ") +
             std::to_string(tape_.pick(60)) + ")";
    }
    return any(bits_);
  }

  std::string memory() {
    constexpr std::array<std::string_view, 4> kMemories = {"prev(", "rose(",
                                                           "fell(", "once("};
    const std::uint32_t choice = tape_.pick(5);
    if (choice == 4) return "begin(" + any(bits_) + ")";
    return std::string(kMemories[choice]) + pop() + ")";
  }

  std::string pop() {
    if (stack_.empty()) return leaf();
    std::string text = std::move(stack_.back());
    stack_.pop_back();
    return text;
  }

  std::string infix() {
    constexpr std::array<std::string_view, 5> kOperators = {"&&", "||", "->",
                                                            "<->", "^"};
    const std::string right = pop();
    return "(" + pop() + " " + std::string(kOperators[tape_.pick(5)]) + " " +
           right + ")";
  }

  std::string step() {
    switch (tape_.pick(5)) {
      case 0:
        return leaf();
      case 1:
        return "!" + pop();
      case 2:
        return memory();
      default:
        return infix();
    }
  }

  /// In parentheses where a line's own words could be mistaken.
  std::string expression() {
    stack_.clear();
    const std::uint32_t steps = tape_.pick(4);
    for (std::uint32_t i = 0; i < steps; ++i) stack_.push_back(step());
    return pop();
  }

  const Program& program_;
  Tape& tape_;
  PropertyTimes times_;
  std::vector<std::string> bits_;
  std::vector<std::string> words_;
  std::vector<std::string> inputs_;
  std::vector<std::string> stack_;
};

}  // namespace

std::string generate_property(const Program& program, Tape& tape,
                              PropertyTimes times) {
  return "//@ " + PropertyGenerator(program, tape, times).property() + "\n";
}

std::string generate_recoverable(const Program& program, Tape& tape) {
  PropertyGenerator generator(program, tape, PropertyTimes::Short);
  return "//@ " + generator.recoverable() + "\n";
}

std::string generate_question(const Program& program, Tape& tape) {
  return PropertyGenerator(program, tape, PropertyTimes::Short).question();
}

std::string generate_assumption(const Program& program, Tape& tape) {
  const std::string text =
      PropertyGenerator(program, tape, PropertyTimes::Short).assumption();
  return text.empty() ? "" : "//@ assume " + text + "\n";
}

}  // namespace rung
