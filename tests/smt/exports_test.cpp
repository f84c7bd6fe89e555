// What other model checkers read, executed by evaluators of the two formats
// that know nothing of the writers, must be what the terms are.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <set>
#include <sstream>

#include "smt/exports/problem.h"
#include "smt/interpret.h"
#include "tests/smt/random_terms.h"

namespace rung {
namespace {

using test::RandomTerms;
using Values = std::map<std::string, std::int64_t>;  // of the inputs, by name

/// A binary AIGER file of before 1.9 with one output.
class AigerFile {
 public:
  explicit AigerFile(const std::string& text) : in_(text) {
    std::string magic;
    std::size_t most = 0;
    std::size_t inputs = 0;
    std::size_t latches = 0;
    std::size_t outputs = 0;
    std::size_t gates = 0;
    in_ >> magic >> most >> inputs >> latches >> outputs >> gates;
    EXPECT_EQ(magic, "aig");
    EXPECT_EQ(most, inputs + latches + gates);
    EXPECT_EQ(outputs, 1U);
    next_.resize(latches);
    for (std::size_t& next : next_) in_ >> next;
    in_ >> output_;
    in_.get();
    for (std::size_t i = 0; i < gates; ++i) {
      const std::size_t own = 2 * (inputs + latches + i + 1);
      const std::size_t a = own - number();
      gates_.push_back({a, a - number()});
    }
    names_.resize(inputs);
    for (std::string line; std::getline(in_, line) && line != "c";) {
      if (line[0] != 'i') continue;
      const std::size_t blank = line.find(' ');
      names_[std::stoul(line.substr(1, blank))] = line.substr(blank + 1);
    }
    values_.assign(most + 1, false);
  }

  /// The output after one more scan.
  bool scan(const Values& inputs) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::size_t bracket = names_[i].find('[');
      const std::int64_t value = inputs.at(names_[i].substr(0, bracket));
      const std::size_t bit = bracket == std::string::npos
                                  ? 0
                                  : std::stoul(names_[i].substr(bracket + 1));
      values_[i + 1] = (value >> bit & 1) != 0;
    }
    const std::size_t first = names_.size() + next_.size() + 1;
    for (std::size_t i = 0; i < gates_.size(); ++i) {
      values_[first + i] = at(gates_[i].a) && at(gates_[i].b);
    }
    const bool bad = at(output_);
    std::vector<bool> next;
    for (std::size_t literal : next_) next.push_back(at(literal));
    for (std::size_t i = 0; i < next.size(); ++i) {
      values_[names_.size() + 1 + i] = next[i];
    }
    return bad;
  }

 private:
  struct Gate {
    std::size_t a;
    std::size_t b;
  };
  std::size_t number() {
    std::size_t result = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<std::size_t>(in_.get());
      result |= (byte & 0x7fU) << shift;
      if ((byte & 0x80U) == 0) return result;
    }
  }
  bool at(std::size_t literal) const {
    return values_[literal / 2] != (literal % 2 != 0);
  }

  std::istringstream in_;
  std::vector<std::size_t> next_;
  std::size_t output_ = 0;
  std::vector<Gate> gates_;
  std::vector<std::string> names_;
  std::vector<bool> values_;  // by variable
};

