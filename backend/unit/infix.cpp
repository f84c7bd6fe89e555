#include "backend/unit/infix.h"

#include <vector>

namespace rung::backend {
namespace {

/// Binding strength; an operand that binds no stronger gets parentheses.
int strength_of(NodeOp op) {
  switch (op) {
    case NodeOp::Equal:
    case NodeOp::NotEqual:
    case NodeOp::Less:
    case NodeOp::LessEqual:
    case NodeOp::Greater:
    case NodeOp::GreaterEqual:
    case NodeOp::Xor:
      return 1;
    case NodeOp::Or:
      return 2;
    case NodeOp::And:
      return 3;
    case NodeOp::Add:
    case NodeOp::Subtract:
      return 4;
    case NodeOp::Multiply:
    case NodeOp::Divide:
      return 5;
    case NodeOp::Not:
    case NodeOp::Negate:
      return 6;
    default:
      return 7;
  }
}

constexpr int kTight = 6;  // a bit that counts as a number

bool is_comparison(NodeOp op) {
  return strength_of(op) == 1 && op != NodeOp::Xor;
}

class Printer {
 public:
  Printer(std::string& text, const Unit& unit, const Terms& terms,
          const InfixSpelling& spelling)
      : text_(text), unit_(unit), terms_(terms), spelling_(spelling) {}

  void run() {
    print(terms_.size() - 1, 0);
    while (!todo_.empty()) {
      const Todo next = todo_.back();
      todo_.pop_back();
      if (next.sign.empty()) {
        print(next.term, next.strength);
      } else {
        text_ += next.sign;
      }
    }
  }

 private:
  struct Todo {
    std::string_view sign;  // empty: the term
    std::size_t term = 0;
    int strength = 0;
  };

  void print(std::size_t at, int outer) {
    const Term& term = terms_[at];
    if (term.op == NodeOp::Constant) return constant(term);
    if (term.op == NodeOp::Read) {
      text_ += unit_.variables[term.cell].name;
      return;
    }
    if (term.op == NodeOp::ToWord) {
      todo_.push_back({{}, at - 1, kTight});
      return;
    }
    if (term.op == NodeOp::Call) return call(at);
    const int own = strength_of(term.op);
    const bool bracket = own <= outer;
    if (bracket) {
      text_ += '(';
      todo_.push_back({")"});
    }
    if (term.op == NodeOp::Not || term.op == NodeOp::Negate) {
      text_ += term.op == NodeOp::Not ? spelling_.not_sign : "-";
      todo_.push_back({{}, at - 1, own});
      return;
    }
    const std::size_t left = at - 1 - terms_[at - 1].size;
    // Arithmetic stands in comparisons as it is. Languages do not agree how
    // strong XOR is.
    const int inner = is_comparison(term.op)   ? 3
                      : term.op == NodeOp::Xor ? 5
                                               : own;
    const bool chain =
        term.op == NodeOp::And || term.op == NodeOp::Or || own == 4 || own == 5;
    todo_.push_back({{}, at - 1, inner});
    todo_.push_back({sign_of(term.op)});
    todo_.push_back({{}, left, chain ? own - 1 : inner});
  }

  void call(std::size_t at) {
    const InlineCall& called = unit_.calls[terms_[at].call];
    text_ += called.head;
    todo_.push_back({")"});
    std::size_t operand = at - 1;
    for (std::uint32_t i = called.operands; i > 0; --i) {
      todo_.push_back({{}, operand, 0});
      if (i > 1) todo_.push_back({", "});
      operand -= terms_[operand].size;
    }
  }

  void constant(const Term& term) {
    if (term.type == Type::Bit) {
      text_ += term.value != 0 ? spelling_.true_word : spelling_.false_word;
    } else if (term.value < 0) {
      text_ += '(' + std::to_string(term.value) + ')';
    } else {
      text_ += std::to_string(term.value);
    }
  }

  std::string_view sign_of(NodeOp op) const {
    switch (op) {
      case NodeOp::And:
        return spelling_.and_sign;
      case NodeOp::Or:
        return spelling_.or_sign;
      case NodeOp::Xor:
        return spelling_.xor_sign;
      case NodeOp::Equal:
        return spelling_.equal;
      case NodeOp::NotEqual:
        return spelling_.not_equal;
      case NodeOp::Less:
        return " < ";
      case NodeOp::LessEqual:
        return " <= ";
      case NodeOp::Greater:
        return " > ";
      case NodeOp::GreaterEqual:
        return " >= ";
      case NodeOp::Add:
        return " + ";
      case NodeOp::Subtract:
        return " - ";
      case NodeOp::Multiply:
        return " * ";
      default:
        return " / ";
    }
  }

  std::string& text_;
  const Unit& unit_;
  const Terms& terms_;
  const InfixSpelling& spelling_;
  std::vector<Todo> todo_;
};

}  // namespace

void append_infix(std::string& text, const Unit& unit, const Terms& terms,
                  const InfixSpelling& spelling) {
  Printer(text, unit, terms, spelling).run();
}

}  // namespace rung::backend
