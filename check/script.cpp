#include "check/script.h"

#include <algorithm>
#include <utility>

namespace rung::check {
namespace {

std::string number(std::int64_t value) {
  if (value >= 0) return std::to_string(value);
  // The smallest number has no positive twin.
  std::string digits = std::to_string(value);
  digits[0] = ' ';
  return "(-" + digits + ")";
}

std::string call(std::string_view name, const std::string& a) {
  return "(" + std::string(name) + " " + a + ")";
}
std::string call(std::string_view name, const std::string& a,
                 const std::string& b) {
  return "(" + std::string(name) + " " + a + " " + b + ")";
}

/// SMT-LIB's `div` rounds down for what is divided by a positive number.
std::string quotient(const std::string& a, std::int64_t divisor) {
  const std::string size = number(divisor < 0 ? -divisor : divisor);
  const std::string up = call("div", a, size);
  const std::string down = call("-", call("div", call("-", a), size));
  const std::string whole =
      "(ite " + call(">=", a, "0") + " " + up + " " + down + ")";
  return divisor < 0 ? call("-", whole) : whole;
}

std::string wrapped(const std::string& a, std::int64_t bits) {
  const std::int64_t count = std::int64_t{1} << (bits < 0 ? -bits : bits);
  if (bits > 0) return call("mod", a, number(count));
  const std::string half = number(count / 2);
  return call("-", call("mod", call("+", a, half), number(count)), half);
}

class Writer {
 public:
  Writer(const Model& model, const Proof& proof)
      : model_(model), terms_(model.terms()), proof_(proof) {}

  Script write() {
    find_cone();
    out_ += is_linear_ ? "(set-logic QF_LIA)\n" : "(set-logic QF_NIA)\n";
    line("(declare-const initial Bool)");
    line("(declare-const step Bool)");
    const std::uint32_t last = proof_.k + 1;
    for (scan_ = 0; scan_ <= last; ++scan_) write_scan(last);
    ask(last);
    return std::move(script_);
  }

 private:
  using Id = std::uint32_t;

  void line(const std::string& text) {
    out_ += text;
    out_ += '\n';
  }
  std::string at_scan(std::string_view prefix, std::uint64_t index) const {
    return std::string(prefix) + std::to_string(index) + "@" +
           std::to_string(scan_);
  }

  // --- what the proof depends on ---------------------------------------------

  void find_cone() {
    in_cone_.assign(terms_.size(), false);
    for (const Value value : model_.assumptions) add_to_cone(value.id);
    for (const Claim& claim : proof_.conditions) add_to_cone(claim.value.id);
    for (const Claim& claim : proof_.consequences) add_to_cone(claim.value.id);
    const std::size_t needed = count_ranges();
    for (const Claim& claim : proof_.lemmas) add_to_cone(claim.value.id);
    script_.has_other_ranges = count_ranges() > needed;
    if (proof_.narrow) ranged_.resize(needed);
    for (const Claim& claim : proof_.helpers) add_to_cone(claim.value.id);
    std::sort(ranged_.begin(), ranged_.end());
    std::sort(cone_.begin(), cone_.end());
    std::sort(states_.begin(), states_.end());
    std::sort(inputs_.begin(), inputs_.end());
    mark_state_terms();
  }

  /// Terms under the root, and under the next values of the states there.
  void add_to_cone(Id root) {
    std::vector<Id> open;
    const auto visit = [&](Id id) {
      if (in_cone_[id]) return;
      in_cone_[id] = true;
      open.push_back(id);
    };
    visit(root);
    while (!open.empty()) {
      const Id id = open.back();
      open.pop_back();
      const Term& term = terms_[id];
      cone_.push_back(id);
      if (term.op == Op::State) {
        const auto state = static_cast<std::uint32_t>(term.value);
        states_.push_back(state);
        visit(model_.states[state].next.id);
      }
      if (term.op == Op::Input) {
        inputs_.push_back(static_cast<std::uint32_t>(term.value));
      }
      for_operands(term, visit);
    }
  }

  /// Those of lemmas: they are written at the last scan's end, too.
  void mark_state_terms() {
    of_state_.assign(terms_.size(), false);
    for (const Claim& claim : proof_.lemmas) of_state_[claim.value.id] = true;
    for (std::size_t i = cone_.size(); i-- > 0;) {
      const Term& term = terms_[cone_[i]];
      is_linear_ = is_linear_ && (term.op != Op::Multiply ||
                                  terms_[term.a].op == Op::Number ||
                                  terms_[term.b].op == Op::Number);
      if (!of_state_[cone_[i]]) continue;
      for_operands(term, [&](Id id) { of_state_[id] = true; });
    }
  }

