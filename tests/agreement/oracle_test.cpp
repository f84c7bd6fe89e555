// Verdicts on random properties of small random programs, held against a
// search of all their states.
//
// RUNG_ORACLE_PROPERTIES: how many property lines (200 unless set; CI sets
// 2,000). RUNG_ORACLE_LIVENESS: how many of `settles`, and of `eventually` (200
// unless set; CI sets 500; 4,000 are a thousand programs, two minutes).
// RUNG_AGREEMENT_SEED: the first program.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "fair_cycles.h"
#include "frontend/recognise.h"
#include "property_generator.h"
#include "random_run.h"
#include "rest_search.h"
#include "shrink_tape.h"
#include "smt/liveness_questions.h"
#include "smt/verify.h"
#include "state_search.h"
#include "tests/setting.h"

namespace rung {
namespace {

constexpr int kLines = 4;
constexpr std::size_t kMaxStates = 20'000;

struct Outcome {
  bool searched = false;  // read, and its states are few enough
  std::array<std::uint32_t, 5> verdicts = {};  // by Verdict
  std::uint32_t longer = 0;   // traces that are not the shortest
  std::uint32_t vacuous = 0;  // proved, and not found vacuous in the budget
  std::string text;
  std::string wrong;
};

/// What is wrong with a result, if its verdict or its trace is.
std::string judge(const ObligationResult& result, std::uint64_t decided_at) {
  const bool reach = result.obligation.goal == Goal::Reach;
  const bool decided = decided_at != 0;
  const std::string shortest = std::to_string(decided_at);
  switch (result.verdict) {
    case Verdict::Proved:
      if (reach != decided) return "but the state search says otherwise";
      break;
    case Verdict::Violated:
      if (reach == decided) return "but the state search says otherwise";
      break;
    case Verdict::Bounded:
      if (decided && decided_at <= result.scans) {
        return "for " + std::to_string(result.scans) +
               " scans, but it is decided after " + shortest;
      }
      return {};
    case Verdict::Vacuous:
      return decided ? "but it is decided after " + shortest : "";
    case Verdict::Unknown:
      return {};
  }
  if (decided && result.scans < decided_at) {
    return "after " + std::to_string(result.scans) +
           " scans, but it takes at least " + shortest;
  }
  return {};
}

/// What the lines of a program are.
enum class Lines : std::uint8_t { Any, Recoverable, Settles, Eventually };

constexpr std::uint32_t kMostScans = 4;  // of a `settles` line

std::string random_formula(const Program& program, Tape& tape) {
  constexpr std::string_view kLead = "//@ recoverable ";
  std::string line = generate_recoverable(program, tape);
  line.pop_back();
  return line.substr(kLead.size());
}

/// With a `reach` line for each of its parts, whose terms owe nothing to it.
std::string random_eventually(Tape& tape, const Program& program, int number) {
  const std::string id = std::to_string(number);
  const std::string goal = random_formula(program, tape);
  std::string line = "//@ e" + id + ": eventually " + goal;
  std::string parts = "//@ p" + id + ": reach " + goal + "\n";
  const std::uint32_t fair = tape.pick(3);
  for (std::uint32_t i = 0; i < fair; ++i) {
    const std::string formula = random_formula(program, tape);
    line += (i == 0 ? " given fair " : ", ") + formula;
    parts += (i == 0 ? "//@ f" : "//@ g") + id + ": reach " + formula + "\n";
  }
  return line + "\n" + parts;
}

std::string random_line(Tape& tape, Lines what, const Program& program,
                        int number) {
  switch (what) {
    case Lines::Eventually:
      return random_eventually(tape, program, number);
    case Lines::Any:
      break;
    case Lines::Recoverable:
      return generate_recoverable(program, tape);
    case Lines::Settles:
      return "//@ settles within " +
             std::to_string(1 + tape.pick(1 + tape.pick(kMostScans))) +
             " scans\n";
  }
  return generate_property(program, tape, PropertyTimes::Short);
}

std::string random_text(Tape& tape, Lines what, std::string_view& dialect) {
  const GeneratorOptions small = {
      .max_rungs = 3, .inputs = 2, .words = false, .long_presets = false};
  const GeneratedProgram generated = generate_program(tape, small);
  dialect = generated.dialect;
  std::string error;
  const auto bare = read_program(dialect, generated.text, error);
  if (!bare) return {};
  std::string lines =
      tape.pick(2) == 0 ? "//@ scan 10..10 ms\n" : "//@ scan 10..11 ms\n";
  if (tape.pick(2) == 1) lines += generate_assumption(bare->program, tape);
  for (int i = 0; i < kLines; ++i) {
    lines += random_line(tape, what, bare->program, i);
  }
  return lines + generated.text;
}

/// The conditions of an `eventually` line among those of its `reach` lines.
struct FairGoal {
  std::uint64_t goal = 0;
  std::uint64_t fair = 0;
};
FairGoal fair_goal(const std::string& name,
                   const std::vector<Obligation>& obligations) {
  const std::string number = name.substr(1);
  FairGoal found;
  for (std::size_t i = 0; i < obligations.size(); ++i) {
    const std::string& other = obligations[i].name;
    if (other == "p" + number) found.goal = std::uint64_t{1} << i;
    if (other == "f" + number || other == "g" + number) {
      found.fair |= std::uint64_t{1} << i;
    }
  }
  return found;
}

std::string judge_eventually(const ObligationResult& result,
                             const std::vector<Obligation>& obligations,
                             const StateSearch& search) {
  const auto [goal, fair] = fair_goal(result.obligation.name, obligations);
  const bool loops = has_fair_cycle(search, goal, fair);
  const bool any = has_fair_cycle(search, 0, fair);
  switch (result.verdict) {
    case Verdict::Proved:
      if (loops) return "but there is a loop without it";
      return any || !result.reason.empty() ? "" : "but no run is fair";
    case Verdict::Violated:
      return loops ? "" : "but there is no such loop";
    case Verdict::Vacuous:
      return any ? "but there is a fair run" : "";
    case Verdict::Bounded:
      return "which it cannot be";
    case Verdict::Unknown:
      break;
  }
  return {};
}

/// Decides the lines of a program, `what` of them, and holds what is said of
/// them against the search.
void hold(const Program& program, const PropertySet& properties, Lines what,
          std::size_t max_states, Outcome& outcome) {
  TransitionSystem ts = build_transition_system(program);
  const std::vector<Obligation> obligations =
      make_obligations(program, properties, ts);
  const StateSearch search = search_states(ts, obligations, max_states);
  if (!search.complete || !search.runs) return;
  outcome.searched = true;

  // An answer that takes longer is no wrong answer.
  VerifyOptions options;
  options.budget.seconds = 1;
  options.budget.max_depth = 40;
  const VerifyReport report = verify(program, properties, options);
  if (!report.failures.empty()) {
    outcome.wrong = report.failures.front().obligation + ": " +
                    report.failures.front().what;
    return;
  }
  Program stoppable = program;  // its terms know that dt may be 0
  stoppable.scan.min_ms = 0;
  TransitionSystem stopped = build_transition_system(stoppable);
  make_obligations(stoppable, properties, stopped);
  const std::vector<std::uint64_t> rest =
      search_rest(program, stopped, search, kMostScans);
  std::size_t place = 0;  // among the obligations of runs in which time passes
  for (const ObligationResult& result : report.results) {
    const Property& property =
        properties.properties[result.obligation.property];
    const bool settles = property.form == Property::Form::Settles;
    const std::size_t i = settles ? place : place++;
    if (i >= obligations.size()) break;
    const std::uint64_t decided_at =
        settles ? rest[static_cast<std::size_t>(property.scans)]
                : search.decided_at[i];
    const bool responds = property.form == Property::Form::Eventually;
    if (what == Lines::Settles && !settles) continue;
    if (what == Lines::Eventually && !responds) continue;
    ++outcome.verdicts[static_cast<std::size_t>(result.verdict)];
    const bool has_trace = result.trace.has_value();
    const bool at_a_scan = !responds;
    if (has_trace && at_a_scan && result.scans > decided_at) ++outcome.longer;
    if (result.verdict == Verdict::Proved && at_a_scan && !settles &&
        !search.triggered[i]) {
      ++outcome.vacuous;
    }
    const std::string wrong =
        responds ? judge_eventually(result, obligations, search)
                 : judge(result, decided_at);
    if (wrong.empty()) continue;
    outcome.wrong = "`" + result.obligation.text + "` (" +
                    result.obligation.name + ") is " +
                    std::string(to_string(result.verdict)) + " by " +
                    result.engine + " " + wrong;
  }
  if (place != obligations.size()) outcome.wrong = "a result is missing";
}

Outcome check(const std::vector<std::uint32_t>& numbers, Lines what) {
  Tape tape(numbers);
  Outcome outcome;
  std::string_view dialect;
  outcome.text = random_text(tape, what, dialect);
  std::string error;
  const auto read = read_program(dialect, outcome.text, error);
  if (!read) return outcome;
  hold(read->program, read->properties, what, kMaxStates, outcome);
  return outcome;
}

void hold_against_search(Lines what, std::uint64_t lines) {
  const std::uint64_t first = setting("RUNG_AGREEMENT_SEED", 1);
  std::array<std::uint32_t, 5> verdicts = {};
  std::uint32_t longer = 0;
  std::uint32_t vacuous = 0;
  std::uint64_t searched = 0;
  std::uint64_t seed = first;
  for (; searched * kLines < lines; ++seed) {
    ASSERT_LT(seed - first, 100 + lines) << "too few programs can be searched";
    const std::vector<std::uint32_t> tape = random_tape(seed, 300);
    const Outcome outcome = check(tape, what);
    searched += outcome.searched ? 1 : 0;
    longer += outcome.longer;
    vacuous += outcome.vacuous;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      verdicts[i] += outcome.verdicts[i];
    }
    if (outcome.wrong.empty()) continue;
    const Outcome smallest =
        check(shrink_tape(
                  tape,
                  [what](const std::vector<std::uint32_t>& shorter) {
                    return !check(shorter, what).wrong.empty();
                  },
                  300),
              what);
    FAIL() << "seed " << seed << ": " << outcome.wrong
           << "\nThe smallest program with a wrong verdict:\n"
           << smallest.text << smallest.wrong;
  }
  std::cout << searched << " of " << seed - first << " programs searched\n";
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    std::cout << to_string(static_cast<Verdict>(i)) << ": " << verdicts[i]
              << "\n";
  }
  std::cout << "traces that are not the shortest: " << longer
            << "\nproved, and not found vacuous in time: " << vacuous << "\n";
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Proved)], 0U);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Violated)], 0U);
}

