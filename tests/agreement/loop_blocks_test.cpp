// Loops that engines find in programs of function blocks, executed.
//
// RUNG_ORACLE_LIVENESS: a program for each 16 (200 unless set).

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <utility>
#include <vector>

#include "block_programs.h"
#include "random_run.h"
#include "shrink_tape.h"
#include "smt/verify.h"
#include "tests/setting.h"

namespace rung {
namespace {

/// Loops through timers and counters of every dialect come round on the
/// simulator, too, and what settles with them does so there.
TEST(Oracle, LoopsThroughBlocksAreTheSimulators) {
  const std::uint64_t count = setting("RUNG_ORACLE_LIVENESS", 200) / 16;
  std::uint32_t loops = 0;
  std::uint32_t proofs = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
    Tape tape(numbers);
    const Program program = random_block_program(tape);
    PropertySet set;
    Property calm;
    calm.form = Property::Form::Settles;
    calm.name = "calm";
    calm.scans = 2;
    set.properties.push_back(calm);
    for (const Cell& cell : program.cells) {
      if (cell.role == CellRole::Input || cell.type != Type::Bit) continue;
      Property comes;
      comes.form = Property::Form::Eventually;
      comes.name = cell.name;
      comes.formulas = {(tape.pick(2) == 0 ? "" : "!") + cell.name};
      set.properties.push_back(std::move(comes));
      if (set.properties.size() == 4) break;
    }
    VerifyOptions options;
    options.budget.seconds = 1;
    const VerifyReport report = verify(program, set, options);
    for (const SelfCheckFailure& failure : report.failures) {
      ADD_FAILURE() << "seed " << seed << ": " << failure.obligation << ": "
                    << failure.what;
    }
    for (const ObligationResult& result : report.results) {
      loops += result.verdict == Verdict::Violated ? 1 : 0;
      proofs += result.verdict == Verdict::Proved ? 1 : 0;
    }
  }
  std::cout << loops << " violated, " << proofs << " proved\n";
  EXPECT_GT(loops, count / 4);
}

}  // namespace
}  // namespace rung
