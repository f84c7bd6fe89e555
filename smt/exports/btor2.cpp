#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "smt/exports/problem.h"
#include "smt/term_order.h"
#include "smt/words.h"

namespace rung {
namespace {

/// A node that was written, and how many bits it has.
struct Node {
  std::uint32_t id = 0;
  std::uint32_t width = 1;
};

class Btor2Writer {
 public:
  explicit Btor2Writer(const ModelProblem& problem)
      : ts_(problem.ts), problem_(problem) {}

  std::string write() {
    for (const std::string& name : problem_.names) out_ += "; " + name + "\n";
    const std::vector<ExprId> terms =
        terms_in_order(ts_, {problem_.bad, problem_.legal});
    // States first: their next values come last and may need any term.
    for (const ExprId id : terms) {
      const Expr& e = ts_.exprs[id];
      if (e.op == ExprOp::Variable) nodes_[id] = variable(e.var);
    }
    for (const ExprId id : terms) {
      const Expr& e = ts_.exprs[id];
      if (e.op != ExprOp::Variable) nodes_[id] = term(e);
    }
    for (const std::uint32_t state : states_) {
      const ExprId var = ts_.of(ts_.states[state].var);
      const Node own = nodes_.at(var);
      line("next", sort(own.width),
           {own.id, resized(nodes_.at(ts_.states[state].next), own.width).id});
    }
    line("constraint", 0, {nodes_.at(problem_.legal).id});
    line("bad", 0, {nodes_.at(problem_.bad).id});
    return out_;
  }

 private:
  /// "ID op [SORT] OPERANDS"; a sort of 0 is left out.
  std::uint32_t line(std::string_view op, std::uint32_t sort,
                     std::initializer_list<std::uint32_t> operands,
                     const std::string& rest = {}) {
    out_ += std::to_string(++last_);
    out_ += " ";
    out_ += op;
    if (sort != 0) out_ += " " + std::to_string(sort);
    for (const std::uint32_t operand : operands) {
      out_ += " " + std::to_string(operand);
    }
    if (!rest.empty()) out_ += " " + rest;
    out_ += "\n";
    return last_;
  }

  std::uint32_t sort(std::uint32_t width) {
    const auto found = sorts_.find(width);
    if (found != sorts_.end()) return found->second;
    const std::uint32_t made =
        line("sort", 0, {}, "bitvec " + std::to_string(width));
    sorts_[width] = made;
    return made;
  }

  Node made(std::string_view op, std::uint32_t width,
            std::initializer_list<std::uint32_t> operands,
            const std::string& rest = {}) {
    const std::uint32_t of = sort(width);
    return {line(op, of, operands, rest), width};
  }

  Node constant(std::int64_t value, std::uint32_t width) {
    // `constd` of a negative number stands for its two's complement.
    return made("constd", width, {}, std::to_string(value));
  }

  /// Sign-extended, or the low bits.
  Node resized(Node a, std::uint32_t width) {
    if (width > a.width) {
      return made("sext", width, {a.id}, std::to_string(width - a.width));
    }
    if (width == a.width) return a;
    return made("slice", width, {a.id}, std::to_string(width - 1) + " 0");
  }

  static std::uint32_t width_of(Type type, std::int64_t low,
                                std::int64_t high) {
    return type == Type::Bit ? 1 : word_width(low, high);
  }

  Node variable(VarId id) {
    const Variable& var = ts_.vars[id];
    const std::uint32_t width = width_of(var.type, var.low, var.high);
    const std::string name = symbol(var.name);
    if (var.role == VarRole::State) {
      const State& state = ts_.states[var.state];
      const Node first = constant(state.init, width);
      const Node own = made("state", width, {}, name);
      line("init", sort(width), {own.id, first.id});
      states_.push_back(var.state);
      return own;
    }
    const Node own = made("input", width, {}, name);
    if (var.type == Type::Word) {
      const Node low = constant(var.low, width);
      const Node high = constant(var.high, width);
      line("constraint", 0, {made("sgte", 1, {own.id, low.id}).id});
      line("constraint", 0, {made("slte", 1, {own.id, high.id}).id});
    }
    return own;
  }

  /// A symbol ends at a blank.
  static std::string symbol(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }

  Node compared(std::string_view op, const Expr& e) {
    const Node a = nodes_.at(e.a);
    const Node b = nodes_.at(e.b);
    const std::uint32_t width = std::max(a.width, b.width);
    const Node x = resized(a, width);
    const Node y = resized(b, width);
    return made(op, 1, {x.id, y.id});
  }

  /// An operator on words: both operands and the result as wide as needed on
  /// the way.
  Node computed(std::string_view op, const Expr& e, std::uint32_t width) {
    const Node a = resized(nodes_.at(e.a), width);
    const Node b = resized(nodes_.at(e.b), width);
    const Node whole = made(op, width, {a.id, b.id});
    return resized(whole, width_of(e.type, e.low, e.high));
  }

  Node term(const Expr& e) {
    const auto width = [&](ExprId id) { return nodes_.at(id).width; };
    switch (e.op) {
      case ExprOp::Constant:
        return constant(e.value, width_of(e.type, e.value, e.value));
      case ExprOp::Not:
        return made("not", 1, {nodes_.at(e.a).id});
      case ExprOp::And:
        return made("and", 1, {nodes_.at(e.a).id, nodes_.at(e.b).id});
      case ExprOp::Xor:
        return made("xor", 1, {nodes_.at(e.a).id, nodes_.at(e.b).id});
      case ExprOp::Equal:
        return compared("eq", e);
      case ExprOp::Less:
        return compared("slt", e);
      case ExprOp::Add:
        return computed("add", e, std::max(width(e.a), width(e.b)) + 1);
      case ExprOp::Multiply:
        return computed("mul", e, width(e.a) + width(e.b));
      case ExprOp::Divide:
        return computed("sdiv", e, std::max(width(e.a), width(e.b)) + 1);
      case ExprOp::Wrap16:
        return resized(resized(nodes_.at(e.a), 16),
                       width_of(e.type, e.low, e.high));
      case ExprOp::Ite: {
        const std::uint32_t bits = width_of(e.type, e.low, e.high);
        const Node a = resized(nodes_.at(e.b), bits);
        const Node b = resized(nodes_.at(e.c), bits);
        return made("ite", bits, {nodes_.at(e.a).id, a.id, b.id});
      }
      case ExprOp::Variable:
        break;
    }
    return {};
  }

  const TransitionSystem& ts_;
  const ModelProblem& problem_;
  std::string out_;
  std::uint32_t last_ = 0;
  std::map<std::uint32_t, std::uint32_t> sorts_;  // by width
  std::unordered_map<ExprId, Node> nodes_;
  std::vector<std::uint32_t> states_;
};

}  // namespace

std::string to_btor2(const ModelProblem& problem) {
  return Btor2Writer(problem).write();
}

}  // namespace rung
