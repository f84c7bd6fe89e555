// Proofs of random properties of random programs: the checker confirms each.
//
// RUNG_CHECK_PROGRAMS: how many programs, with four lines each (500 unless
// set; scripts/nightly: 20,000). RUNG_AGREEMENT_SEED: the first one.
// RUNG_WRITE_PROGRAMS: a folder that they are written into.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "confirm.h"
#include "program_generator.h"
#include "property_generator.h"
#include "random_run.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr std::uint64_t kTogether = 250;  // programs in one process

struct RandomProof {
  std::string_view dialect;
  std::string text;
  std::unique_ptr<ReadProgram> read;
};

RandomProof random_proof(std::uint64_t seed) {
  const std::vector<std::uint32_t> numbers = random_tape(seed, 500);
  Tape tape(numbers);
  const GeneratorOptions options = {
      .max_rungs = 4, .inputs = 3, .words = seed % 2 == 0};
  const GeneratedProgram generated = generate_program(tape, options);
  std::string error;
  const auto bare = read_program(generated.dialect, generated.text, error);
  RandomProof proof;
  proof.dialect = generated.dialect;
  if (!bare) return proof;
  if (tape.pick(3) == 2) {
    proof.text += generate_assumption(bare->program, tape);
  }
  for (int i = 0; i < 4; ++i) {
    proof.text += generate_property(bare->program, tape, PropertyTimes::Long);
  }
  proof.text += generated.text;
  auto read = read_program(generated.dialect, proof.text, error);
  if (read) proof.read = std::make_unique<ReadProgram>(std::move(*read));
  return proof;
}

/// Ways back take long to be found: not of every program.
bool is_wanted(std::string_view name, std::uint64_t seed) {
  const bool back =
      name.starts_with("recoverable") || name.ends_with(".releasable");
  return !name.starts_with("builtin.") && (!back || seed % 8 == 0);
}

struct Count {
  std::map<std::string, std::uint64_t> of;

  void add(const std::vector<check::Checked>& checked,
           const std::string& text) {
    for (const check::Checked& one : checked) {
      std::string what(to_string(one.outcome));
      if (one.outcome == check::Outcome::NotChecked) what += ": " + one.reason;
      ++of[what];
      EXPECT_NE(one.outcome, check::Outcome::Rejected)
          << one.name << ": " << one.reason << "\n"
          << text;
    }
  }
};

/// For scripts/against-abc.
void write(const RandomProof& proof, std::uint64_t seed) {
  const char* const folder = std::getenv("RUNG_WRITE_PROGRAMS");
  if (folder == nullptr) return;
  std::ofstream(std::string(folder) + "/" + std::string(proof.dialect) + "-" +
                std::to_string(seed) + ".rung")
      << proof.text;
}

void confirm(std::uint64_t first, std::uint64_t end, Count& count) {
  Confirmation confirmation;
  std::vector<RandomProof> proofs;
  for (std::uint64_t seed = first; seed < end; ++seed) {
    RandomProof proof = random_proof(seed);
    if (!proof.read) continue;
    write(proof, seed);
    // The checker is the only judge here.
    VerifyOptions options;
    options.budget.seconds = 1;
    options.budget.max_depth = 10;
    options.wanted = [seed](std::string_view name) {
      return is_wanted(name, seed);
    };
    options.self_check = false;
    const VerifyReport report =
        verify(proof.read->program, proof.read->properties, options);
    confirmation.add(proof.read->program, proof.read->properties,
                     claimed_by(report));
    proofs.push_back(std::move(proof));
  }
  const auto results = confirmation.ask();
  for (std::size_t i = 0; i < results.size(); ++i) {
    count.add(results[i], proofs[i].text);
  }
}

// The engines keep one memory for `prev(I1)` and for what the `for` remembers,
// and call it after the `for`.
TEST(RandomProofs, OfLinesThatShareAMemoryAreConfirmed) {
  std::string error;
  const auto read =
      read_program("sim",
                   "//@ assume !(I1 && I1)\n"
                   "//@ (I1 && (I1 ^ fell(M3))) for 10 ms implies M3\n"
                   "//@ reach prev(I1)\n"
                   "M3 = (true || I1);\n",
                   error);
  ASSERT_TRUE(read) << error;
  const VerifyReport report = verify(read->program, read->properties, {});
  EXPECT_EQ(unconfirmed(read->program, read->properties, report), "");
}

TEST(RandomProofs, AreConfirmed) {
  const std::uint64_t programs = setting("RUNG_CHECK_PROGRAMS", 500);
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  Count count;
  for (std::uint64_t done = 0; done < programs; done += kTogether) {
    confirm(first + done, first + std::min(done + kTogether, programs), count);
    if (HasFailure()) break;
  }
  for (const auto& [what, number] : count.of) {
    std::cout << number << " " << what << "\n";
  }
  EXPECT_GT(count.of["confirmed"], programs / 2);
}

}  // namespace
}  // namespace rung