  /// Numbers stay where they are said to be: claims like the lemmas. Of the
  /// states in the cone that were not looked at before.
  std::size_t count_ranges() {
    for (; looked_at_ < states_.size(); ++looked_at_) {
      const StateVariable& state = model_.states[states_[looked_at_]];
      if (!terms_[state.now.id].word || (!state.low && !state.high)) continue;
      ranged_.push_back(states_[looked_at_]);
    }
    return ranged_.size();
  }

  // --- one scan --------------------------------------------------------------

  void write_scan(std::uint32_t last) {
    for (const std::uint32_t index : states_) {
      const StateVariable& state = model_.states[index];
      const bool word = terms_[state.now.id].word;
      declare(at_scan("s", index), word);
      if (scan_ == 0) {
        write_initial(index, state, word);
      } else {
        line(call("assert", call("=", at_scan("s", index), next_.at(index))));
      }
    }
    if (scan_ < last) write_inputs();
    write_terms(scan_ < last);
    write_claims(last);
  }

  void declare(const std::string& symbol, bool word) {
    line("(declare-const " + symbol + (word ? " Int)" : " Bool)"));
  }

  void write_initial(std::uint32_t index, const StateVariable& state,
                     bool word) {
    const std::string symbol = at_scan("s", index);
    const std::string value =
        word ? number(state.initial) : (state.initial != 0 ? "true" : "false");
    line(call("assert", call("=>", "initial", call("=", symbol, value))));
  }

  void write_inputs() {
    for (const std::uint32_t index : inputs_) {
      const InputVariable& input = model_.inputs[index];
      const bool word = terms_[input.now.id].word;
      declare(at_scan("i", index), word);
      if (!word) continue;
      const std::string symbol = at_scan("i", index);
      line("(assert (<= " + number(input.low) + " " + symbol + " " +
           number(input.high) + "))");
    }
  }

  void write_terms(bool whole) {
    for (const Id id : cone_) {
      const Term& term = terms_[id];
      if (term.op < Op::Not) continue;
      if (term.op == Op::Not || (!whole && !of_state_[id])) continue;
      declare(at_scan("t", id), term.word);
      line(call("assert", call("=", at_scan("t", id), written(term))));
    }
    if (!whole) return;
    next_.assign(model_.states.size(), {});
    for (const std::uint32_t index : states_) {
      next_[index] = symbol(model_.states[index].next.id);
    }
    if (model_.assumptions.empty()) return;
    declare(at_scan("assumed", 0), false);
    for (const Value assumption : model_.assumptions) {
      line(call("assert",
                call("=>", at_scan("assumed", 0), symbol(assumption.id))));
    }
  }

  std::string symbol(Id id) const {
    const Term& term = terms_[id];
    const auto index = static_cast<std::uint64_t>(term.value);
    switch (term.op) {
      case Op::Bit:
        return term.value != 0 ? "true" : "false";
      case Op::Number:
        return number(term.value);
      case Op::State:
        return at_scan("s", index);
      case Op::Input:
        return at_scan("i", index);
      case Op::Not:
        return call("not", symbol_of_positive(term.a));
      default:
        return at_scan("t", id);
    }
  }

  /// Two negations in a row are none: operator~ sees to it.
  std::string symbol_of_positive(Id id) const {
    const Term& term = terms_[id];
    if (term.op == Op::State || term.op == Op::Input) {
      return at_scan(term.op == Op::State ? "s" : "i",
                     static_cast<std::uint64_t>(term.value));
    }
    return at_scan("t", id);
  }

  std::string written(const Term& term) const {
    const std::string a = symbol(term.a);
    if (term.op == Op::Divide) return quotient(a, term.value);
    if (term.op == Op::Wrap) return wrapped(a, term.value);
    const std::string b = symbol(term.b);
    if (term.op == Op::Choose) {
      return "(ite " + a + " " + b + " " + symbol(term.c) + ")";
    }
    return call(operator_name(term.op), a, b);
  }

  static std::string_view operator_name(Op op) {
    switch (op) {
      case Op::And:
        return "and";
      case Op::Or:
        return "or";
      case Op::Xor:
        return "xor";
      case Op::Equal:
        return "=";
      case Op::Less:
        return "<";
      case Op::LessEqual:
        return "<=";
      case Op::Add:
        return "+";
      case Op::Subtract:
        return "-";
      default:
        return "*";
    }
  }

  // --- claims ----------------------------------------------------------------

