// The longest and the shortest response in small random programs, held against
// a search of all their states.
//
// RUNG_ORACLE_BOUNDS: how many questions (40 unless set; CI sets 100, a
// nightly run 1,000). RUNG_AGREEMENT_SEED: the first program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/response.h"
#include "bound_search.h"
#include "frontend/recognise.h"
#include "property_generator.h"
#include "random_run.h"
#include "shrink_tape.h"
#include "smt/bound.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr std::size_t kMaxStates = 3'000;

struct Outcome {
  bool searched = false;
  int exact = 0;      // times that are exact
  int unbounded = 0;  // or there is none
  int open = 0;       // or it was not found out
  std::string text;
  std::string wrong;
};

std::uint64_t wanted_questions() { return setting("RUNG_ORACLE_BOUNDS", 40); }

PropertySet reaches(const std::vector<std::string>& formulas) {
  PropertySet set;
  for (const std::string& formula : formulas) {
    Property property;
    property.form = Property::Form::Reach;
    property.name = "reach" + std::to_string(set.properties.size());
    property.formulas = {formula};
    set.properties.push_back(std::move(property));
  }
  return set;
}

std::string shown(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : "none";
}

/// Is what is said of one number wrong?
std::string judge(const SpanBound& bound,
                  const std::optional<std::int64_t>& truth) {
  switch (bound.kind) {
    case SpanBound::Kind::Exact:
      return truth == bound.at_least ? "" : "exact " + shown(bound.at_least);
    case SpanBound::Kind::Unbounded:
      return truth ? "unbounded" : "";
    case SpanBound::Kind::Between:
      if (truth && *truth < bound.at_least) {
        return "at least " + shown(bound.at_least);
      }
      return bound.at_most && (!truth || *truth > *bound.at_most)
                 ? "at most " + shown(bound.at_most)
                 : "";
  }
  return "";
}

/// The best that never comes has no upper bound to be wrong about.
void count(const SpanBound& bound, Outcome& outcome) {
  if (bound.kind == SpanBound::Kind::Exact) ++outcome.exact;
  if (bound.kind == SpanBound::Kind::Unbounded) ++outcome.unbounded;
  if (bound.kind == SpanBound::Kind::Between) ++outcome.open;
}

void compare(const ResponseBounds& found, const Extremes& truth,
             Outcome& outcome) {
  const bool said = found.cause == ResponseBounds::Reach::Yes;
  if (said != truth.cause) {
    outcome.wrong = said ? "a P is made up" : "a P is missed";
    return;
  }
  if (!said) return;
  constexpr const char* kUnits[] = {" ms", " scans"};
  for (int unit = 0; unit < 2; ++unit) {
    const std::string worst = judge(found.worst[unit], truth.worst[unit]);
    const std::string best = judge(found.best[unit], truth.best[unit]);
    count(found.worst[unit], outcome);
    count(found.best[unit], outcome);
    if (!worst.empty()) {
      outcome.wrong = "worst is said to be " + worst + kUnits[unit] +
                      ", and is " + shown(truth.worst[unit]);
    } else if (!best.empty()) {
      outcome.wrong = "best is said to be " + best + kUnits[unit] +
                      ", and is " + shown(truth.best[unit]);
    }
  }
}

/// Holds one question against the search; nothing when there is too much to
/// search.
void hold_against_search(Program& program, const PropertySet& properties,
                         const std::string& question, Outcome& outcome) {
  SourceSet texts;
  const FileId file = texts.add("question", question);
  DiagnosticList refused;
  const auto asked =
      read_response(program, Slice{texts[file].text(), {file, 0, 0}}, refused);
  if (!asked) return;
  TransitionSystem ts = build_transition_system(program);
  PropertySet set = reaches({asked->cause, asked->response, rise_of(*asked)});
  set.assumptions = properties.assumptions;
  const StateSearch search =
      search_states(ts, make_obligations(program, set, ts), kMaxStates);
  if (!search.complete || !search.runs) return;
  outcome.searched = true;
  VerifyOptions options;
  options.budget.seconds = 1;
  options.budget.max_depth = 40;
  const ResponseBounds found =
      find_bounds(program, properties, *asked, options);
  if (!found.failures.empty()) {
    outcome.wrong = found.failures.front().what;
    return;
  }
  compare(found, find_extremes(search), outcome);
}

