#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "lint.h"

namespace rung::testing {
namespace {

/// A small program with one mistake of a family, in a language in which it is
/// made, and all that lint says of it.
struct Seed {
  const char* family;
  const char* rule;  // finds it
  const char* also;  // other rules that are right to speak
  const char* text;
};

constexpr Seed kSeeds[] = {
    // --- writes
    {"double_coil", "double-coil", "",
     "Q0 = (I0 || Q0) && !I1;\nQ1 = I2 && !Q0;\nQ0 = I3 && !I1;\n"},
    {"double_coil_in_a_list", "double-coil", "",
     "PROGRAM main\nVAR_INPUT a : BOOL; b : BOOL; c : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; r : BOOL; END_VAR\n"
     "LD a\nST q\nLD q\nAND c\nST r\nLD b\nST q\nEND_PROGRAM\n"},
    {"dead_store", "overwritten-value", "double-coil",
     "M0 = I0 && I1;\nM0 = I2;\nQ0 = M0;\n"},
    {"coil_above_a_latch", "coil-defeats-latch", "",
     "Q0 = I0;\nQ0 = (Q0 || I1) && !I2;\n"},
    {"set_without_reset", "set-without-reset", "", "Q0 = Q0 || I0;\n"},
    {"set_without_reset_in_a_list", "set-without-reset", "",
     "PROGRAM main\nVAR_INPUT a : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; END_VAR\nLD a\nS q\nEND_PROGRAM\n"},
    {"reset_without_set", "reset-without-set", "",
     "PROGRAM main\nVAR_INPUT a : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; END_VAR\nLD a\nR q\nEND_PROGRAM\n"},
    {"stranded_bit", "reset-never-fires", "",
     "M0 = I0 && !I1;\nQ0 = Q0 || I2;\nQ0 = Q0 && !(M0 && I1);\n"},
    {"written_for_nobody", "written-never-read", "",
     "M0 = I0 && I1;\nQ0 = I2;\n"},
    // --- reads
    {"no_coil_for_a_contact", "undefined-read", "", "Q0 = I0 && M7;\n"},
    {"a_switch_that_nobody_moves", "never-assigned", "",
     "Q0 = I0 && M0;\n//Var\nM0 = true;\n"},
    {"unused_input", "unused-input", "",
     "PROGRAM main\nVAR_INPUT a : BOOL; b : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; END_VAR\nq := a;\nEND_PROGRAM\n"},
    {"timer_for_nobody", "ignored-result", "", "M0 = T(0, 1, I0);\nQ0 = I0;\n"},
    {"a_scan_late", "read-before-write", "",
     "Q0 = M0 && I1;\nM0 = (I0 && I2 || M0) && I1;\n"},
    {"shared_timer_index", "shared-index", "",
     "M0 = T(0, 1, I0);\nM1 = T(0, 2, I1);\nQ0 = M0;\nQ1 = M1;\n"},
    {"timer_called_twice", "element-called-twice", "",
     "Q0 = T(0, 1, I0) && I1;\nQ1 = T(0, 1, I0) && I2;\n"},
    {"reset_of_no_timer", "unused-element", "clock-rollover",
     "y0 = T(0, 1, pin2);\ny1 = TR(0, !pin2);\ny2 = TR(3, pin4);\n"
     "pin3 = y0;\n"},
    // --- dead logic
    {"bridged_contact", "constant-operand", "", "Q0 = I0 || true && I1;\n"},
    {"never_on", "coil-never-true", "", "M0 = I0 && !I1;\nQ0 = M0 && I1;\n"},
    {"never_off", "coil-never-false", "", "M0 = I0 && I1;\nQ0 = I0 || !M0;\n"},
    {"contact_without_effect", "redundant-contact", "",
     "M0 = I0 && I1;\nQ0 = M0 && I0 && I2;\nQ1 = M0;\n"},
    {"branch_without_effect", "redundant-branch", "",
     "M0 = I0 && I1;\nQ0 = I0 || M0 || I2;\nQ1 = M0;\n"},
    {"limit_out_of_range", "constant-comparison", "",
     "//@ input IW0 in 0..1023\nQ0 = IW0 > 1200 || I0;\nQ1 = I1;\n"},
    {"contact_and_its_inverse", "contradictory-contacts", "",
     "Q0 = I0 && I1 && !I0;\n"},
    {"window_that_is_empty", "contradictory-contacts", "",
     "Q0 = IW0 < 20 && IW0 > 50;\n"},
    {"same_rung_twice", "duplicate-rung", "",
     "Q0 = I0 && I1 && !I2;\nQ1 = I0 && I1 && !I2;\n"},
    {"commented_out", "commented-out-rung", "",
     "// Q1 = I1 && !I2;\nQ0 = I0;\n"},
    {"condition_that_is_never_met", "unreachable-rung", "",
     "PROGRAM main\nVAR_INPUT a : BOOL; b : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; r : BOOL; END_VAR\nq := a AND b;\n"
     "IF q AND NOT a THEN r := TRUE; ELSE r := b; END_IF;\n"
     "END_PROGRAM\n"},
    {"timer_cut_short", "timer-never-fires", "",
     "M0 = T(0, 2, I0);\nM1 = T(1, 5, I0 && !M0);\nQ0 = M1;\n"},
    {"timers_chained_by_a_pulse", "timer-never-fires", "",
     "M0 = T(0, 1, I0 && !M0);\nM1 = T(1, 1, M0);\nQ0 = M1;\n"},
    {"counter_cut_short", "counter-never-done", "",
     "M0 = C(0, 2, I0, false, M0);\nM1 = C(1, 3, I0, false, M0);\n"
     "Q0 = M1;\n"},
    // --- latches
    {"latch_without_a_way_out", "latch-never-released", "",
     "Q0 = (I0 || Q0) && (!I1 || Q0);\n"},
    {"start_wins", "start-dominant-latch", "", "Q0 = I0 || Q0 && !I1;\n"},
    {"set_below_reset", "set-reset-order", "",
     "Q0 = Q0 && !I1;\nQ0 = Q0 || I0;\n"},
    {"seal_in_forgotten", "missing-seal-in", "",
     "Q0 = (Q0 || I0) && !I2;\nQ1 = (Q0 || I1) && !I2;\n"},
    {"interlock_on_one_side", "one-sided-interlock", "read-before-write",
     "Q0 = (Q0 || I0) && !I2 && !Q1;\nQ1 = (Q1 || I1) && !I2;\n"},
    {"interlock_by_order", "order-dependent-interlock", "",
     "//@ interlock Q0, Q1\nQ0 = I0;\nQ1 = I1 && !Q0;\n"},
    {"cut_wire", "loss-does-not-stop", "",
     "//@ input I1 nc\nQ0 = (I0 || Q0) && !I1;\n"},
    {"reset_under_trip", "reset-while-tripped", "",
     "//@ input I1 trip\n//@ input I2 reset\n"
     "M0 = (I1 || M0) && !(I2 && !M1);\nM1 = I2;\nQ0 = I0 && !M0;\n"},
    {"overload_restarts", "automatic-restart", "",
     "//@ input I2 trip\nM0 = (I0 || M0) && !I1;\nQ0 = M0 && !I2;\n"},
    {"bridged_reset", "level-reset", "start-dominant-latch",
     "//@ input I1 trip\n//@ input I2 reset\nM0 = I1 || M0 && !I2;\n"
     "Q0 = (I0 || Q0) && !M0;\n"},
    // --- time
    {"no_preset", "zero-preset", "", "Q0 = T(0, 0, I0) && I0;\n"},
    {"preset_below_the_scan", "preset-out-of-scan", "",
     "Q0 = T(0, 0.05, I0);\n"},
    {"analog_equality", "word-equality", "", "Q0 = IW0 == 512 && I0;\n"},
    {"counter_for_ever", "counter-without-reset", "",
     "Q0 = C(0, 3, I0, false, false);\n"},
    {"timer_for_ever", "timer-without-reset", "clock-rollover",
     "pin3 = T(0, 1, pin2);\n"},
    {"edge_memory_too_early", "early-edge-memory", "",
     "M0 = I0;\nQ0 = I0 && !M0;\n"},
    {"edge_memory_for_two", "shared-edge-memory", "",
     "Q0 = I0 && !M0;\nM0 = I0;\nQ1 = I1 && !M0;\nM0 = I1;\n"},
    {"skipped_timer", "skipped-element", "", "Q0 = I0 && T(0, 5, I1);\n"},
    {"light_for_a_scan", "one-scan-pulse", "", "Q0 = T(0, 1, I0 && !Q0);\n"},
    {"edge_at_power_up", "edge-at-power-up", "preset-dependent",
     "PROGRAM main\nVAR_INPUT a : BOOL; END_VAR\n"
     "VAR_OUTPUT q : BOOL; END_VAR\nVAR edge : F_TRIG; END_VAR\n"
     "edge(CLK := a);\nq := edge.Q;\nEND_PROGRAM\n"},
    {"full_at_power_up", "done-at-power-up", "",
     "PROGRAM main\nVAR_INPUT part : BOOL; load : BOOL; END_VAR\n"
     "VAR_OUTPUT full : BOOL; END_VAR\nVAR left : CTD; END_VAR\n"
     "left(CD := part, LD := load, PV := 10);\nfull := left.Q;\n"
     "END_PROGRAM\n"},
    {"counting_scans", "level-count", "",
     "PROGRAM main\nVAR_INPUT part : BOOL; clear : BOOL; END_VAR\n"
     "VAR_OUTPUT full : BOOL; END_VAR\nVAR n : INT; END_VAR\n"
     "IF clear THEN n := 0; ELSIF part AND n < 10 THEN n := n + 1; END_IF;\n"
     "full := n >= 10;\nEND_PROGRAM\n"},
    {"response_without_stop", "response-forgets-stop", "",
     "//@ after I0, Q0 within 1 s\n"
     "Q0 = (T(0, 0.5, I0) || Q0) && !I1;\n"},
    {"fifty_days", "clock-rollover", "",
     "//@ dialect yun\ny0 = TR(0, !pin2);\npin3 = T(0, 5, pin2);\n"},
    // --- scans
    {"relay_race", "relay-race", "start-dominant-latch order-dependent",
     "M0 = I0 && !M1;\nM1 = M0 || M1 && I1;\nQ0 = M0;\n"},
    {"stop_a_scan_late", "late-trip", "read-before-write",
     "//@ input I1 nc trip\nQ0 = I0 && M0;\nM0 = I1;\n"},
    {"pulse_of_a_scan", "output-glitch", "read-before-write",
     "Q0 = I0 && !M0;\nM0 = I0 && I1;\n"},
    {"two_samples", "torn-input", "",
     "#include <plcLib.h>\nvoid setup() { setupPLC(); }\n"
     "void loop() { in(X0); out(Y0); inNot(X0); out(Y1); }\n"},
    {"one_accumulator", "shared-accumulator", "set-reset-order",
     "#include <plcLib.h>\nvoid setup() { setupPLC(); }\n"
     "void loop1(100) { load(X2); out(Y2); }\n"
     "void loop() { load(X0); set(Y0); load(X1); reset(Y0); }\n"},
};

/// The two properties of a family: found, and nothing else is said.
class SeededBug : public ::testing::TestWithParam<Seed> {};

TEST_P(SeededBug, IsFoundByItsRuleAndNothingElseIs) {
  const Seed& seed = GetParam();
  std::set<std::string> expected = {seed.rule};
  std::istringstream also(seed.also);
  for (std::string name; also >> name;) expected.insert(name);
  Linted linted;
  lint(seed.text, linted);
  std::set<std::string> found;
  for (const Diagnostic& finding : linted.findings) {
    found.insert(std::string(finding.rule));
  }
  EXPECT_EQ(found, expected) << seed.text << to_text(linted);
}

std::string family(const ::testing::TestParamInfo<Seed>& param) {
  return param.param.family;
}

INSTANTIATE_TEST_SUITE_P(Families, SeededBug, ::testing::ValuesIn(kSeeds),
                         family);

}  // namespace
}  // namespace rung::testing