  std::string range(std::uint32_t index) const {
    const StateVariable& state = model_.states[index];
    const std::string symbol = at_scan("s", index);
    std::string all = "(and true";
    if (state.low) all += " " + call("<=", number(*state.low), symbol);
    if (state.high) all += " " + call("<=", symbol, number(*state.high));
    return all + ")";
  }

  void claim(const std::string& symbol, const std::string& value,
             bool assumed) {
    declare(symbol, false);
    line(call("assert", call("=", symbol, value)));
    if (assumed) line(call("assert", call("=>", "step", symbol)));
  }

  /// Assumed in the step: lemmas in the states before the scan in question,
  /// conditions in the scans before it.
  void write_claims(std::uint32_t last) {
    for (std::size_t i = 0; i < proof_.lemmas.size(); ++i) {
      claim(at_scan("lemma", i), symbol(proof_.lemmas[i].value.id),
            scan_ < last);
    }
    for (const std::uint32_t index : ranged_) {
      claim(at_scan("range", index), range(index), scan_ < last);
    }
    if (scan_ == last) return;
    for (std::size_t i = 0; i < proof_.conditions.size(); ++i) {
      claim(at_scan("holds", i), symbol(proof_.conditions[i].value.id),
            scan_ + 1 < last);
    }
    for (std::size_t i = 0; i < proof_.consequences.size(); ++i) {
      claim(at_scan("leads", i), symbol(proof_.consequences[i].value.id),
            false);
    }
    for (std::size_t i = 0; i < proof_.helpers.size(); ++i) {
      claim(at_scan("helps", i), symbol(proof_.helpers[i].value.id),
            scan_ + 1 < last);
    }
  }

  // --- questions -------------------------------------------------------------

  void question(const std::string& given, const std::string& broken,
                std::uint32_t assumed_scans, Script::Question what) {
    std::string text = "(check-sat-assuming (" + given;
    if (!model_.assumptions.empty()) {
      for (std::uint32_t i = 0; i < assumed_scans; ++i) {
        text += " assumed0@" + std::to_string(i);
      }
    }
    line(text + " " + call("not", broken) + "))");
    script_.questions.push_back(std::move(what));
  }

  void ask_states(const std::string& given, const std::string& part) {
    for (std::size_t i = 0; i < proof_.lemmas.size(); ++i) {
      question(given, at_scan("lemma", i), scan_,
               {part + " of lemma `" + proof_.lemmas[i].what + "`", false,
                static_cast<std::uint32_t>(i)});
    }
    for (const std::uint32_t index : ranged_) {
      question(given, at_scan("range", index), scan_,
               {part + " of the range of `" + model_.states[index].name + "`",
                false, ~0U});
    }
  }

  void ask_conditions(const std::string& given, const std::string& part) {
    for (std::size_t i = 0; i < proof_.conditions.size(); ++i) {
      question(given, at_scan("holds", i), scan_ + 1,
               {part + " of `" + proof_.conditions[i].what + "`", true,
                static_cast<std::uint32_t>(i)});
    }
    for (std::size_t i = 0; i < proof_.consequences.size(); ++i) {
      question(given, at_scan("leads", i), scan_,
               {part + " of the way `" + proof_.consequences[i].what + "`",
                false, ~0U});
    }
    for (std::size_t i = 0; i < proof_.helpers.size(); ++i) {
      question(given, at_scan("helps", i), scan_ + 1,
               {part + " of `" + proof_.helpers[i].what + "`", false, ~0U});
    }
  }

  void ask(std::uint32_t last) {
    line(model_.assumptions.empty()
             ? "(check-sat-assuming (initial))"
             : "(check-sat-assuming (initial assumed0@0))");
    for (scan_ = 0; scan_ < last; ++scan_) {
      ask_states("initial", "initiation");
      if (scan_ + 1 < last) ask_conditions("initial", "initiation");
    }
    ask_states("step", "consecution");
    scan_ = last - 1;
    ask_conditions("step", "safety");
    script_.text = std::move(out_);
  }

  const Model& model_;
  const Terms& terms_;
  const Proof& proof_;
  Script script_;
  std::string out_;
  std::vector<bool> in_cone_;
  std::vector<bool> of_state_;
  std::vector<Id> cone_;
  std::vector<std::uint32_t> states_;
  std::vector<std::uint32_t> inputs_;
  std::vector<std::uint32_t> ranged_;
  std::size_t looked_at_ = 0;
  std::vector<std::string> next_;  // by state, of the scan just written
  std::uint32_t scan_ = 0;
  bool is_linear_ = true;
};

}  // namespace

Script write_script(const Model& model, const Proof& proof) {
  return Writer(model, proof).write();
}

}  // namespace rung::check
