#pragma once

#include <string>
#include <vector>

#include "backend/unit/unit.h"

namespace rung::backend {

/// A sample of an input at the begin of a scan.
struct Sample {
  CellId input;
  CellId image;  // the variable that keeps it; no value: nothing reads it
};

/// How the signals of a unit are those of a board.
struct Wiring {
  std::vector<std::string> pins;  // by variable: "4", "A0"; empty: no pin
  std::vector<Sample> samples;
  std::vector<std::uint32_t> reads;  // by variable: where statements read it
  bool mega = false;                 // too many pins for an Uno
  std::string error;                 // why no board has them
};

/// Gives pins to inputs and outputs. A sketch has no image of the inputs: one
/// that is read in several places is sampled into a variable, which the
/// statements of `unit` read from then on. What is a later sample of an input
/// in the source, `X0.2`, is one here.
Wiring wire(Unit& unit);

/// Why there is no sketch for the unit though it is one: arithmetic that the
/// board has not. Values that may leave a `long` on the way to the result, as
/// far as the text shows, become variables.
std::string settle_words(Unit& unit, const Wiring& wiring);

}  // namespace rung::backend
