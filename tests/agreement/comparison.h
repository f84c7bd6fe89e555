#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/trace.h"
#include "analysis/transition_system.h"

namespace rung {

/// One random program under one random run, executed by everything that claims
/// to know what it means: the simulator, the transition system, and the
/// postfix machine on the lowered bytes.
struct Comparison {
  bool refused = false;     // the reader refused the program: not compared
  std::uint32_t scans = 0;  // compared
  std::uint32_t machine_scans = 0;  // the machine took part
  std::string text;                 // the program
  std::string difference;           // empty: all agree
};

Comparison compare(const std::vector<std::uint32_t>& tape, std::uint32_t scans);

/// What the engines are given in place of a program. The two are made from it;
/// in the tests that break the encoding, from a program that differs.
struct Encoding {
  Program program;  // its elements' `.q`, `.elapsed` and `.value`
  TransitionSystem ts;
};

/// The first difference between a run of `program` by the simulator and of
/// `encoding` by an interpreter; empty when there is none.
std::string compare_encoding(const Program& program, Encoding encoding,
                             const Stimulus& stimulus);

}  // namespace rung
