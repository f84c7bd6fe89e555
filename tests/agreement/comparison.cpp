#include "comparison.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "analysis/formula.h"
#include "analysis/program.h"
#include "analysis/simulator.h"
#include "analysis/transition_system.h"
#include "frontend/script/reader.h"
#include "program_generator.h"
#include "ts_interpreter.h"

namespace rung {
namespace {

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

std::optional<Program> read(const GeneratedProgram& generated) {
  SourceSet sources;
  const FileId file = sources.add("random.txt", generated.text);
  DiagnosticList diagnostics;
  const Ast ast = read_script(sources, file, generated.dialect, diagnostics);
  Program program = build_program(ast, {}, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  // Texts that the views of a program point to are not looked at below.
  return program;
}

class Comparer {
 public:
  Comparer(const Program& program, Tape& tape, Comparison& result)
      : program_(program),
        tape_(tape),
        result_(result),
        ts_(build_transition_system(program)) {
    for (const InstanceId id : ids_of(program.instances)) {
      EndNames names(ts_, program, id);
      const ElementKind& kind = *program.instances[id].kind;
      done_.push_back(
          compile_formula(ts_.exprs, parse_formula(kind.done), names));
      observed_.push_back(
          compile_formula(ts_.exprs, parse_formula(kind.value), names));
    }
    for (const CellId id : ids_of(program.cells)) {
      const Cell& cell = program.cells[id];
      if (cell.role != CellRole::Input) continue;
      stimulus_.inputs.push_back(id);
      sample_.push_back(cell.initial);
    }
  }

  void run(std::uint32_t scans) {
    Simulator simulator(program_);
    TsInterpreter interpreter(ts_);
    while (result_.scans < scans && result_.difference.empty()) {
      const StimulusStep step = next_step();
      set_inputs(step, simulator, interpreter);
      for (std::uint64_t i = 0; i < step.repeat; ++i) {
        simulator.scan(step.dt_ms);
        interpreter.step();
        if (faulted(interpreter)) return;
        compare_scan(simulator, interpreter);
        if (!result_.difference.empty()) return;
        ++result_.scans;
      }
      stimulus_.steps.push_back(step);
      expect_end(simulator);
    }
    compare_jumps();
  }

 private:
  StimulusStep next_step() {
    constexpr std::array<std::int64_t, 6> kDts = {10, 1, 7, 100, 33, 16};
    StimulusStep step;
    step.dt_ms = kDts[tape_.pick(6)];
    step.repeat = tape_.pick(4) == 3 ? 2 + tape_.pick(20) : 1;
    for (std::size_t i = 0; i < sample_.size(); ++i) {
      const Cell& cell = program_.cells[stimulus_.inputs[i]];
      if (tape_.pick(3) != 1) continue;  // the input is held
      sample_[i] = cell.type == Type::Bit ? 1 - sample_[i] : word(cell);
    }
    step.inputs = sample_;
    return step;
  }

  // Small values meet the program's constants, the ends of the range its
  // overflows.
  std::int64_t word(const Cell& cell) {
    switch (tape_.pick(4)) {
      case 0:
        return std::clamp<std::int64_t>(tape_.pick(60), cell.low, cell.high);
      case 1:
        return cell.high - tape_.pick(2);
      case 2:
        return cell.low + tape_.pick(2);
      default:
        return cell.low +
               tape_.pick(static_cast<std::uint32_t>(cell.high - cell.low + 1));
    }
  }

  void set_inputs(const StimulusStep& step, Simulator& simulator,
                  TsInterpreter& interpreter) {
    interpreter.set(ts_.dt, step.dt_ms);
    for (std::size_t i = 0; i < step.inputs.size(); ++i) {
      simulator.set_input(stimulus_.inputs[i], step.inputs[i]);
    }
    for (const Variable& var : ts_.vars) {
      if (var.role != VarRole::Input) continue;
      const auto at =
          std::find(stimulus_.inputs.begin(), stimulus_.inputs.end(), var.cell);
      interpreter.set(
          ts_.exprs[var.expr].var,
          step.inputs[static_cast<std::size_t>(at - stimulus_.inputs.begin())]);
    }
  }

  // From here on the encoding does not claim to be the program.
  bool faulted(const TsInterpreter& interpreter) const {
    return std::any_of(ts_.faults.begin(), ts_.faults.end(),
                       [&](const Fault& fault) {
                         return interpreter.value(fault.condition) != 0;
                       });
  }

  void differ(const std::string& what, std::int64_t simulated,
              std::int64_t other) {
    if (!result_.difference.empty() || simulated == other) return;
    result_.difference = "scan " + std::to_string(result_.scans + 1) + ": " +
                         what + " is " + std::to_string(simulated) +
                         " in the simulator and " + std::to_string(other);
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
      const bool timer = instance.kind->family == ElementFamily::Timer;
      const std::int64_t seen =
          timer ? std::min(simulator.elapsed(id), instance.clock_cap)
                : simulator.count(id);
      differ(instance.name + ".q", simulator.done(id) ? 1 : 0,
             interpreter.value(done_[id.index()]));
      differ(instance.name + (timer ? ".elapsed" : ".value"), seen,
             interpreter.value(observed_[id.index()]));
    }
    if (result_.difference.empty()) {
      result_.difference = interpreter.broken_bound();
    }
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
    if (!result_.difference.empty()) return;
    const Trace trace = simulate(program_, stimulus_);
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
      if (trace.steps[i].values == ends_[i]) continue;
      result_.difference =
          "the jumping run differs at the end of step " + std::to_string(i + 1);
      return;
    }
  }

  const Program& program_;
  Tape& tape_;
  Comparison& result_;
  TransitionSystem ts_;
  std::vector<ExprId> done_;      // by InstanceId
  std::vector<ExprId> observed_;  // by InstanceId
  Stimulus stimulus_;
  std::vector<std::int64_t> sample_;
  std::vector<std::vector<std::int64_t>> ends_;
};

}  // namespace

Comparison compare(const std::vector<std::uint32_t>& numbers,
                   std::uint32_t scans) {
  Tape tape(numbers);
  Comparison result;
  const GeneratedProgram generated = generate_program(tape, {});
  result.text = "// " + std::string(generated.dialect) + "\n" + generated.text;
  const std::optional<Program> program = read(generated);
  result.refused = !program.has_value();
  if (program) Comparer(*program, tape, result).run(scans);
  return result;
}

}  // namespace rung