TEST(Oracle, NoVerdictIsWrong) {
  hold_against_search(Lines::Any, setting("RUNG_ORACLE_PROPERTIES", 200));
}

TEST(Oracle, NoWayBackIsMissedOrMadeUp) {
  hold_against_search(Lines::Recoverable,
                      setting("RUNG_ORACLE_PROPERTIES", 200));
}

TEST(Oracle, WhatComesAgainAndAgainIsOnEveryFairCycle) {
  hold_against_search(Lines::Eventually, setting("RUNG_ORACLE_LIVENESS", 200));
}

TEST(Oracle, WhatSettlesIsWhatComesToRest) {
  hold_against_search(Lines::Settles, setting("RUNG_ORACLE_LIVENESS", 200));
}

/// Which of the questions that liveness is turned into have the answer "no
/// scan ends so", by a search of all states; each but the last only suffices.
struct Questioned {
  std::string name;
  std::uint32_t shown = 0;  // of the lines where there is no loop
};

void hold_questions(const std::vector<std::uint32_t>& numbers,
                    std::vector<Questioned>& kinds) {
  constexpr std::size_t kFew = 3'000;
  Tape tape(numbers);
  std::string_view dialect;
  const std::string text = random_text(tape, Lines::Eventually, dialect);
  std::string error;
  const auto read = read_program(dialect, text, error);
  if (!read) return;
  TransitionSystem ts = build_transition_system(read->program);
  const std::vector<Obligation> obligations =
      make_obligations(read->program, read->properties, ts);
  const StateSearch search = search_states(ts, obligations, kFew);
  if (!search.complete) return;
  for (const Obligation& one : obligations) {
    if (one.goal != Goal::Respond) continue;
    const auto [goal, fair] = fair_goal(one.name, obligations);
    const bool loops = has_fair_cycle(search, goal, fair);
    const Recurrence asked = {one.condition, one.trigger};
    LivenessQuestion questions[] = {
        ask_response(ts, asked, 25), ask_count(ts, asked, 0, 2),
        ask_count(ts, asked, 25, 1), ask_loop(ts, asked, Loops::OfBits),
        ask_loop(ts, asked, Loops::Exactly)};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      Obligation never;
      never.condition = questions[i].ts.exprs.negation(questions[i].bad);
      const StateSearch answer = search_states(questions[i].ts, {never}, kFew);
      if (!answer.complete) continue;
      const bool shown = answer.decided_at[0] == 0;
      if (shown) ++kinds[i].shown;
      EXPECT_FALSE(shown && loops) << kinds[i].name << "\n" << text << one.name;
      const bool exact = i + 1 == kinds.size();
      EXPECT_FALSE(exact && !shown && !loops) << text << one.name;
    }
  }
}

