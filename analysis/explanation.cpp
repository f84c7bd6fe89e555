#include "analysis/explanation.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "analysis/execute.h"
#include "analysis/formula.h"
#include "analysis/node_operands.h"
#include "analysis/property_check.h"
#include "analysis/simulator.h"

namespace rung {
namespace {

constexpr std::size_t kMostChanges = 48;         // that are tried to be undone
constexpr std::size_t kMostChain = 12;           // steps
constexpr std::size_t kMostContacts = 12;        // of one step
constexpr std::uint64_t kMostRungs = 4'000'000;  // executed for one run

/// Runs the first `steps` steps of a run, and one scan of the next.
bool run_into(const Stimulus& stimulus, std::size_t steps, Simulator& simulator,
              std::uint64_t limit) {
  for (std::size_t at = 0; at <= steps; ++at) {
    const StimulusStep& step = stimulus.steps[at];
    set_inputs(simulator, stimulus, step);
    const std::uint64_t scans = at == steps ? 1 : step.repeat;
    if (!run_scans(simulator, scans, step.dt_ms, limit)) return false;
  }
  return true;
}

/// Undoes changes of inputs, one after the other, as long as the run still ends
/// in the violation.
class Undoing {
 public:
  Undoing(const Program& program, const PropertySet& properties,
          std::uint32_t property, std::uint32_t part, const Trace& trace)
      : program_(program),
        properties_(properties),
        property_(property),
        part_(part),
        trace_(trace),
        stimulus_(stimulus_of(program, trace)) {}

  std::vector<Explanation::InputChange> needed() {
    std::vector<Change> changes = list();
    if (changes.size() > kMostChanges || !affordable()) return {};
    for (bool undone = true; undone;) {
      undone = false;
      for (std::size_t i = 0; i < changes.size();) {
        if (!undo(changes[i])) {
          ++i;
          continue;
        }
        changes = list();
        undone = true;
      }
    }
    return described(changes);
  }

 private:
  struct Change {
    std::size_t step;
    std::size_t input;
  };

  std::int64_t before(const Change& change) const {
    if (change.step == 0) {
      const Cell& cell = program_.cells[stimulus_.inputs[change.input]];
      return std::clamp<std::int64_t>(cell.initial, cell.low, cell.high);
    }
    return stimulus_.steps[change.step - 1].inputs[change.input];
  }

  std::vector<Change> list() const {
    std::vector<Change> changes;
    for (std::size_t step = 0; step < stimulus_.steps.size(); ++step) {
      for (std::size_t i = 0; i < stimulus_.inputs.size(); ++i) {
        const Change change = {step, i};
        const bool changes_here =
            stimulus_.steps[step].inputs[i] != before(change);
        if (changes_here) changes.push_back(change);
      }
    }
    return changes;
  }

  bool affordable() const {
    Simulator simulator(program_);
    const std::uint64_t scans =
        kMostRungs / (program_.rungs.size() + 1) / kMostChanges + 1;
    return !stimulus_.steps.empty() &&
           run_into(stimulus_, stimulus_.steps.size() - 1, simulator, scans);
  }

  /// The input stays as it was until it changes again.
  bool undo(const Change& change) {
    Stimulus without = stimulus_;
    const std::int64_t old = before(change);
    const std::int64_t now = without.steps[change.step].inputs[change.input];
    for (std::size_t i = change.step; i < without.steps.size(); ++i) {
      std::int64_t& value = without.steps[i].inputs[change.input];
      if (value != now) break;
      value = old;
    }
    const Replay replayed =
        replay(program_, properties_, property_, part_, without);
    const bool same = replayed.assumptions_hold &&
                      replayed.decided_at == trace_.steps.back().scan;
    if (same) stimulus_ = std::move(without);
    return same;
  }

