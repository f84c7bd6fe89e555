#include "analysis/transition_system.h"

#include <gtest/gtest.h>

#include <string>

namespace rung {
namespace {

/// Builds programs by hand: the readers have tests of their own.
class SystemTest : public testing::Test {
 protected:
  CellId cell(std::string name, CellRole role) {
    return program.cells.add({.name = std::move(name), .role = role});
  }
  std::uint32_t node(Node value) {
    program.nodes.push_back(value);
    return static_cast<std::uint32_t>(program.nodes.size() - 1);
  }
  std::uint32_t read(CellId id) {
    return node({.op = NodeOp::Read, .cell = id});
  }
  void rung(CellId target, std::uint32_t begin) {
    program.rungs.add(
        {.target = target,
         .begin = begin,
         .end = static_cast<std::uint32_t>(program.nodes.size())});
  }
  std::uint32_t call(std::string_view dialect, std::string_view name,
                     std::int64_t parameter, std::uint32_t argument) {
    const FoundOperation found = find_operation(dialect, name);
    const InstanceId instance =
        program.instances.add({.kind = found.kind,
                               .name = std::string(name) + "(0)",
                               .clock_cap = parameter + 1,
                               .largest_parameter = parameter});
    const CallId id = program.calls.add({.instance = instance,
                                         .operation = found.operation,
                                         .parameter = parameter,
                                         .arguments = {argument}});
    return node({.op = NodeOp::Call, .call = id});
  }
  Program program;
};

TEST_F(SystemTest, SealInRung) {
  const CellId start = cell("I0", CellRole::Input);
  const CellId stop = cell("I1", CellRole::Input);
  const CellId motor = cell("Q0", CellRole::Output);
  const std::uint32_t both =
      node({.op = NodeOp::Or, .a = read(start), .b = read(motor)});
  const std::uint32_t no_stop = node({.op = NodeOp::Not, .a = read(stop)});
  node({.op = NodeOp::And, .a = both, .b = no_stop});
  rung(motor, 0);

  const TransitionSystem ts = build_transition_system(program);
  ASSERT_EQ(ts.states.size(), 1U);
  EXPECT_EQ(to_string(ts, ts.states[0].next), "(I0 || Q0) && !I1");
  EXPECT_EQ(ts.cell_end[motor.index()], ts.states[0].next);
}

TEST_F(SystemTest, ALaterRungSeesWhatAnEarlierOneWrote) {
  const CellId in = cell("I0", CellRole::Input);
  const CellId memory = cell("M0", CellRole::Memory);
  const CellId out = cell("Q0", CellRole::Output);
  read(in);
  rung(memory, 0);
  read(memory);
  rung(out, 1);
  const TransitionSystem ts = build_transition_system(program);
  EXPECT_EQ(to_string(ts, ts.cell_end[out.index()]), "I0");
}

TEST_F(SystemTest, ASkippedCallLeavesItsStateAlone) {
  const CellId enable = cell("I0", CellRole::Input);
  const CellId out = cell("Q0", CellRole::Output);
  const std::uint32_t left = read(enable);
  const std::uint32_t branch = node({.op = NodeOp::Branch, .a = left});
  const std::uint32_t timer = call("sim", "T", 500, read(enable));
  const std::uint32_t both = node({.op = NodeOp::And, .a = left, .b = timer});
  program.nodes[branch].target = both;
  rung(out, 0);

  const TransitionSystem ts = build_transition_system(program);
  const std::uint32_t started = ts.instance_states[0][0];
  EXPECT_EQ(to_string(ts, ts.states[started].next), "I0 || T(0).started");
  EXPECT_EQ(to_string(ts, ts.call_executed.front()), "I0");
}

TEST_F(SystemTest, EveryElementDefinitionCompiles) {
  for (const ElementKind& kind : element_kinds()) {
    for (const ElementOperation& operation : kind.operations) {
      Program one;
      const CellId in = one.cells.add({.name = "I0", .role = CellRole::Input});
      const CellId out =
          one.cells.add({.name = "Q0",
                         .type = operation.word ? Type::Word : Type::Bit,
                         .role = CellRole::Output,
                         .low = operation.word ? -32768 : 0,
                         .high = operation.word ? 32767 : 1});
      one.nodes.push_back({.op = NodeOp::Read, .cell = in});
      one.nodes.push_back(
          {.op = NodeOp::Constant, .type = Type::Word, .value = 3});
      ElementCall call = {.operation = &operation, .parameter = 3};
      for (const ElementParameter& parameter : operation.parameters) {
        if (parameter.kind == ParameterKind::Bit) call.arguments.push_back(0);
        if (parameter.kind == ParameterKind::Word) call.arguments.push_back(1);
      }
      call.instance = one.instances.add({.kind = &kind,
                                         .name = "E(0)",
                                         .clock_cap = 4,
                                         .largest_parameter = 3});
      const CallId id = one.calls.add(call);
      one.nodes.push_back({.op = NodeOp::Call,
                           .type = operation.word ? Type::Word : Type::Bit,
                           .call = id});
      one.rungs.add({.target = out, .begin = 0, .end = 3});
      const TransitionSystem ts = build_transition_system(one);
      for (const State& state : ts.states) {
        ASSERT_TRUE(state.next.has_value()) << kind.id;
        const Variable& var = ts.vars[state.var];
        if (var.type == Type::Bit) continue;
        // A clock's next value is bounded by its range term by term; counts
        // rely on their own comparison, which certificates prove.
        if (state.clock) {
          EXPECT_LE(ts.exprs[state.next].high, var.high);
        }
      }
    }
  }
}

TEST_F(SystemTest, TheConeLeavesOutWhatCannotMatter) {
  const CellId a = cell("I0", CellRole::Input);
  const CellId b = cell("I1", CellRole::Input);
  const CellId q = cell("Q0", CellRole::Output);
  const CellId r = cell("Q1", CellRole::Output);
  read(a);
  rung(q, 0);
  read(b);
  rung(r, 1);
  const TransitionSystem ts = build_transition_system(program);
  const std::vector<bool> cone =
      cone_of_influence(ts, {ts.cell_end[q.index()]});
  for (const VarId var : ids_of(ts.vars)) {
    EXPECT_EQ(cone[var.index()], ts.vars[var].name == "I0")
        << ts.vars[var].name;
  }
}

TEST_F(SystemTest, AWordThatMayLeaveItsRangeIsAFault) {
  const CellId sum = program.cells.add(
      {.name = "M0", .type = Type::Word, .low = -100, .high = 100});
  const std::uint32_t one =
      node({.op = NodeOp::Constant, .type = Type::Word, .value = 1});
  const std::uint32_t old =
      node({.op = NodeOp::Read, .type = Type::Word, .cell = sum});
  node({.op = NodeOp::Add, .type = Type::Word, .a = old, .b = one});
  rung(sum, 0);
  const TransitionSystem ts = build_transition_system(program);
  ASSERT_EQ(ts.faults.size(), 1U);
  EXPECT_EQ(ts.exprs[ts.states[0].next].high, 100);
}

}  // namespace
}  // namespace rung
