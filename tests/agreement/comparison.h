#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace rung
