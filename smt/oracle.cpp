#include "smt/oracle.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "analysis/simulator.h"
#include "smt/induction.h"
#include "smt/interpret.h"
#include "smt/partition.h"
#include "smt/portfolio.h"

namespace rung {
namespace {

using Status = Target::Status;

std::vector<Target*> open_ones(const std::vector<Target*>& targets) {
  std::vector<Target*> open;
  for (Target* target : targets) {
    if (target->status == Status::Open) open.push_back(target);
  }
  return open;
}

bool asks_for_runs(const std::vector<Target*>& targets) {
  return std::any_of(targets.begin(), targets.end(), [](const Target* target) {
    return target->purpose != Target::Purpose::Fault;
  });
}

/// Is a variable of this scan's `root` among `variables`?
bool touches(const TransitionSystem& ts, ExprId root,
             const std::vector<bool>& variables) {
  std::unordered_set<ExprId> seen;
  std::vector<ExprId> open = {root};
  while (!open.empty()) {
    const ExprId id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    const Expr& e = ts.exprs[id];
    if (e.op == ExprOp::Variable && variables[e.var.index()]) return true;
    for (const ExprId operand : {e.a, e.b, e.c}) {
      if (operand.has_value()) open.push_back(operand);
    }
  }
  return false;
}

/// What a step costs, in eighths of a microsecond on the machine where it was
/// measured; per term, and for each target where the name says no more.
struct Cost {
  static constexpr std::uint64_t kEncode = 16;         // once
  static constexpr std::uint64_t kRuns = 800;          // once, all random runs
  static constexpr std::uint64_t kMostRuns = 250'000;  // and not per term
  static constexpr std::uint64_t kSketch = 12;
};

/// Targets that share state, and how many terms they depend on.
struct Part {
  std::vector<Target*> members;
  std::size_t terms = 0;
};

/// Terms under the targets of a part and the next values of its states that
/// are not yet in `seen`. Parts share inputs only, so all of them take time
/// linear in the system.
std::size_t count_terms(const TransitionSystem& ts,
                        const std::vector<Target*>& part,
                        std::vector<bool>& seen) {
  std::size_t count = 1;
  std::vector<ExprId> stack;
  stack.reserve(part.size());
  for (const Target* target : part) stack.push_back(target->term);
  while (!stack.empty()) {
    const ExprId id = stack.back();
    stack.pop_back();
    if (seen[id.index()]) continue;
    seen[id.index()] = true;
    ++count;
    const Expr& e = ts.exprs[id];
    for (const ExprId operand : {e.a, e.b, e.c}) {
      if (operand.has_value()) stack.push_back(operand);
    }
    if (e.op == ExprOp::Variable && ts.vars[e.var].role == VarRole::State) {
      stack.push_back(ts.states[ts.vars[e.var].state].next);
    }
  }
  return count;
}

/// Smallest first.
std::vector<Part> parts_of(const TransitionSystem& ts,
                           std::vector<Target>& targets) {
  std::vector<ExprId> roots;
  roots.reserve(targets.size());
  for (const Target& target : targets) roots.push_back(target.term);
  std::vector<bool> seen(ts.exprs.size());
  std::vector<Part> parts;
  for (const std::vector<std::size_t>& group : partition(ts, roots)) {
    Part part;
    part.members.reserve(group.size());
    for (const std::size_t i : group) part.members.push_back(&targets[i]);
    part.terms = count_terms(ts, part.members, seen);
    parts.push_back(std::move(part));
  }
  std::stable_sort(
      parts.begin(), parts.end(),
      [](const Part& a, const Part& b) { return a.terms < b.terms; });
  return parts;
}

}  // namespace

SolverOracle::SolverOracle(const Program& program, TransitionSystem& ts,
                           const OracleOptions& options)
    : program_(program),
      ts_(ts),
      options_(options),
      deadline_(options.seconds),
      effort_(options.effort) {}

std::vector<Oracle::Evidence> SolverOracle::answer(
    const std::vector<Question>& questions) {
  growth_ = growth_terms(ts_);
  // The same question is asked once; two rules may have it.
  std::unordered_map<ExprId, std::size_t> place;
  std::vector<Target> targets;
  const auto ask = [&](ExprId never, Target::Purpose purpose, bool hidden) {
    const auto [entry, is_new] = place.emplace(never, targets.size());
    if (is_new) {
      targets.push_back({.term = ts_.exprs.negation(never),
                         .never = never,
                         .purpose = purpose,
                         .hidden = true});
    }
    Target& target = targets[entry->second];
    target.hidden = target.hidden && hidden;
  };
  for (const Fault& fault : ts_.faults) {
    ask(ts_.exprs.negation(fault.condition), Target::Purpose::Fault, true);
  }
  for (const Question& question : questions) {
    ask(question.condition, Target::Purpose::Violation,
        !question.wants_witness);
  }
  for (const Part& part : parts_of(ts_, targets)) {
    decide(part.members, part.terms);
  }
  std::vector<Evidence> answers;
  answers.reserve(questions.size());
  for (const Question& question : questions) {
    answers.push_back(evidence(targets[place.at(question.condition)], targets));
  }
  return answers;
}

Oracle::Evidence SolverOracle::evidence(
    const Target& target, const std::vector<Target>& targets) const {
  Evidence evidence;
  evidence.engine = target.engine;
  if (target.status == Status::Unreachable) {
    if (!fault_may_matter(target.term, targets)) evidence.answer = Answer::Yes;
  } else if (target.status == Status::Reached && target.hidden) {
    evidence.answer = Answer::No;
  } else if (target.status == Status::Reached) {
    evidence.witness = replay(target);
    if (evidence.witness) evidence.answer = Answer::No;
  }
  return evidence;
}

/// Takes the first of the wanted targets that half of the effort pays for.
std::vector<Target*> SolverOracle::afford(std::vector<Target*> wanted,
                                          std::uint64_t fixed,
                                          std::uint64_t each) {
  fixed += ts_.exprs.size() / 16;  // tables over all terms
  const std::uint64_t limit = effort_ / 2;
  const std::uint64_t most = limit < fixed ? 0 : (limit - fixed) / each;
  if (wanted.size() > most) wanted.resize(most);
  if (!wanted.empty()) effort_ -= fixed + each * wanted.size();
  return wanted;
}

void SolverOracle::decide(const std::vector<Target*>& part,
                          std::uint64_t terms) {
  induct(afford(open_ones(part), terms * Cost::kEncode, terms));
  const std::uint64_t runs = std::min(terms * Cost::kRuns, Cost::kMostRuns);
  sketch(afford(open_ones(part), terms * Cost::kEncode + runs,
                terms * Cost::kSketch));
}

/// One joint induction: most of what is true follows from the scan before.
void SolverOracle::induct(const std::vector<Target*>& open) {
  constexpr std::uint32_t kScans = 1;
  if (!asks_for_runs(open) || deadline_.passed()) return;
  std::vector<ExprId> terms;
  terms.reserve(open.size());
  for (const Target* target : open) terms.push_back(target->term);
  Cone cone(ts_, terms);
  if (cone.circuit().overflow()) return;
  Candidates candidates;
  for (const AigLit root : cone.roots()) {
    candidates.conditions.push_back(aig_not(root));
  }
  if (!prove_by_induction(cone, {}, kScans, candidates, {2000, 500},
                          deadline_)) {
    return;
  }
  Invariant invariant;
  invariant.k = kScans;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!candidates.condition_holds[i]) continue;
    open[i]->status = Status::Unreachable;
    open[i]->engine = "induction k=1";
    open[i]->k = kScans;
    invariant.conditions.push_back(open[i]->never);
  }
  confirm(open, invariant);
}

