// Every violation that the corpora have is executed on the emulated boards: the
// trace of its proof, scan for scan, and the property is false in the board's
// own cells at the scan of which the proof says it, and at none before.

#include <gtest/gtest.h>

#include <iostream>
#include <optional>

#include "analysis/explanation.h"
#include "analysis/formula.h"
#include "cases.h"

namespace rung {
namespace {

/// The last step of a trace may stand for many scans: its last scan gets a step
/// of its own, so that the scan before it is seen, too.
Stimulus with_last_scan_alone(Stimulus stimulus) {
  if (stimulus.steps.empty() || stimulus.steps.back().repeat == 1) {
    return stimulus;
  }
  --stimulus.steps.back().repeat;
  stimulus.steps.push_back(stimulus.steps.back());
  stimulus.steps.back().repeat = 1;
  return stimulus;
}

using Values = std::vector<std::int64_t>;  // by CellId

std::int64_t apply(FormulaOp op, std::int64_t a, std::int64_t b) {
  switch (op) {
    case FormulaOp::Not:
      return a == 0 ? 1 : 0;
    case FormulaOp::And:
      return a != 0 && b != 0 ? 1 : 0;
    case FormulaOp::Or:
      return a != 0 || b != 0 ? 1 : 0;
    case FormulaOp::Implies:
      return a == 0 || b != 0 ? 1 : 0;
    case FormulaOp::Equal:
    case FormulaOp::Equivalent:
      return a == b ? 1 : 0;
    case FormulaOp::Less:
      return a < b ? 1 : 0;
    case FormulaOp::GreaterEqual:
      return a >= b ? 1 : 0;
    default:
      ADD_FAILURE() << "an operator that the test does not know";
      return 0;
  }
}

/// A formula over cells, now and in the scan before; no value where it speaks
/// of an element. An evaluation of the test's own.
std::optional<std::int64_t> evaluate(const Program& program,
                                     const std::string& text, const Values& now,
                                     const Values& before) {
  struct Value {
    std::int64_t now = 0;
    std::int64_t before = 0;
  };
  const Formula formula = parse_formula(text);
  std::vector<Value> stack;
  for (const FormulaNode& node : formula.nodes) {
    Value a;
    Value b;
    if (node.arguments == 2) b = stack.back(), stack.pop_back();
    if (node.arguments >= 1) a = stack.back(), stack.pop_back();
    Value result{node.number, node.number};
    if (node.op == FormulaOp::Name) {
      const CellId cell = find_cell(program, node.text);
      if (!cell.has_value()) return std::nullopt;
      result = {now[cell.index()], before[cell.index()]};
    } else if (node.op == FormulaOp::Call) {
      const bool rose = a.now != 0 && a.before == 0;
      const bool fell = a.now == 0 && a.before != 0;
      if (node.text == "prev") {
        result.now = a.before;
      } else if (node.text == "rose" || node.text == "fell") {
        result.now = (node.text == "rose" ? rose : fell) ? 1 : 0;
      } else {
        return std::nullopt;
      }
    } else if (node.arguments > 0) {
      result = {apply(node.op, a.now, b.now),
                apply(node.op, a.before, b.before)};
    }
    stack.push_back(result);
  }
  return stack.back().now;
}

/// Whether the property is broken in a scan; no value where these cells alone
/// do not tell.
std::optional<bool> broken(const Program& program, const Property& property,
                           const Values& now, const Values& before) {
  using Form = Property::Form;
  const bool pairs =
      property.form == Form::Interlock && property.milliseconds <= 0;
  if (property.form != Form::Always && property.form != Form::Never && !pairs) {
    return std::nullopt;
  }
  int together = 0;
  for (const std::string& text : property.formulas) {
    const auto value = evaluate(program, text, now, before);
    if (!value) return std::nullopt;
    together += *value != 0 ? 1 : 0;
  }
  if (property.form == Form::Always) return together == 0;
  return together > (pairs ? 1 : 0);
}

Values initial_values(const Program& program) {
  Values values;
  for (const CellId id : ids_of(program.cells)) {
    values.push_back(program.cells[id].initial);
  }
  return values;
}

/// What the board's cells say of the violation; empty: what the proof says.
std::string judge(const Violation& violation, const Case& test,
                  const Execution& execution, bool& by_cells) {
  const Program& program = *test.program;
  const Property& property =
      violation.loaded->properties.properties[violation.obligation.property];
  if (execution.refusal != 0) return "it is refused";
  if (execution.fault != 0) return "it stops";
  Values before = initial_values(program);
  for (std::size_t i = 0; i < execution.values.size(); ++i) {
    const Values& values = execution.values[i];
    const bool last = i + 1 == execution.values.size();
    const auto now = broken(program, property, values, before);
    before = values;
    // Of a step of many scans the scan before its last is not known.
    if (!now || test.stimulus.steps[i].repeat != 1) continue;
    by_cells = by_cells || last;
    if (*now == last) continue;
    return last ? "it holds in the last scan" : "it is broken too early";
  }
  if (before == violation.trace.steps.back().values) return {};
  return "the last scan is another";
}

std::vector<Case> cases_of(const std::vector<Violation>& violations) {
  std::vector<Case> cases;
  for (const Violation& violation : violations) {
    const Program& program = violation.loaded->program;
    Case& test = cases.emplace_back();
    test.name = violation.loaded->name + ": " + violation.obligation.name;
    test.program = &program;
    test.stimulus = with_last_scan_alone(stimulus_of(program, violation.trace));
    DiagnosticList found;
    test.job = *boards::make_job(program, test.stimulus, found);
  }
  return cases;
}

std::string file_name(const Loaded& loaded) {
  return loaded.name.substr(loaded.name.rfind('/') + 1);
}

// The same of the programs of others: one that is violated has no postfix form.
TEST(BoardViolations, OfOthersOneHasTimersThatTheMachineHasNot) {
  Programs programs;
  programs.add_corpus_of_others();
  if (programs.items().empty()) GTEST_SKIP() << "no corpus of others";
  std::size_t lowered = 0;
  std::string left_out;
  for (const Loaded& loaded : programs.items()) {
    DiagnosticList found;
    if (boards::make_job(loaded.program, {}, found)) {
      ++lowered;
      continue;
    }
    ASSERT_TRUE(found.has_errors()) << loaded.name;
    const std::size_t violations = find_violations(loaded).size();
    if (violations == 0) continue;
    left_out += std::to_string(violations) + " of " + file_name(loaded) + ": " +
                found.items().front().message + "\n";
  }
  EXPECT_GE(lowered, 100U);
  EXPECT_EQ(left_out,
            "6 of belt_conveyor_wrong_rearm.L5X: the format has no element of "
            "kind `ton-logix`\n");
}

// Nothing is left out in silence: these have no postfix form.
TEST(BoardViolations, OnlyThoseOfPlcLibsPapersAreLeftOut) {
  Programs programs;
  programs.add_project_corpus();
  std::string left_out;
  for (const Loaded& loaded : programs.items()) {
    DiagnosticList found;
    if (boards::make_job(loaded.program, {}, found)) continue;
    left_out += file_name(loaded) + "\n";
  }
  EXPECT_GE(programs.items().size(), 55U);
  EXPECT_EQ(left_out,
            "plclib_conveyor.ino\n"
            "plclib_figure_1_7.il\n"
            "plclib_motors.ino\n"
            "plclib_motors_one_task.ino\n");
}

TEST(BoardViolations, AreSeenOnEveryBoardAtTheirScan) {
  Programs programs;
  programs.add_corpus();
  const std::vector<Violation> violations = find_violations(programs);
  const std::vector<Case> cases = cases_of(violations);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Obligation& obligation = violations[i].obligation;
    if (obligation.goal != Goal::Invariant) continue;
    // The simulator, which reads the property by itself, sees it there.
    const Replay seen =
        replay(*cases[i].program, violations[i].loaded->properties,
               obligation.property, obligation.part, cases[i].stimulus);
    EXPECT_EQ(seen.decided_at, violations[i].trace.steps.back().scan)
        << cases[i].name;
  }
  for (const char* const board : {"uno", "yun", "arm"}) {
    const BoardRun run = run_board(board, "replay", cases);
    const BoardRun faulty = run_board(board, "faulty", cases);
    EXPECT_EQ(run.problem + faulty.problem, "") << board;
    ASSERT_EQ(run.executions.size(), cases.size()) << board;
    ASSERT_EQ(faulty.executions.size(), cases.size()) << board;
    std::size_t by_cells = 0;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      bool judged = false;
      EXPECT_EQ(judge(violations[i], cases[i], run.executions[i], judged), "")
          << board << ": " << cases[i].name;
      by_cells += judged ? 1 : 0;
      const bool seen =
          judge(violations[i], cases[i], faulty.executions[i], judged).empty();
      missed += seen ? 0 : 1;
    }
    EXPECT_GE(cases.size(), 19U);
    EXPECT_GE(by_cells, 8U);
    EXPECT_GE(missed, 5U) << "a board with a fault shows what others show";
    std::cout << board << ": " << cases.size() << " violations, " << by_cells
              << " read off its cells; " << missed
              << " not seen with a fault\n";
  }
}

}  // namespace
}  // namespace rung