  std::vector<Explanation::InputChange> described(
      const std::vector<Change>& changes) const {
    std::vector<Explanation::InputChange> result;
    for (const Change& change : changes) {
      const Trace::Step& step = trace_.steps[change.step];
      result.push_back({step.scan - step.repeat + 1,
                        stimulus_.inputs[change.input],
                        stimulus_.steps[change.step].inputs[change.input]});
    }
    return result;
  }

  const Program& program_;
  const PropertySet& properties_;
  std::uint32_t property_;
  std::uint32_t part_;
  const Trace& trace_;
  Stimulus stimulus_;
};

/// From the coils of a property back through the rungs: which contacts gave
/// them their values, and since when.
class Chain {
 public:
  Chain(const Program& program, const Trace& trace)
      : program_(program),
        trace_(trace),
        stimulus_(stimulus_of(program, trace)),
        writer_(program.cells.size()) {
    for (const RungId id : ids_of(program.rungs)) {
      writer_[program.rungs[id].target.index()] = id;
    }
  }

  void follow(const std::vector<CellId>& named, Explanation& out) {
    const std::size_t last = trace_.steps.size() - 1;
    for (const CellId cell : named) want(cell, last);
    const std::size_t own = open_.size();
    for (std::size_t i = 0; i < open_.size() && i < kMostChain; ++i) {
      const Event event = open_[i];  // more of them come up meanwhile
      const Explanation::Step step = explain(event);
      const bool later =
          !out.blamed.has_value() ||
          std::pair(step.scan, step.rung) > std::pair(last_scan_, out.blamed);
      if (i < own && later) {
        out.blamed = step.rung;
        last_scan_ = step.scan;
      }
      out.chain.push_back(step);
    }
    std::stable_sort(
        out.chain.begin(), out.chain.end(), [](const auto& a, const auto& b) {
          return std::pair(a.scan, a.rung) < std::pair(b.scan, b.rung);
        });
  }

 private:
  struct Event {  // a coil got its value in this step of the trace
    CellId cell;
    std::size_t step = 0;
    bool kept = false;
  };

  std::int64_t value(CellId cell, std::size_t step) const {
    return trace_.steps[step].values[cell.index()];
  }

  /// The coil's last change up to `step`.
  void want(CellId cell, std::size_t step) {
    if (!writer_[cell.index()].has_value()) return;
    Event event = {cell, step, true};
    for (std::size_t i = step + 1; i-- > 0;) {
      const std::int64_t old =
          i == 0 ? program_.cells[cell].initial : value(cell, i - 1);
      if (value(cell, i) == old) continue;
      event.step = i;
      event.kept = false;
      break;
    }
    if (seen_.insert({cell, event.step}).second) open_.push_back(event);
  }

  Explanation::Step explain(const Event& event) {
    const Trace::Step& at = trace_.steps[event.step];
    Explanation::Step step;
    step.cell = event.cell;
    step.value = value(event.cell, event.step);
    step.kept = event.kept;
    step.scan = event.kept ? at.scan : at.scan - at.repeat + 1;
    step.rung = writer_[event.cell.index()];
    const std::uint64_t limit = kMostRungs / (program_.rungs.size() + 1) + 1;
    Simulator simulator(program_);
    if (!run_into(stimulus_, event.step, simulator, limit)) return step;
    collect(program_.rungs[step.rung], event, simulator, step.contacts);
    return step;
  }

  /// The operands that alone decide the value of the rung.
  void collect(const Rung& rung, const Event& event, const Simulator& simulator,
               std::vector<Explanation::Contact>& contacts) {
    std::vector<std::uint32_t> stack = {rung.root()};
    std::set<std::uint32_t> visited;
    while (!stack.empty() && contacts.size() < kMostContacts) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      if (!visited.insert(i).second || !simulator.node_executed(i)) continue;
      const Node& node = program_.nodes[i];
      const std::int64_t now = simulator.node_value(i);
      if (node.op == NodeOp::Read) {
        const Cell& cell = program_.cells[node.cell];
        note({cell.name, now}, contacts);
        follow_read(node.cell, now, event);
      } else if (node.op == NodeOp::Call) {
        const ElementCall& call = program_.calls[node.call];
        note({program_.instances[call.instance].name, now}, contacts);
        for (const std::uint32_t operand : call.arguments) {
          follow_argument(operand, simulator, event);
        }
      } else {
        push_operands(node, now, simulator, stack);
      }
    }
  }

