#include <vector>

#include "analysis/rules/jumped_over.h"
#include "analysis/rules/support.h"

namespace rung {
namespace {

constexpr std::string_view kDoc = R"md(
## Finds
A call of a plcLib sketch that goes on with the accumulator, where a task
(`loop1`) may have run since the last call and left its own result there.

## Why it matters
All tasks share one `scanValue`. Between `load(X1)` and `reset(Y0)` the other
task runs its rungs, and the stop button does not stop: a published program has
this.

## Example
Bad:

    #include <plcLib.h>
    void setup() { setupPLC(); }
    void loop1(100) { load(X2); out(Y2); }
    void loop() { load(X0); set(Y0); load(X1); reset(Y0); }

Good:

    #include <plcLib.h>
    void setup() { setupPLC(); }
    void loop() {
      load(X0); set(Y0); load(X1); reset(Y0);
      load(X2); out(Y2);
    }

## Limits
The first such call of each task is told. Whether the wrong value is ever used
depends on the inputs: a property line says what must hold.
)md";

/// By cell: it is true where a task runs, or where a part of one does.
class TaskGuards {
 public:
  explicit TaskGuards(const RuleRun& run)
      : run_(run), task_of_(run.program.cells.size()) {
    for (const RungId id : ids_of(run.program.rungs)) {
      const InstanceId task = task_in(run.program.rungs[id]);
      if (!task.has_value()) continue;
      any_ = true;
      const CellId target = run.program.rungs[id].target;
      if (run.program.cells[target].made) task_of_[target.index()] = task;
    }
  }

  bool any() const { return any_; }

  /// The task that the rung belongs to; no value: the program that it cuts.
  InstanceId of(const Rung& rung) const {
    const CellId guard = guard_of(run_.program, rung);
    return guard.has_value() ? task_of_[guard.index()] : InstanceId();
  }

 private:
  InstanceId task_in(const Rung& rung) const {
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = run_.program.nodes[i];
      if (node.op == NodeOp::Read && task_of_[node.cell.index()].has_value()) {
        return task_of_[node.cell.index()];
      }
      if (node.op != NodeOp::Call) continue;
      const InstanceId instance = run_.program.calls[node.call].instance;
      if (run_.program.instances[instance].kind->id == "task-plclib") {
        return instance;
      }
    }
    return {};
  }

  const RuleRun& run_;
  std::vector<InstanceId> task_of_;
  bool any_ = false;
};

bool reads_cell(const RuleRun& run, const Rung& rung, CellId cell) {
  for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
    const Node& node = run.program.nodes[i];
    if (node.op == NodeOp::Read && node.cell == cell) return true;
  }
  return false;
}

void check(RuleRun& run) {
  const CellId accumulator = run.index.find("scanValue");
  if (run.program.language != "plclib" || !accumulator.has_value()) return;
  const TaskGuards guards(run);
  if (!guards.any()) return;
  InstanceId left_by;  // the task whose result is in the accumulator
  std::vector<bool> told(run.program.instances.size());
  for (const Rung& rung : run.program.rungs) {
    const InstanceId task = guards.of(rung);
    const bool writes = rung.target == accumulator;
    if (task.has_value()) {
      if (writes) left_by = task;
      continue;
    }
    if (!left_by.has_value()) continue;
    if (reads_cell(run, rung, accumulator) && !told[left_by.index()]) {
      told[left_by.index()] = true;
      run.report(rung.where,
                 "the accumulator may be what " +
                     quoted(run.program.instances[left_by].name) +
                     " has left: it may run before this call",
                 {.help = "begin with a load in the same statement, or keep "
                          "what both need in one task"});
    }
    if (writes) left_by = {};
  }
}

}  // namespace

constinit const Rule shared_accumulator = {
    "RP607", "shared-accumulator", Severity::Warning, Decision::Syntax, kDoc,
    check};

}  // namespace rung
