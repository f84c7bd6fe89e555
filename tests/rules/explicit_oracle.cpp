#include "explicit_oracle.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rung::testing {
namespace {

using State = std::vector<std::int64_t>;

constexpr std::size_t kMostSteps = 60'000;
constexpr std::size_t kMostChoices = 4096;

std::int64_t value_of(const Expr& expr, const State& values) {
  const auto at = [&](ExprId id) { return values[id.index()]; };
  switch (expr.op) {
    case ExprOp::Constant:
    case ExprOp::Variable:
      return expr.value;  // variables are set by the caller
    case ExprOp::Not:
      return 1 - at(expr.a);
    case ExprOp::And:
      return std::min(at(expr.a), at(expr.b));
    case ExprOp::Xor:
      return at(expr.a) == at(expr.b) ? 0 : 1;
    case ExprOp::Equal:
      return at(expr.a) == at(expr.b) ? 1 : 0;
    case ExprOp::Less:
      return at(expr.a) < at(expr.b) ? 1 : 0;
    case ExprOp::Add:
      return at(expr.a) + at(expr.b);
    case ExprOp::Multiply:
      return at(expr.a) * at(expr.b);
    case ExprOp::Divide:
      return at(expr.a) / at(expr.b);
    case ExprOp::Wrap16: {
      const std::int64_t low = ((at(expr.a) % 65536) + 65536) % 65536;
      return low >= 32768 ? low - 65536 : low;
    }
    case ExprOp::Ite:
      return at(expr.a) != 0 ? at(expr.b) : at(expr.c);
  }
  return 0;
}

/// What a scan may be given: one value a variable that is no state.
struct Choices {
  std::vector<VarId> vars;
  std::vector<State> values;  // all combinations
  bool complete = true;
};

bool only_compared(const TransitionSystem& ts, ExprId word) {
  for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
    const Expr& expr = ts.exprs[ExprId(i)];
    if (expr.a != word && expr.b != word && expr.c != word) continue;
    const bool compares = expr.op == ExprOp::Equal || expr.op == ExprOp::Less;
    const ExprId other = expr.a == word ? expr.b : expr.a;
    if (!compares || !ts.exprs.is_constant(other)) return false;
  }
  return true;
}

State word_values(const TransitionSystem& ts, const Variable& var) {
  State values = {var.low, var.high};
  for (std::uint32_t i = 0; i < ts.exprs.size(); ++i) {
    const Expr& expr = ts.exprs[ExprId(i)];
    if (expr.op != ExprOp::Equal && expr.op != ExprOp::Less) continue;
    for (const auto& [word, limit] :
         {std::pair(expr.a, expr.b), std::pair(expr.b, expr.a)}) {
      if (word != var.expr || !ts.exprs.is_constant(limit)) continue;
      for (std::int64_t near = -1; near <= 1; ++near) {
        values.push_back(ts.exprs[limit].value + near);
      }
    }
  }
  std::erase_if(values, [&](std::int64_t value) {
    return value < var.low || value > var.high;
  });
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

Choices choices_of(const TransitionSystem& ts) {
  Choices choices;
  choices.values.push_back({});
  for (const VarId id : ids_of(ts.vars)) {
    const Variable& var = ts.vars[id];
    if (var.role == VarRole::State) continue;
    choices.vars.push_back(id);
    State some = {var.low, var.high};
    if (var.type == Type::Word && var.role == VarRole::Input) {
      some = word_values(ts, var);
      choices.complete = choices.complete && only_compared(ts, var.expr);
    }
    if (var.role == VarRole::Dt) choices.complete &= var.low == var.high;
    if (some[0] == some.back()) some.resize(1);
    std::vector<State> longer;
    for (const State& start : choices.values) {
      for (const std::int64_t value : some) {
        longer.push_back(start);
        longer.back().push_back(value);
      }
    }
    choices.values = std::move(longer);
    if (choices.values.size() > kMostChoices) {
      choices.complete = false;
      choices.values.resize(kMostChoices);
    }
  }
  return choices;
}

struct Visit {
  State state;
  std::size_t from = 0;  // position of the state before
  State cells;           // at the end of the scan that led here
  std::uint64_t depth = 0;
};

class Search {
 public:
  Search(const TransitionSystem& ts, const std::vector<ExprId>& conditions)
      : ts_(ts), conditions_(conditions), choices_(choices_of(ts)) {
    answers_.resize(conditions.size());
    State start;
    for (const rung::State& state : ts.states) start.push_back(state.init);
    visits_.push_back({start, 0, {}, 0});
    known_.emplace(std::move(start), 0);
  }

  std::vector<Oracle::Evidence> run() {
    std::size_t steps = 0;
    std::size_t at = 0;
    for (; at < visits_.size() && steps < kMostSteps; ++at) {
      for (const State& inputs : choices_.values) {
        ++steps;
        step(at, inputs);
      }
    }
    if (at == visits_.size() && choices_.complete) {
      for (Oracle::Evidence& answer : answers_) {
        if (answer.answer == Oracle::Answer::Unknown) {
          answer = {Oracle::Answer::Yes, "explicit", std::nullopt};
        }
      }
    }
    return std::move(answers_);
  }

 private:
  void step(std::size_t from, const State& inputs) {
    State values(ts_.exprs.size());
    for (std::size_t i = 0; i < ts_.states.size(); ++i) {
      values[ts_.of(ts_.states[i].var).index()] = visits_[from].state[i];
    }
    for (std::size_t i = 0; i < choices_.vars.size(); ++i) {
      values[ts_.of(choices_.vars[i]).index()] = inputs[i];
    }
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      const Expr& expr = ts_.exprs[ExprId(i)];
      if (expr.op != ExprOp::Variable) values[i] = value_of(expr, values);
    }
    for (const ExprId constraint : ts_.constraints) {
      if (values[constraint.index()] == 0) return;
    }
    Visit visit{{}, from, {}, visits_[from].depth + 1};
    for (const rung::State& state : ts_.states) {
      visit.state.push_back(values[state.next.index()]);
    }
    for (const ExprId cell : ts_.cell_end) {
      visit.cells.push_back(values[cell.index()]);
    }
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
      if (answers_[i].answer == Oracle::Answer::Unknown &&
          values[conditions_[i].index()] == 0) {
        answers_[i] = {Oracle::Answer::No, "explicit", trace_to(visit)};
      }
    }
    if (known_.emplace(visit.state, visits_.size()).second) {
      visits_.push_back(std::move(visit));
    }
  }

  Trace trace_to(const Visit& last) const {
    Trace trace;
    trace.steps.push_back({last.depth, ts_.scan.max_ms, 1, last.cells});
    for (std::size_t at = last.from; at != 0; at = visits_[at].from) {
      trace.steps.push_back(
          {visits_[at].depth, ts_.scan.max_ms, 1, visits_[at].cells});
    }
    std::reverse(trace.steps.begin(), trace.steps.end());
    return trace;
  }

  const TransitionSystem& ts_;
  const std::vector<ExprId>& conditions_;
  Choices choices_;
  std::vector<Visit> visits_;
  std::map<State, std::size_t> known_;
  std::vector<Oracle::Evidence> answers_;
};

}  // namespace

std::vector<Oracle::Evidence> ExplicitOracle::answer(
    const std::vector<Question>& questions) {
  std::vector<ExprId> conditions;
  for (const Question& question : questions) {
    conditions.push_back(question.condition);
  }
  return Search(ts_, conditions).run();
}

}  // namespace rung::testing