  static void note(Explanation::Contact contact,
                   std::vector<Explanation::Contact>& contacts) {
    const bool known = std::any_of(
        contacts.begin(), contacts.end(),
        [&](const auto& other) { return other.name == contact.name; });
    if (!known) contacts.push_back(std::move(contact));
  }

  /// What is read before it is written has the value of the scan before.
  void follow_read(CellId cell, std::int64_t now, const Event& event) {
    std::size_t step = event.step;
    if (value(cell, step) != now) {
      if (step == 0) return;
      --step;
    }
    if (cell == event.cell) return;
    want(cell, step);
  }

  void follow_argument(std::uint32_t operand, const Simulator& simulator,
                       const Event& event) {
    const Node& node = program_.nodes[operand];
    if (node.op != NodeOp::Read || !simulator.node_executed(operand)) return;
    follow_read(node.cell, simulator.node_value(operand), event);
  }

  static void push_operands(const Node& node, std::int64_t now,
                            const Simulator& simulator,
                            std::vector<std::uint32_t>& stack) {
    if (node.op == NodeOp::And || node.op == NodeOp::Or) {
      // One operand decides a false AND and a true OR.
      const bool one = (now != 0) == (node.op == NodeOp::Or);
      const bool left = (simulator.node_value(node.a) != 0) == (now != 0);
      if (one) return stack.push_back(left ? node.a : node.b);
    }
    const std::uint32_t count = operand_count(node.op);
    if (count > 1) stack.push_back(node.b);
    if (count > 0) stack.push_back(node.a);
  }

  const Program& program_;
  const Trace& trace_;
  Stimulus stimulus_;
  std::vector<RungId> writer_;  // by CellId: the last rung that writes it
  std::vector<Event> open_;
  std::set<std::pair<CellId, std::size_t>> seen_;
  std::uint64_t last_scan_ = 0;  // of the blamed rung
};

}  // namespace

std::vector<CellId> named_bits(const Program& program,
                               const Property& property) {
  const PropertyNames names(program);
  std::vector<CellId> cells;
  for (const std::string& text : property.formulas) {
    for (const FormulaNode& node : parse_formula(text).nodes) {
      if (node.op != FormulaOp::Name) continue;
      const PropertyName found = names.find(node.text);
      if (found.kind != PropertyName::Kind::Cell) continue;
      if (program.cells[found.cell].type != Type::Bit) continue;
      const bool known =
          std::find(cells.begin(), cells.end(), found.cell) != cells.end();
      if (!known) cells.push_back(found.cell);
    }
  }
  return cells;
}

Stimulus stimulus_of(const Program& program, const Trace& trace) {
  Stimulus stimulus;
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].role == CellRole::Input) {
      stimulus.inputs.push_back(id);
    }
  }
  for (const Trace::Step& step : trace.steps) {
    StimulusStep& made = stimulus.steps.emplace_back();
    made.dt_ms = step.dt_ms;
    made.repeat = step.repeat;
    for (const CellId id : stimulus.inputs) {
      made.inputs.push_back(step.values[id.index()]);
    }
  }
  return stimulus;
}

Explanation explain_run(const Program& program, const PropertySet& properties,
                        std::uint32_t property, std::uint32_t part,
                        const Trace& trace) {
  Explanation out;
  if (trace.steps.empty()) return out;
  const bool flickers =
      std::any_of(trace.steps.begin(), trace.steps.end(),
                  [](const Trace::Step& step) { return step.changes; });
  if (!flickers) {
    out.needed = Undoing(program, properties, property, part, trace).needed();
  }
  Chain(program, trace)
      .follow(named_bits(program, properties.properties[property]), out);
  return out;
}

}  // namespace rung
