#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/program.h"
#include "analysis/property.h"
#include "analysis/trace.h"
#include "base/source.h"
#include "program_generator.h"
#include "ts_interpreter.h"

namespace rung {

/// A generated text as the reader understands it.
struct ReadProgram {
  SourceSet sources;  // the program's views point into it
  Program program;
  PropertySet properties;  // of its `//@` lines
};
/// No value, and what was wrong in `error`, when the text is refused.
std::optional<ReadProgram> read_program(std::string_view dialect,
                                        const std::string& text,
                                        std::string& error);

/// `scans` scans or a few more: inputs that change or are held, values inside
/// their ranges, steps of time inside the scan interval; some steps are
/// repeated.
Stimulus random_stimulus(const Program& program, Tape& tape,
                         std::uint64_t scans);

/// Random inputs on a clock of 32 bits, in scans of days that make it roll
/// over, also to 0 exactly. No value: no timer of the program reads such a
/// clock. With one it is changed.
std::optional<Stimulus> rollover_stimulus(Program& program, Tape& tape,
                                          std::uint64_t scans);

/// Inputs and dt of a step.
void set_inputs(const TransitionSystem& ts, const Stimulus& stimulus,
                const StimulusStep& step, TsInterpreter& interpreter);

/// From such a scan on the encoding does not claim to be the program.
bool faulted(const TransitionSystem& ts, const TsInterpreter& interpreter);

}  // namespace rung
