#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "smt/invariant.h"
#include "smt/portfolio.h"
#include "smt/region.h"
#include "smt/run.h"

namespace rung {

/// Does some run lead from every reachable state to a scan's end with a goal?
struct Recovery {
  enum class Answer : std::uint8_t {
    Recoverable,  // `invariant` shows that every scan ends with the goal or in
                  // one of `regions`, which lead there
    Stuck,        // `run` ends in a state from which `invariant` shows that no
                  // scan ever ends with the goal
    Unknown,
  };
  Answer answer = Answer::Unknown;
  std::vector<Region> regions;
  Invariant invariant;
  FoundRun run;
  std::string reason;  // Unknown
  std::string engine;
};

/// How long engines are asked.
enum class Patience : std::uint8_t { Short, Long };

/// Collects regions from which there is a way to the goal, and asks whether
/// every scan ends in one. A run that does not ends in a state from which
/// either a way is found, which makes one more region, or none exists, which
/// is shown by an invariant of the runs that start there.
///
/// `goal` is a term of a scan's end. Effort is counted in queries and
/// conflicts; the deadline is the outer limit.
class RecoverySearch {
 public:
  RecoverySearch(TransitionSystem& ts, const std::vector<ExprId>& growth,
                 ExprId goal, const PortfolioOptions& options);
  ~RecoverySearch();
  RecoverySearch(const RecoverySearch&) = delete;
  RecoverySearch& operator=(const RecoverySearch&) = delete;

  /// After Unknown it may be asked again: the regions found are kept.
  Recovery decide(Patience patience);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rung