void SolverOracle::sketch(const std::vector<Target*>& targets) {
  if (!asks_for_runs(targets) || deadline_.passed()) return;
  Portfolio portfolio(ts_, growth_, targets,
                      {{}, options_.max_depth, &deadline_});
  portfolio.sketch();
  if (portfolio.cone().circuit().overflow()) {
    for (Target* target : targets) target->status = Status::Open;
    return;
  }
  confirm(targets, portfolio.invariant());
}

/// A proof that its check does not accept is none.
void SolverOracle::confirm(const std::vector<Target*>& targets,
                           const Invariant& invariant) {
  std::vector<ExprId> goals;
  for (const Target* target : targets) {
    if (target->status == Status::Unreachable) goals.push_back(target->never);
  }
  if (goals.empty() || !options_.self_check) return;
  const CertificateReport report =
      session_.check(ts_, invariant, goals, {options_.seconds, {}, {}, {}});
  if (report.outcome == CertificateOutcome::Accepted) return;
  for (Target* target : targets) {
    if (target->status == Status::Unreachable) target->status = Status::Open;
  }
}

/// The run on the simulator; nothing when its cells are not what the terms
/// say, or the target is not true at its end.
std::optional<Trace> SolverOracle::replay(const Target& target) const {
  const Stimulus stimulus = to_stimulus(ts_, target.run);
  Trace trace = simulate(program_, stimulus);
  if (!options_.self_check) return trace;
  const std::vector<bool> cone = cone_of_influence(ts_, {target.term});
  std::vector<ExprId> roots = ts_.constraints;
  roots.push_back(target.term);
  std::vector<CellId> cells;
  for (const State& state : ts_.states) {
    const CellId cell = ts_.vars[state.var].cell;
    if (!cell.has_value() || !cone[state.var.index()]) continue;
    cells.push_back(cell);
    roots.push_back(ts_.cell_end[cell.index()]);
  }
  Interpreter terms(ts_, roots);
  if (!run_terms(ts_, stimulus, terms)) return std::nullopt;
  if (trace.steps.empty() || terms.value(target.term) == 0) return std::nullopt;
  const std::vector<std::int64_t>& last = trace.steps.back().values;
  for (const CellId cell : cells) {
    const ExprId end = ts_.cell_end[cell.index()];
    if (terms.value(end) != last[cell.index()]) return std::nullopt;
  }
  return trace;
}

/// Does a fault that may happen read what the condition depends on?
bool SolverOracle::fault_may_matter(ExprId condition,
                                    const std::vector<Target>& targets) const {
  std::vector<bool> cone;
  for (const Target& target : targets) {
    if (target.purpose != Target::Purpose::Fault) continue;
    if (target.status == Status::Unreachable) continue;
    if (cone.empty()) cone = cone_of_influence(ts_, {condition});
    if (touches(ts_, target.term, cone)) return true;
  }
  return false;
}

}  // namespace rung
