#include "comparison.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "analysis/formula.h"
#include "analysis/simulator.h"
#include "machine_run.h"
#include "program_generator.h"
#include "random_run.h"
#include "ts_interpreter.h"

namespace rung {
namespace {

constexpr std::int64_t kCountFloor = -32768;  // analysis/elements.cpp

/// The states of one element at a scan's end, for the formula of its `.q`.
class EndNames : public NameResolver {
 public:
  EndNames(TransitionSystem& ts, const Program& program, InstanceId id)
      : ts_(ts), instance_(program.instances[id]), id_(id) {}
  ExprId resolve(std::string_view name) override {
    if (name == "p") return ts_.exprs.word(instance_.largest_parameter);
    const auto& states = ts_.instance_states[id_.index()];
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (instance_.kind->states[i].name == name) {
        return ts_.states[states[i]].next;
      }
    }
    return {};
  }

 private:
  TransitionSystem& ts_;
  const Instance& instance_;
  InstanceId id_;
};

class Comparer {
 public:
  Comparer(const Program& program, Encoding encoding, const Stimulus& stimulus,
           Comparison& result)
      : program_(program),
        stimulus_(stimulus),
        result_(result),
        ts_(std::move(encoding.ts)) {
    for (const InstanceId id : ids_of(program.instances)) {
      EndNames names(ts_, encoding.program, id);
      const ElementKind& kind = *encoding.program.instances[id].kind;
      if (kind.done.empty()) {  // edges and latches have no `.q`
        done_.emplace_back();
        observed_.emplace_back();
        continue;
      }
      done_.push_back(
          compile_formula(ts_.exprs, parse_formula(kind.done), names));
      observed_.push_back(
          compile_formula(ts_.exprs, parse_formula(kind.value), names));
    }
  }

  void run(MachineRun* machine) {
    Simulator simulator(program_);
    TsInterpreter interpreter(ts_);
    for (const StimulusStep& step : stimulus_.steps) {
      set_inputs(ts_, stimulus_, step, interpreter);
      for (std::size_t i = 0; i < step.inputs.size(); ++i) {
        simulator.set_input(stimulus_.inputs[i], step.inputs[i]);
      }
      for (std::uint64_t i = 0; i < step.repeat; ++i) {
        simulator.scan(step.dt_ms);
        set_choices(simulator, interpreter);
        interpreter.step();
        if (faulted(ts_, interpreter)) {
          return compare_faults(simulator, interpreter);
        }
        compare_scan(simulator, interpreter);
        if (machine != nullptr) compare_machine(*machine, step, simulator);
        if (!result_.difference.empty()) return;
        ++result_.scans;
      }
      expect_end(simulator);
    }
    compare_jumps();
  }

 private:
  void differ(const std::string& what, std::int64_t simulated,
              std::int64_t other) {
    if (!result_.difference.empty() || simulated == other) return;
    result_.difference = "scan " + std::to_string(result_.scans + 1) + ": " +
                         what + " is " + std::to_string(simulated) +
                         " in the simulator and " + std::to_string(other);
  }

  // A rung did store what the encoding calls out of range.
  void compare_faults(const Simulator& simulator,
                      const TsInterpreter& interpreter) {
    for (const Fault& fault : ts_.faults) {
      if (interpreter.value(fault.condition) == 0) continue;
      if (!fault.cell.has_value()) continue;  // far outside of any cell
      const Cell& cell = program_.cells[fault.cell];
      bool outside = false;
      for (const Rung& rung : program_.rungs) {
        const std::int64_t value = simulator.node_value(rung.root());
        outside = outside || (rung.target == fault.cell &&
                              (value < cell.low || value > cell.high));
      }
      differ("whether " + cell.name + " leaves its range", outside ? 1 : 0, 1);
    }
  }

  // At its floor the encoding of a counter stands for every count below it
  // too, and chooses whether an up-count leaves it. Only there may it choose.
  void set_choices(const Simulator& simulator, TsInterpreter& interpreter) {
    for (const VarId var : ids_of(ts_.vars)) {
      if (ts_.vars[var].role != VarRole::Choice) continue;
      for (const InstanceId id : ids_of(program_.instances)) {
        const std::string owner = program_.instances[id].name + ".";
        if (!ts_.vars[var].name.starts_with(owner)) continue;
        const std::uint32_t count = ts_.instance_states[id.index()].front();
        const bool leaves = interpreter.state(count) == kCountFloor &&
                            simulator.count(id) > kCountFloor;
        interpreter.set(var, leaves ? 1 : 0);
      }
    }
  }

