#pragma once

#include <string>

#include "analysis/program.h"
#include "analysis/simulator.h"

namespace rung {

/// A run as a value change dump (IEEE 1364-2005, clause 18), for waveform
/// viewers. Scopes `inputs`, `outputs` and `memory`; a word is a 64-bit
/// integer in two's complement.
///
/// Units: 1 ms. The values at time 0 are those before the first scan.
/// The same run gives the same bytes: there is no date in it.
std::string write_vcd(const Program& program, const Recording& recording);

}  // namespace rung
