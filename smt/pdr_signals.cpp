#include "smt/pdr.h"
#include "smt/thresholds.h"

namespace rung {

std::vector<PdrSignal> pdr_signals(TransitionSystem& ts, Cone& cone) {
  std::vector<PdrSignal> coarse;
  std::vector<PdrSignal> fine;
  const auto constants = thresholds(cone);
  Aig& aig = cone.circuit().aig();
  for (std::uint32_t state : cone.states()) {
    const VarId var = ts.states[state].var;
    const bool word = ts.vars[var].type == Type::Word;
    const Word leaves = cone.circuit().leaves(var);
    const Word next = cone.circuit().next(state);
    const std::int64_t init = ts.states[state].init;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      if (aig_node(leaves[i]) == 0) continue;
      PdrSignal signal;
      if (word) {
        signal.atom = {{}, var, i, false};
      } else {
        signal.atom.term = ts.of(var);
      }
      signal.now = leaves[i];
      signal.next = next[i];
      signal.init = ((init >> i) & 1) != 0;
      signal.fine = word;
      (word ? fine : coarse).push_back(signal);
    }
    if (!word) continue;
    std::vector<std::int64_t> bounds = constants.at(state);
    bounds.push_back(ts.vars[var].low + 1);  // is it at its lowest
    for (std::int64_t c : bounds) {
      const Word bound = word_constant(c);
      PdrSignal signal;
      signal.atom.term = ts.exprs.less_equal(ts.exprs.word(c), ts.of(var));
      signal.now = cone.circuit().bit(signal.atom.term);
      signal.next = aig_not(word_less(aig, next, bound));
      signal.init = init >= c;
      coarse.push_back(signal);
    }
  }
  coarse.insert(coarse.end(), fine.begin(), fine.end());
  return coarse;
}

}  // namespace rung