  void compare_scan(const Simulator& simulator,
                    const TsInterpreter& interpreter) {
    for (const CellId id : ids_of(program_.cells)) {
      differ(program_.cells[id].name, simulator.value(id),
             interpreter.value(ts_.cell_end[id.index()]));
    }
    compare_calls(simulator, interpreter);
    for (const InstanceId id : ids_of(program_.instances)) {
      const Instance& instance = program_.instances[id];
      if (!done_[id.index()].has_value()) continue;
      const bool timer = instance.kind->family == ElementFamily::Timer;
      const std::int64_t seen =
          timer ? std::min(simulator.elapsed(id), instance.clock_cap)
                : std::max(simulator.count(id), kCountFloor);
      differ(instance.name + ".q", simulator.done(id) ? 1 : 0,
             interpreter.value(done_[id.index()]));
      differ(instance.name + (timer ? ".elapsed" : ".value"), seen,
             interpreter.value(observed_[id.index()]));
    }
    if (result_.difference.empty()) {
      result_.difference = interpreter.broken_bound();
    }
  }

  void compare_machine(MachineRun& machine, const StimulusStep& step,
                       const Simulator& simulator) {
    const std::string what = machine.scan(stimulus_, step, simulator);
    if (!machine.stopped()) ++result_.machine_scans;
    if (what.empty() || !result_.difference.empty()) return;
    result_.difference =
        "scan " + std::to_string(result_.scans + 1) + ": " + what;
  }

  void compare_calls(const Simulator& simulator,
                     const TsInterpreter& interpreter) {
    for (std::uint32_t i = 0; i < program_.nodes.size(); ++i) {
      const Node& node = program_.nodes[i];
      if (node.op != NodeOp::Call) continue;
      const std::string& name =
          program_.instances[program_.calls[node.call].instance].name;
      differ("whether a call of " + name + " is executed",
             simulator.node_executed(i) ? 1 : 0,
             interpreter.value(ts_.call_executed[node.call.index()]));
      differ("the result of a call of " + name, simulator.node_value(i),
             interpreter.value(ts_.call_value[node.call.index()]));
    }
  }

  void expect_end(const Simulator& simulator) {
    std::vector<std::int64_t>& values = ends_.emplace_back();
    for (const CellId id : ids_of(program_.cells)) {
      values.push_back(simulator.value(id));
    }
  }

  // The same run, with its idle scans jumped over.
  void compare_jumps() {
    const Trace trace = simulate(program_, stimulus_);
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
      if (trace.steps[i].values == ends_[i]) continue;
      result_.difference =
          "the jumping run differs at the end of step " + std::to_string(i + 1);
      return;
    }
  }

  const Program& program_;
  const Stimulus& stimulus_;
  Comparison& result_;
  TransitionSystem ts_;
  std::vector<ExprId> done_;                     // by InstanceId
  std::vector<ExprId> observed_;                 // by InstanceId
  std::vector<std::vector<std::int64_t>> ends_;  // by step: all cells
};

}  // namespace

Comparison compare(const std::vector<std::uint32_t>& numbers,
                   std::uint32_t scans) {
  Tape tape(numbers);
  Comparison result;
  const GeneratedProgram generated = generate_program(tape, {});
  result.text = "// " + std::string(generated.dialect) + "\n" + generated.text;
  std::string error;
  const std::optional<ReadProgram> read =
      read_program(generated.dialect, generated.text, error);
  result.refused = !read.has_value();
  if (!read) return result;
  const Stimulus stimulus = random_stimulus(read->program, tape, scans);
  MachineRun machine(read->program, result.difference);
  if (!result.difference.empty()) return result;
  Comparer(read->program,
           {read->program, build_transition_system(read->program)}, stimulus,
           result)
      .run(&machine);
  return result;
}

std::string compare_encoding(const Program& program, Encoding encoding,
                             const Stimulus& stimulus) {
  Comparison result;
  Comparer(program, std::move(encoding), stimulus, result).run(nullptr);
  return result.difference;
}

}  // namespace rung
