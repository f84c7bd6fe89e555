#include "smt/invariant.h"

namespace rung {

std::string to_string(const TransitionSystem& ts, const LemmaClause& lemma) {
  std::string text;
  for (const LemmaAtom& atom : lemma) {
    if (!text.empty()) text += " || ";
    if (atom.term.has_value()) {
      const std::string term = to_string(ts, atom.term);
      const bool simple = ts.exprs[atom.term].op == ExprOp::Variable;
      if (atom.negated) text += '!';
      text += simple ? term : "(" + term + ")";
      continue;
    }
    if (atom.negated) text += '!';
    text += ts.vars[atom.var].name;
    if (ts.vars[atom.var].type == Type::Bit) continue;
    text += "[" + std::to_string(atom.bit) + "]";
  }
  return text.empty() ? "false" : text;
}

}  // namespace rung