TEST(Oracle, EachLivenessQuestionIsSound) {
  std::vector<Questioned> kinds = {
      {"response"}, {"count"}, {"count in time"}, {"loops of bits"}, {"loops"}};
  const std::uint64_t count = setting("RUNG_ORACLE_LIVENESS", 200) / 2;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    hold_questions(random_tape(seed, 300), kinds);
    if (HasFailure()) break;
  }
  for (const Questioned& kind : kinds) {
    std::cout << kind.name << ": " << kind.shown << "\n";
    EXPECT_GT(kind.shown, 0U) << kind.name;
  }
}

/// Lines about the first two outputs of a program, and its first input.
std::string lines_about(const Program& program) {
  std::string lines =
      "scan 10 ms\nsettles within 1 scan\n"
      "settles within 2 scans\nsettles within 4 scans\n";
  std::string input;
  for (const Cell& cell : program.cells) {
    if (cell.role == CellRole::Input) input = cell.name;
    if (!input.empty()) break;
  }
  int number = 0;
  for (const Cell& cell : program.cells) {
    if (cell.role != CellRole::Output || cell.type != Type::Bit) continue;
    for (const char* const sign : {"", "!"}) {
      const std::string id = std::to_string(number++);
      const std::string goal = sign + cell.name;
      lines += "e" + id + ": eventually " + goal;
      if (*sign == '\0' && !input.empty()) lines += " given fair " + input;
      lines += "\np" + id + ": reach " + goal + "\n";
      if (*sign == '\0' && !input.empty()) {
        lines += "f" + id + ": reach " + input + "\n";
      }
    }
    if (number == 4) break;
  }
  return lines;
}

