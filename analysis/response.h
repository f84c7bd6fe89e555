#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/program.h"
#include "analysis/property_line.h"
#include "analysis/result.h"
#include "analysis/trace.h"
#include "base/diagnostic.h"

namespace rung {

/// `P -> Q` as `rungproof bound` asks it: how long after P may Q come, and how
/// soon?
struct ResponseQuestion {
  std::string cause;
  std::string response;
};

/// Reads `P -> Q` and checks both as formulas of a property of `program`, whose
/// clock caps are raised as that needs.
/// Errors: no value, and RP06x in `sink`.
std::optional<ResponseQuestion> read_response(Program& program,
                                              const Slice& text,
                                              DiagnosticSink& sink);

/// P becomes true: it is true at this scan's end, and was not at the end of a
/// scan before.
std::string rise_of(const ResponseQuestion& question);

/// How long something takes.
struct Span {
  std::int64_t milliseconds = 0;
  std::int64_t scans = 0;
};
enum class SpanUnit : std::uint8_t { Milliseconds, Scans };
inline std::int64_t in(const Span& span, SpanUnit unit) {
  return unit == SpanUnit::Milliseconds ? span.milliseconds : span.scans;
}

/// One wait of a run, and the scan (from 1) at whose end it is over.
struct Wait {
  Span span;
  std::uint64_t end = 0;  // 0: there is none
};

/// The waits of one run, as the simulator has them; by SpanUnit.
struct Waits {
  /// From the first P that no Q has answered, to that answer; or to where the
  /// run ends, or the last scan before one that the assumptions forbid.
  Wait longest[2];
  /// From a rise of P to the Q behind it.
  Wait shortest[2];
  bool open = false;  // the run ends without an answer
  bool valid = true;  // assumptions held, and the run was not too long
};
/// `limit`: scans that are executed at most; those in which only time passes do
/// not count.
Waits measure_waits(const Program& program,
                    const std::vector<std::string>& assumptions,
                    const ResponseQuestion& question, const Stimulus& stimulus,
                    std::uint64_t limit);

/// The run goes on with the inputs of its last scan: until Q comes, or nothing
/// can change any more. `limit`: scans that are executed for that at most.
struct Held {
  enum class End : std::uint8_t {
    Answered,
    Never,    // nothing changes any more: Q never comes
    Unknown,  // the limit, or an assumption that does not hold
  };
  End end = End::Unknown;
  Stimulus stimulus;  // with the scans that were added
};
Held hold(const Program& program, const std::vector<std::string>& assumptions,
          const ResponseQuestion& question, Stimulus stimulus,
          std::int64_t dt_ms, std::uint64_t limit);

/// What is known of the longest or of the shortest response, in one unit.
struct SpanBound {
  enum class Kind : std::uint8_t {
    Exact,      // shown by `trace`, and proved that there is no worse (better)
    Unbounded,  // Q need not come, or never does
    Between,    // at_least .. at_most; `reason` says why no more is known
  };
  Kind kind = Kind::Between;
  std::int64_t at_least = 0;
  std::optional<std::int64_t> at_most;  // no value: nothing was proved
  std::string engine;                   // of the proof
  std::string reason;
  std::optional<Certificate> certificate;
  std::optional<Trace> trace;  // of the response that takes at_least (best:
                               // at_most), or of one that never comes
};

/// The answer of `rungproof bound`.
struct ResponseBounds {
  enum class Reach : std::uint8_t { Yes, No, Unknown };
  Reach cause = Reach::Unknown;  // can P be true?
  std::string reason;            // where `cause` is not Yes
  SpanBound worst[2];            // by SpanUnit
  SpanBound best[2];
  std::vector<SelfCheckFailure> failures;
};

}  // namespace rung
