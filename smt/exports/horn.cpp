#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "smt/exports/problem.h"
#include "smt/smtlib_text.h"
#include "smt/term_order.h"

namespace rung {
namespace {

using smtlib::call;
using smtlib::number;

class HornWriter {
 public:
  explicit HornWriter(const ModelProblem& problem)
      : ts_(problem.ts), problem_(problem) {}

  std::string write() {
    name_terms();
    std::string out = "; Can a scan end badly? sat: never.\n";
    for (const std::string& name : problem_.names) {
      out += "; " + smtlib::printable(name) + "\n";
    }
    std::string sorts;
    std::string initial;
    std::string next;
    for (const std::uint32_t state : states_) {
      const Variable& var = ts_.vars[ts_.states[state].var];
      sorts += (sorts.empty() ? "" : " ") + std::string(sort(var.type));
      initial += " " + value(var.type, ts_.states[state].init);
      next += " " + text(ts_.states[state].next);
    }
    out += "(set-logic HORN)\n(declare-fun scans (" + sorts + ") Bool)\n";
    out += "(assert " + (states_.empty() ? "scans" : "(scans" + initial + ")") +
           ")\n";
    const std::string body =
        "(and " + now() + "\n" + definitions_ + "  " + text(problem_.legal);
    const std::string after = states_.empty() ? "scans" : "(scans" + next + ")";
    out += "(assert (forall (" + variables_ + ")\n (=> " + body + ")\n  " +
           after + ")))\n";
    out += "(assert (forall (" + variables_ + ")\n (=> " + body + " " +
           text(problem_.bad) + ")\n  false)))\n(check-sat)\n";
    return out;
  }

 private:
  static std::string_view sort(Type type) {
    return type == Type::Bit ? "Bool" : "Int";
  }
  static std::string value(Type type, std::int64_t value) {
    if (type == Type::Word) return number(value);
    return value != 0 ? "true" : "false";
  }
  const std::string& text(ExprId id) const { return text_.at(id); }

  std::string now() const {
    if (states_.empty()) return "scans";
    std::string out = "(scans";
    for (const std::uint32_t state : states_) {
      out += " " + text(ts_.of(ts_.states[state].var));
    }
    return out + ")";
  }

  void name_terms() {
    for (const ExprId id :
         terms_in_order(ts_, {problem_.bad, problem_.legal})) {
      const Expr& e = ts_.exprs[id];
      if (e.op == ExprOp::Constant) {
        text_[id] = value(e.type, e.value);
      } else if (e.op == ExprOp::Variable) {
        name_variable(id, e);
      } else if (e.op == ExprOp::Not) {
        text_[id] = call("not", text(e.a));
      } else {
        const std::string symbol = "t" + std::to_string(named_++);
        declare(symbol, e.type);
        definitions_ += "  " + call("=", symbol, written(e)) + "\n";
        text_[id] = symbol;
      }
    }
  }

  void declare(const std::string& symbol, Type type) {
    variables_ += "(" + symbol + " " + std::string(sort(type)) + ") ";
  }

  void name_variable(ExprId id, const Expr& e) {
    const Variable& var = ts_.vars[e.var];
    const std::string symbol = "v" + std::to_string(named_++);
    text_[id] = symbol;
    declare(symbol, var.type);
    if (var.role == VarRole::State) {
      states_.push_back(var.state);
    } else if (var.type == Type::Word) {
      definitions_ +=
          "  " + call("<=", number(var.low), symbol, number(var.high)) + "\n";
    }
  }

  std::string written(const Expr& e) const {
    static const std::string none;
    const auto operand = [&](ExprId id) -> const std::string& {
      return id.has_value() ? text(id) : none;
    };
    return smtlib::term(ts_.exprs, e, operand(e.a), operand(e.b), operand(e.c));
  }

  const TransitionSystem& ts_;
  const ModelProblem& problem_;
  std::unordered_map<ExprId, std::string> text_;
  std::vector<std::uint32_t> states_;
  std::string variables_;    // "(v0 Bool) (t1 Int) "
  std::string definitions_;  // of the terms, and ranges of the inputs
  std::size_t named_ = 0;
};

}  // namespace

std::string to_horn(const ModelProblem& problem) {
  return HornWriter(problem).write();
}

}  // namespace rung
