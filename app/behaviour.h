#pragma once

#include <string>
#include <vector>

#include "app/lock_file.h"
#include "reports/report.h"
#include "smt/verify.h"

namespace rung {

/// What can be locked of a program, decided by verify(): the verdicts of its
/// written properties; for its outputs (bits, in groups of six, 24 at the most)
/// which combinations occur, exactly, over all reachable states; and for each
/// `after P, Q within` the least bounds. What is not decided is in `open`.
struct Behaviour {
  LockedProgram locked;
  std::vector<std::string> open;  // "`reach Q0` is unknown: ..."
  std::vector<SelfCheckFailure> failures;
};
Behaviour measure(const FileReport& report, const VerifyOptions& options);

/// Adds to the properties of a program what a lock says of it, as properties
/// that hold as long as it behaves as locked: no other combination of outputs
/// occurs, each of them still does, no response takes longer.
void add_locked(const LockedProgram& locked, FileReport& report);

/// Compares what was decided with the lock, and adds to the results what is not
/// as it was: `violated` where behaviour changed, `unknown` where that was not
/// decided. A property that the lock does not have is a note.
/// `locked` may be null: the lock does not have this program.
void compare_locked(const LockedProgram* locked, FileReport& report);

}  // namespace rung
