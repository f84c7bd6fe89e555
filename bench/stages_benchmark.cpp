// The time of each stage, by the number of rungs.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "analysis/rule.h"
#include "analysis/simulator.h"
#include "analysis/transition_system.h"
#include "backend/postfix/lower.h"
#include "frontend/script/reader.h"
#include "rungproof_machine.h"
#include "smt/oracle.h"
#include "smt/verify.h"
#include "workload.h"

namespace rung::bench {
namespace {

using benchmark::State;

std::size_t rungs_of(const State& state) {
  return static_cast<std::size_t>(state.range(0));
}

Workload make_workload(const State& state) {
  return Workload(plant_text(rungs_of(state)));
}

void read(State& state) {
  SourceSet sources;
  const FileId file = sources.add("plant", plant_text(rungs_of(state)));
  for (auto _ : state) {
    DiagnosticList diagnostics;
    benchmark::DoNotOptimize(read_script(sources, file, "sim", diagnostics));
  }
}

void build(State& state) {
  SourceSet sources;
  const FileId file = sources.add("plant", plant_text(rungs_of(state)));
  DiagnosticList diagnostics;
  const Ast ast = read_script(sources, file, "sim", diagnostics);
  for (auto _ : state) {
    benchmark::DoNotOptimize(build_program(ast, {}, diagnostics));
  }
}

void transition_system(State& state) {
  const Workload load = make_workload(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(build_transition_system(load.program));
  }
}

void lint(State& state) {
  const Workload load = make_workload(state);
  for (auto _ : state) {
    TransitionSystem ts = build_transition_system(load.program);
    SolverOracle oracle(load.program, ts);
    DiagnosticList found;
    run_rules({load.sources, load.program, load.properties, ts, &oracle},
              found);
    benchmark::DoNotOptimize(found);
  }
}

void prove(State& state) {
  const Workload load = make_workload(state);
  for (auto _ : state) {
    const VerifyReport report = verify(load.program, load.properties, {});
    for (const ObligationResult& result : report.results) {
      if (result.verdict == Verdict::Unknown) {
        state.SkipWithError("a property was not decided");
      }
    }
  }
}

void lower(State& state) {
  const Workload load = make_workload(state);
  for (auto _ : state) {
    DiagnosticList diagnostics;
    benchmark::DoNotOptimize(
        lower_to_postfix_binary(load.program, diagnostics));
  }
}

void simulator_scan(State& state) {
  const Workload load = make_workload(state);
  Simulator simulator(load.program);
  for (auto _ : state) simulator.scan(10);
}

/// One scan of what a controller executes.
void machine_scan(State& state) {
  const Workload load = make_workload(state);
  DiagnosticList diagnostics;
  const std::optional<std::string> bytes =
      lower_to_postfix_binary(load.program, diagnostics);
  if (!bytes) return state.SkipWithError("not lowered");
  const auto* const code = reinterpret_cast<const std::uint8_t*>(bytes->data());
  const auto length = static_cast<std::uint32_t>(bytes->size());
  std::vector<std::uint32_t> memory(
      rungproof::Machine::memory_words(code, length));
  rungproof::Machine machine;
  if (machine.begin(code, length, memory.data(),
                    static_cast<std::uint32_t>(memory.size())) !=
      rungproof::Refusal::None) {
    return state.SkipWithError("refused by the machine");
  }
  for (auto _ : state) benchmark::DoNotOptimize(machine.scan(10));
}

// NOLINTBEGIN: the library's macros.
#define RUNG_STAGE(stage) \
  BENCHMARK(stage)->Arg(20)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond)
RUNG_STAGE(read);
RUNG_STAGE(build);
RUNG_STAGE(transition_system);
RUNG_STAGE(lint);
RUNG_STAGE(prove);
RUNG_STAGE(lower);
RUNG_STAGE(simulator_scan);
RUNG_STAGE(machine_scan);
// NOLINTEND

}  // namespace
}  // namespace rung::bench

BENCHMARK_MAIN();