/// Its words are few, and so are its inputs and timers.
bool is_small(const Program& program) {
  int inputs = 0;
  for (const Cell& cell : program.cells) {
    if (cell.role != CellRole::Input) continue;
    if (cell.type == Type::Word) return false;
    ++inputs;
  }
  std::int64_t times = 0;
  for (const Instance& instance : program.instances) {
    times += std::max<std::int64_t>(instance.largest_parameter, 0);
  }
  return inputs <= 5 && times <= 5'000 && program.rungs.size() <= 40;
}

/// No value when it is refused, or too large to be searched.
std::optional<Outcome> check_file(const std::filesystem::path& path,
                                  Lines what) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const Language& language = recognise(text);
  if (!language.supported()) return std::nullopt;
  SourceSet sources;
  DiagnosticList found;
  const FileId file = sources.add(path.string(), text);
  Program program =
      build_program(language.read(sources, file, {}, found), {}, found);
  if (found.has_errors() || !is_small(program)) return std::nullopt;
  program.annotations.clear();
  Outcome outcome;
  outcome.text = lines_about(program);
  const FileId added = sources.add("lines.props", outcome.text);
  std::vector<AstAnnotation> lines;
  const std::string_view all = sources[added].text();
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = all.find('\n', begin);
    lines.push_back({all.substr(begin, end - begin),
                     {added, static_cast<std::uint32_t>(begin),
                      static_cast<std::uint32_t>(end)}});
    begin = end + 1;
  }
  const PropertySet properties =
      read_properties(program, lines, sources, found);
  if (found.has_errors() || properties.properties.size() > 60) {
    return std::nullopt;
  }
  constexpr std::size_t kFew = 2'000;
  hold(program, properties, what, kFew, outcome);
  if (!outcome.searched) return std::nullopt;
  return outcome;
}

/// Programs of others, where there are any. RUNG_ORACLE_FILES: how many.
void hold_files_against_search(Lines what) {
  const std::uint64_t most = setting("RUNG_ORACLE_FILES", 10);
  std::vector<std::filesystem::path> paths;
  for (const char* const folder : {"/corpus", "/../shared/corpus"}) {
    const std::string root = std::string(RUNG_SOURCE_DIR) + folder;
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(root)) {
      if (entry.is_regular_file()) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::uint64_t searched = 0;
  std::array<std::uint32_t, 5> verdicts = {};
  for (const std::filesystem::path& path : paths) {
    if (searched == most) break;
    const std::optional<Outcome> outcome = check_file(path, what);
    if (!outcome) continue;
    ++searched;
    EXPECT_EQ(outcome->wrong, "") << path;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      verdicts[i] += outcome->verdicts[i];
    }
  }
  std::cout << searched << " of " << paths.size() << " files searched\n";
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    std::cout << to_string(static_cast<Verdict>(i)) << ": " << verdicts[i]
              << "\n";
  }
  EXPECT_GT(searched, 0U);
}

TEST(Oracle, ProgramsOfOthersSettleSo) {
  hold_files_against_search(Lines::Settles);
}

TEST(Oracle, ProgramsOfOthersComeBackSo) {
  hold_files_against_search(Lines::Eventually);
}

}  // namespace
}  // namespace rung
