#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/obligation.h"
#include "analysis/program.h"
#include "analysis/trace.h"
#include "analysis/transition_system.h"

namespace rung {

/// A property line, parsed and checked against the program's names.
/// The forms are those of docs/properties.md.
struct Property {
  enum class Form : std::uint8_t {
    Always,  // formulas[0] at every scan end (never is its negation)
    Never,
    Interlock,  // formulas pairwise never together; gap_ms off time
    Latch,      // Q set S reset R: formulas 0, 1, 2
    Reach,
    Recoverable,  // some run leads to formulas[0], from every reachable state
    After,        // formulas[0], then formulas[1] within scans or ms; or, if
                  // `absent`, none for so long
    For,          // formulas[0] for ms implies formulas[1]
    OnlyAfter,    // formulas[0] only after formulas[1]
    Settles,      // at rest, outputs stop changing within scans; formulas are
                  // the outputs' names
    Eventually,   // formulas[0], again and again, if the others are so, too
  };
  // Built-in properties are of the form Reach.
  Form form = Form::Always;
  std::string name;  // given, or made from the form and the line
  std::string text;  // the line, without //@
  SourceRange where;
  std::vector<std::string> formulas;  // texts, parsed again where needed
  std::int64_t milliseconds = -1;     // gap, within, for; -1: none
  std::int64_t scans = -1;            // within N scans; -1: none
  bool dominant_set = false;
  bool absent = false;  // After: no formulas[1], instead of one in time
  bool built_in = false;
};

/// `//@ expect NAME VERDICT`: what a test of the file wants to be told. It
/// changes nothing in what is checked.
struct Expectation {
  std::string obligation;  // "NAME", "NAME.holds", "builtin.Q0.settable"
  std::string verdict;     // as to_string(Verdict)
  SourceRange where;
};

/// What an `//@ input` line says of the device behind a bit.
struct Wiring {
  CellId cell;
  bool normally_closed = false;  // `nc`: a cut wire reads as it does: false
  bool trip = false;   // `trip`: active, it has to stop what it breaks
  bool reset = false;  // `reset`: the button that acknowledges a trip
  SourceRange where;
};

/// All that the property lines of a program say.
struct PropertySet {
  std::vector<Property> properties;
  std::vector<std::string> assumptions;  // formulas over inputs
  std::vector<Expectation> expectations;
  std::vector<Wiring> wirings;
};

/// Reads the annotations of `program` (and `extra`, the lines of a --props
/// file). `input`, `output` and `scan` lines change the program's cells and
/// scan interval; the clock caps of instances are raised as properties need.
/// Built-in properties are appended after the written ones.
/// Errors: unknown words or names, type errors, statements that have no
///         engine yet: RP0xx to `sink`, all of them in one run.
PropertySet read_properties(Program& program,
                            const std::vector<AstAnnotation>& extra,
                            const SourceSet& sources, DiagnosticSink& sink);

/// Adds the monitors of all properties to `ts` and returns what is to be
/// decided, in the order of the properties. Those that ask what settles are of
/// build_freezing_system(), all others of build_transition_system(), and each
/// is left out of the other.
std::vector<Obligation> make_obligations(const Program& program,
                                         const PropertySet& properties,
                                         TransitionSystem& ts);

/// Decides obligation (property, part) on one run by executing it: the
/// independent reading of the property, over the simulator's scans.
struct Replay {
  Trace trace;
  /// Scan (from 1) at whose end an invariant's condition is first false, or
  /// that of any other obligation first true; 0 when never in this run.
  std::uint64_t decided_at = 0;
  /// The last such scan of the run; not defined for an invariant.
  std::uint64_t last_at = 0;
  bool assumptions_hold = true;  // the assumptions held in every scan
};
Replay replay(const Program& program, const PropertySet& properties,
              std::uint32_t property, std::uint32_t part,
              const Stimulus& stimulus);

/// The same for many obligations, executing the run once: a plant has
/// thousands of outputs whose witnesses are one run.
/// Limits: linear in the program and in the targets.
struct ReplayTarget {
  std::uint32_t property = 0;
  std::uint32_t part = 0;
  /// Not the obligation but its trigger: when it is true. Of `eventually`, the
  /// part-th (from 0) of its `given fair`.
  bool trigger = false;
};
struct ReplayAll {
  std::vector<std::uint64_t> decided_at;  // by target, as Replay::decided_at
  std::vector<std::uint64_t> last_at;     // by target, as Replay::last_at
  bool assumptions_hold = true;
};
ReplayAll replay_all(const Program& program, const PropertySet& properties,
                     const std::vector<ReplayTarget>& targets,
                     const Stimulus& stimulus);

}  // namespace rung
