// Random programs mean the same to the simulator, to the transition system and
// to the postfix machine: cell by cell, scan by scan.
//
// RUNG_AGREEMENT_PROGRAMS: how many (2,000 unless set; CI sets 100,000).
// RUNG_AGREEMENT_SEED: the first one, to repeat a failure.

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "comparison.h"
#include "program_generator.h"
#include "random_run.h"
#include "shrink_tape.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr std::uint32_t kScans = 50;
constexpr std::size_t kTapeLength = 600;

TEST(Agreement, RandomProgramsMeanTheSameToAll) {
  const std::uint64_t count = setting("RUNG_AGREEMENT_PROGRAMS", 2000);
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::uint64_t refused = 0;
  std::uint64_t scans = 0;
  std::uint64_t machine_scans = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const std::vector<std::uint32_t> tape = random_tape(seed, kTapeLength);
    const Comparison comparison = compare(tape, kScans);
    refused += comparison.refused ? 1 : 0;
    scans += comparison.scans;
    machine_scans += comparison.machine_scans;
    if (comparison.difference.empty()) continue;
    const Comparison smallest = compare(
        shrink_tape(tape,
                    [](const std::vector<std::uint32_t>& shorter) {
                      return !compare(shorter, kScans).difference.empty();
                    }),
        kScans);
    FAIL() << "seed " << seed << ": " << comparison.difference
           << "\nThe smallest program that differs:\n"
           << smallest.text << smallest.difference;
  }
  EXPECT_LT(refused * 20, count) << "the generator writes too many programs "
                                    "that are no programs";
  // Runs end early where a word leaves its range; most do not.
  EXPECT_GT(machine_scans, (count - refused) * kScans * 3 / 4);
  std::cout << count << " programs, " << refused << " refused, " << scans
            << " scans compared, " << machine_scans << " with the machine\n";
}

}  // namespace
}  // namespace rung
