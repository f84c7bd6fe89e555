#include "cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "boards/image.h"
#include "frontend/recognise.h"
#include "program_generator.h"
#include "random_run.h"
#include "smt/verify.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_witness(const Violation& run) {
  return run.obligation.goal == Goal::Reach;
}

void find_runs(const Loaded& loaded, std::vector<Violation>& runs) {
  VerifyOptions options;
  options.budget.seconds = 20;
  const VerifyReport report =
      verify(loaded.program, loaded.properties, options);
  EXPECT_TRUE(report.failures.empty()) << loaded.name;
  for (const ObligationResult& result : report.results) {
    const bool reached = result.verdict == Verdict::Proved &&
                         result.obligation.goal == Goal::Reach;
    if (result.verdict != Verdict::Violated && !reached) continue;
    if (!result.trace || result.trace->steps.empty()) continue;
    runs.push_back({&loaded, result.obligation, *result.trace});
  }
}

}  // namespace

bool Programs::add(const std::string& name, const std::string& text) {
  Loaded& loaded = items_.emplace_back();
  loaded.name = name;
  DiagnosticList found;
  const FileId file = loaded.sources.add(name, text);
  const std::string_view named = declared_language(text);
  const Language* const language =
      named.empty() ? &recognise(text) : find_language(named);
  bool good = language != nullptr && language->supported();
  if (good) {
    loaded.program = build_program(
        language->read(loaded.sources, file, {}, found), {}, found);
    good = !found.has_errors();
  }
  if (good) {
    loaded.properties =
        read_properties(loaded.program, {}, loaded.sources, found);
    good = !found.has_errors();
  }
  if (!good) items_.pop_back();
  return good;
}

void Programs::add_corpus() {
  add_project_corpus();
  add_corpus_of_others();
}

void Programs::add_corpus_of_others() {
  add_folder(RUNG_SOURCE_DIR "/../shared/corpus");
}

void Programs::add_project_corpus() { add_folder(RUNG_SOURCE_DIR "/corpus"); }

void Programs::add_folder(const std::string& folder) {
  if (!fs::exists(folder)) return;
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() != ".md") {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) add(path, read_file(path));
}

void Programs::add_random(std::uint64_t seed) {
  const std::vector<std::uint32_t> numbers = random_tape(seed, 600);
  Tape tape(numbers);
  const GeneratedProgram generated = generate_program(tape, {});
  add("random " + std::to_string(seed) + "\n" + generated.text,
      "//@ language script\n//@ dialect " + std::string(generated.dialect) +
          "\n" + generated.text);
}

bool make_case(const Loaded& loaded, std::uint64_t seed, std::uint64_t scans,
               Case& result) {
  const std::vector<std::uint32_t> numbers = random_tape(seed, 2000);
  Tape tape(numbers);
  result.name = loaded.name;
  result.program = &loaded.program;
  result.stimulus = scan_by_scan(random_stimulus(loaded.program, tape, scans));
  DiagnosticList found;
  const auto job = boards::make_job(loaded.program, result.stimulus, found);
  if (job) result.job = *job;
  return job.has_value();
}

bool put_program(std::span<std::uint8_t> flash, const std::string& program) {
  const auto place = boards::find_tape_place(
      {reinterpret_cast<const char*>(flash.data()), flash.size()});
  if (!place || program.size() + 4 > place->size) return false;
  flash[place->at] = static_cast<std::uint8_t>(program.size() & 0xffU);
  flash[place->at + 1] = static_cast<std::uint8_t>(program.size() >> 8U);
  std::copy(program.begin(), program.end(),
            flash.begin() + static_cast<std::ptrdiff_t>(place->at + 4));
  return true;
}

std::vector<Violation> find_violations(const Programs& programs) {
  std::vector<Violation> runs = find_runs(programs);
  std::erase_if(runs, is_witness);
  return runs;
}

std::vector<Violation> find_violations(const Loaded& loaded) {
  std::vector<Violation> runs;
  find_runs(loaded, runs);
  std::erase_if(runs, is_witness);
  return runs;
}

std::vector<Violation> find_runs(const Programs& programs) {
  std::vector<Violation> runs;
  for (const Loaded& loaded : programs.items()) {
    // What cannot be lowered runs on no board, and is not asked.
    DiagnosticList found;
    if (boards::make_job(loaded.program, {}, found)) find_runs(loaded, runs);
  }
  return runs;
}

}  // namespace rung
