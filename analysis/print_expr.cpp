#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/transition_system.h"

namespace rung {
namespace {

// A term that shares subterms can be exponentially longer as text.
constexpr std::size_t kMaxText = 4000;

enum Strength : int { Choose, Or, And, Compare, Sum, Product, Prefix };

/// A piece of text, or a term that is still to be printed.
struct Piece {
  std::string_view text;
  ExprId term;
  int strength = Choose;  // weaker operators need brackets here
  bool negated = false;
};

class Printer {
 public:
  explicit Printer(const TransitionSystem& ts) : ts_(ts) {}

  std::string print(ExprId root) {
    open_.push_back({.term = root});
    while (!open_.empty()) {
      if (out_.size() > kMaxText) return out_ + " ...";
      const Piece piece = open_.back();
      open_.pop_back();
      if (!piece.term.has_value()) {
        out_ += piece.text;
      } else if (piece.negated) {
        expand_negated(piece.term, piece.strength);
      } else {
        expand(piece.term, piece.strength);
      }
    }
    return out_;
  }

 private:
  void push(std::initializer_list<Piece> pieces, int strength, int outer) {
    const bool brackets = strength < outer;
    if (brackets) open_.push_back({.text = ")"});
    for (const Piece* at = pieces.end(); at != pieces.begin();) {
      open_.push_back(*--at);
    }
    if (brackets) open_.push_back({.text = "("});
  }

  void binary(const Expr& expr, std::string_view sign, int strength, int outer,
              bool negated = false) {
    const bool compares = strength == Compare;
    const int left = compares ? strength + 1 : strength;
    const int right = strength == Product || compares ? strength + 1 : left;
    push({{{}, expr.a, left, negated}, {sign}, {{}, expr.b, right, negated}},
         strength, outer);
  }

  void expand(ExprId id, int outer) {
    const Expr& expr = ts_.exprs[id];
    switch (expr.op) {
      case ExprOp::Constant:
        return constant(expr.type, expr.value);
      case ExprOp::Variable:
        out_ += ts_.vars[expr.var].name;
        return;
      case ExprOp::Not:
        return expand_negated(expr.a, outer);
      case ExprOp::And:
        return binary(expr, " && ", And, outer);
      case ExprOp::Xor:
        return binary(expr, " != ", Compare, outer);
      case ExprOp::Equal:
        return binary(expr, " == ", Compare, outer);
      case ExprOp::Less:
        return binary(expr, " < ", Compare, outer);
      case ExprOp::Add:
        return binary(expr, " + ", Sum, outer);
      case ExprOp::Multiply:
        return binary(expr, " * ", Product, outer);
      case ExprOp::Divide:
        return binary(expr, " / ", Product, outer);
      case ExprOp::Wrap16:
        return push({{"wrap16("}, {{}, expr.a}, {")"}}, Prefix, outer);
      case ExprOp::Ite:
        return push({{{}, expr.a, Or},
                     {" ? "},
                     {{}, expr.b, Or},
                     {" : "},
                     {{}, expr.c, Or}},
                    Choose, outer);
    }
  }

  /// `!(!a && !b)` is printed as `a || b`, `!(a < b)` as `a >= b`.
  void expand_negated(ExprId id, int outer) {
    const Expr& expr = ts_.exprs[id];
    switch (expr.op) {
      case ExprOp::Constant:
        return constant(expr.type, expr.value == 0 ? 1 : 0);
      case ExprOp::Not:
        open_.push_back({{}, expr.a, outer});
        return;
      case ExprOp::And:
        return binary(expr, " || ", Or, outer, true);
      case ExprOp::Xor:
        return binary(expr, " == ", Compare, outer);
      case ExprOp::Equal:
        return binary(expr, " != ", Compare, outer);
      case ExprOp::Less:
        return binary(expr, " >= ", Compare, outer);
      case ExprOp::Variable:
      case ExprOp::Add:
      case ExprOp::Multiply:
      case ExprOp::Divide:
      case ExprOp::Wrap16:
      case ExprOp::Ite:
        return push({{"!"}, {{}, id, Prefix}}, Prefix, outer);
    }
  }

  void constant(Type type, std::int64_t value) {
    if (type == Type::Word) {
      out_ += std::to_string(value);
    } else {
      out_ += value != 0 ? "true" : "false";
    }
  }

  const TransitionSystem& ts_;
  std::vector<Piece> open_;
  std::string out_;
};

}  // namespace

std::string to_string(const TransitionSystem& ts, ExprId expr) {
  return Printer(ts).print(expr);
}

}  // namespace rung