Outcome check(const std::vector<std::uint32_t>& numbers) {
  Tape tape(numbers);
  Outcome outcome;
  const GeneratorOptions small = {
      .max_rungs = 3, .inputs = 2, .words = false, .long_presets = false};
  const GeneratedProgram generated = generate_program(tape, small);
  std::string error;
  const auto bare = read_program(generated.dialect, generated.text, error);
  if (!bare) return outcome;
  std::string lines =
      tape.pick(2) == 0 ? "//@ scan 10..10 ms\n" : "//@ scan 9..11 ms\n";
  if (tape.pick(3) == 1) lines += generate_assumption(bare->program, tape);
  const std::string question = generate_question(bare->program, tape);
  outcome.text = lines + generated.text + "// " + question + "\n";
  auto read = read_program(generated.dialect, lines + generated.text, error);
  if (!read) return outcome;
  hold_against_search(read->program, read->properties, question, outcome);
  return outcome;
}

/// An example program with scans of 10 ms; no value for what cannot be
/// searched.
std::optional<ReadProgram> example(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  ReadProgram read;
  DiagnosticList found;
  const FileId file = read.sources.add(path.filename().string(), text.str());
  const Ast ast =
      recognise(read.sources[file].text()).read(read.sources, file, {}, found);
  read.program = build_program(ast, {}, found);
  if (found.has_errors()) return std::nullopt;
  read.properties = read_properties(read.program, {}, read.sources, found);
  if (found.has_errors()) return std::nullopt;
  read.program.scan = {10, 10};
  const bool words = std::any_of(
      read.program.cells.begin(), read.program.cells.end(),
      [](const Cell& cell) {
        return cell.role == CellRole::Input && cell.type == Type::Word;
      });
  if (words) return std::nullopt;
  return read;
}

/// From each of some inputs to each of some outputs.
std::vector<std::string> questions_about(const Program& program) {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  for (const Cell& cell : program.cells) {
    if (cell.type != Type::Bit) continue;
    if (cell.role == CellRole::Input) inputs.push_back(cell.name);
    if (cell.role == CellRole::Output) outputs.push_back(cell.name);
  }
  std::vector<std::string> questions;
  const std::size_t most = wanted_questions() < 100 ? 1 : 2;
  for (std::size_t i = 0; i < inputs.size() && i < most; ++i) {
    for (std::size_t j = 0; j < outputs.size() && j < most; ++j) {
      questions.push_back("rose(" + inputs[i] + ") -> " + outputs[j]);
      questions.push_back(inputs[i] + " -> " + outputs[j] + " || !" +
                          inputs[i]);
    }
  }
  return questions;
}

TEST(BoundOracle, TimesOfTheExamplesAreRight) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           RUNG_SOURCE_DIR "/corpus")) {
    if (entry.path().extension() == ".rung") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  int programs = 0;
  Outcome all;
  for (const std::filesystem::path& path : paths) {
    auto read = example(path);
    if (!read) continue;
    bool any = false;
    for (const std::string& question : questions_about(read->program)) {
      Outcome outcome;
      hold_against_search(read->program, read->properties, question, outcome);
      EXPECT_EQ(outcome.wrong, "") << path << ": " << question;
      any = any || outcome.searched;
      if (!outcome.searched) break;
      all.exact += outcome.exact;
      all.unbounded += outcome.unbounded;
      all.open += outcome.open;
    }
    programs += any ? 1 : 0;
  }
  std::cout << programs << " of " << paths.size() << " programs searched, "
            << all.exact << " exact, " << all.unbounded << " unbounded, "
            << all.open << " open\n";
  EXPECT_GT(programs, 5);
  EXPECT_GT(all.exact, 0);
}

TEST(BoundOracle, NoTimeIsWrong) {
  const std::uint64_t wanted = wanted_questions();
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::uint64_t searched = 0;
  Outcome all;
  for (std::uint64_t seed = first; searched < wanted; ++seed) {
    ASSERT_LT(seed - first, 100 + 4 * wanted) << "too few can be searched";
    const std::vector<std::uint32_t> tape = random_tape(seed, 300);
    const Outcome outcome = check(tape);
    searched += outcome.searched ? 1 : 0;
    all.exact += outcome.exact;
    all.unbounded += outcome.unbounded;
    all.open += outcome.open;
    if (outcome.wrong.empty()) continue;
    const Outcome smallest = check(shrink_tape(
        tape,
        [](const std::vector<std::uint32_t>& shorter) {
          return !check(shorter).wrong.empty();
        },
        300));
    FAIL() << "seed " << seed << ": " << outcome.wrong
           << "\nThe smallest program with a wrong time:\n"
           << smallest.text << smallest.wrong;
  }
  std::cout << searched << " questions, of whose numbers " << all.exact
            << " are exact, " << all.unbounded << " unbounded, " << all.open
            << " open\n";
  EXPECT_GT(all.exact, 0);
  EXPECT_GT(all.unbounded, 0);
}

}  // namespace
}  // namespace rung