/// A BTOR2 text with one `bad`; bit vectors are signed numbers here.
class Btor2Text {
 public:
  explicit Btor2Text(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      if (line[0] == ';') continue;
      std::istringstream words(line);
      Line one;
      words >> one.id >> one.op;
      for (std::string word; words >> word;) one.words.push_back(word);
      lines_.push_back(one);
    }
    for (const Line& line : lines_) check(line);
  }

  /// Is `bad` true in a scan in which, as in all before, constraints hold?
  bool scan(const Values& inputs) {
    bool bad = false;
    std::map<int, Number> next;
    for (const Line& line : lines_) {
      if (line.op == "sort") continue;
      if (line.op == "init") {
        if (first_) value_[number(line, 1)] = value_[number(line, 2)];
      } else if (line.op == "next") {
        next[number(line, 1)] = value_[number(line, 2)];
      } else if (line.op == "constraint") {
        legal_ = legal_ && value_[number(line, 0)] != 0;
      } else if (line.op == "bad") {
        bad = value_[number(line, 0)] != 0;
      } else if (line.op == "input") {
        value_[line.id] = cut(line, inputs.at(line.words[1]));
      } else if (line.op != "state") {
        value_[line.id] = cut(line, computed(line));
      }
    }
    for (const auto& [id, value] : next) value_[id] = value;
    first_ = false;
    return bad && legal_;
  }

 private:
  struct Line {
    int id = 0;
    std::string op;
    std::vector<std::string> words;
  };

  /// Sorts: the widths that the format wants.
  void check(const Line& line) {
    static const std::set<std::string> kSame = {"not", "and",  "xor",  "add",
                                                "mul", "sdiv", "init", "next"};
    static const std::set<std::string> kBits = {"eq", "slt", "slte", "sgte"};
    const std::string& op = line.op;
    if (op == "sort") {
      width_[line.id] = std::stoi(line.words[1]);
      return;
    }
    if (op == "constraint" || op == "bad") return;
    const int own = width_.at(number(line, 0));
    of_[line.id] = own;
    const auto operand = [&](std::size_t i) { return of_.at(number(line, i)); };
    if (op == "sext") {
      EXPECT_EQ(own, operand(1) + number(line, 2));
    } else if (op == "slice") {
      EXPECT_EQ(own, number(line, 2) + 1);
      EXPECT_LE(own, operand(1));
    } else if (op == "ite") {
      EXPECT_EQ(own, operand(2));
      EXPECT_EQ(own, operand(3));
    } else if (kSame.count(op) != 0) {
      EXPECT_EQ(own, operand(1));
      if (op != "not") {
        EXPECT_EQ(own, operand(2));
      }
    } else if (kBits.count(op) != 0) {
      EXPECT_EQ(own, 1);
      EXPECT_EQ(operand(1), operand(2));
    }
  }

  using Number = __int128;

  static int number(const Line& line, std::size_t i) {
    return std::stoi(line.words[i]);
  }
  /// As a number of the line's width, with its sign.
  Number cut(const Line& line, Number value) const {
    const int width = width_.at(number(line, 0));
    const Number most = Number{1} << width;
    value %= most;
    if (value < 0) value += most;
    return value >= most / 2 ? value - most : value;
  }
  Number computed(const Line& line) {
    const auto at = [&](std::size_t i) { return value_[number(line, i)]; };
    const std::string& op = line.op;
    if (op == "constd") return std::stoll(line.words[1]);
    if (op == "sext" || op == "slice") return at(1);  // slices are low bits
    if (op == "not") return ~at(1);
    if (op == "and") return at(1) & at(2);
    if (op == "xor") return at(1) ^ at(2);
    if (op == "eq") return at(1) == at(2);
    if (op == "slt") return at(1) < at(2);
    if (op == "slte") return at(1) <= at(2);
    if (op == "sgte") return at(1) >= at(2);
    if (op == "add") return at(1) + at(2);
    if (op == "mul") return at(1) * at(2);
    if (op == "sdiv") return at(1) / at(2);
    if (op == "ite") return at(1) != 0 ? at(2) : at(3);
    ADD_FAILURE() << "operator " << op;
    return 0;
  }

  std::vector<Line> lines_;
  std::map<int, int> width_;  // by sort
  std::map<int, int> of_;     // by node: its width
  std::map<int, Number> value_;
  bool first_ = true;
  bool legal_ = true;
};

/// Random terms, with a few states that they drive.
struct RandomProblem {
  ModelProblem problem;
  std::vector<VarId> inputs;

  RandomProblem() {
    RandomTerms random;
    ExprArena& e = random.ts.exprs;
    problem.bad = random.a_bit();
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t bit =
          random.ts.add_state("s" + std::to_string(i), Type::Bit, 0, 1, i % 2);
      const ExprId now = random.ts.state_expr(bit);
      random.ts.states[bit].next = e.exclusive_or(now, random.a_bit());
      const std::uint32_t word = random.ts.add_state(
          "n" + std::to_string(i), Type::Word, -5, 30, -2 * i);
      const ExprId number = random.ts.state_expr(word);
      random.ts.states[word].next =
          e.ite(random.a_bit(),
                e.minimum(e.add(number, e.word(i + 1)), e.word(30)), number);
      problem.bad = e.exclusive_or(
          problem.bad, e.conjunction(now, e.less(number, random.a_word())));
    }
    problem.legal = e.disjunction(random.a_bit(), random.a_bit());
    inputs = random.inputs;
    problem.ts = std::move(random.ts);
    problem.names = {"random"};
  }
};

TEST(Exports, AreWhatTheTermsAre) {
  const bool ok = rc::check([] {
    const RandomProblem random;
    const ModelProblem& problem = random.problem;
    AigerFile aiger(to_aiger(problem));
    Btor2Text btor2(to_btor2(problem));
    Interpreter terms(problem.ts, {problem.bad, problem.legal});
    bool legal = true;
    for (int scan = 0; scan < 12; ++scan) {
      Values values;
      for (VarId input : random.inputs) {
        const Variable& var = problem.ts.vars[input];
        values[var.name] = *rc::gen::inRange(var.low, var.high + 1);
        terms.set_input(input, values[var.name]);
      }
      terms.scan();
      legal = legal && terms.value(problem.legal) != 0;
      const bool bad = legal && terms.value(problem.bad) != 0;
      RC_ASSERT(aiger.scan(values) == bad);
      RC_ASSERT(btor2.scan(values) == bad);
    }
  });
  EXPECT_TRUE(ok);
}

}  // namespace
}  // namespace rung
