#pragma once

#include <string>
#include <vector>

namespace rung {

/// What a translator knows of the states of its source and of its result: a
/// guess, which helps a proof where an induction shows it and else does
/// nothing.
struct StateRelation {
  struct Name {
    std::string name;     // in `formula`
    std::string state;    // "T(0).elapsed", or a cell
    bool second = false;  // of the result, whose elements have the names of
                          // those of the source that they stand for
  };
  std::string formula;  // `x < 3 || y <-> z`, of states at a scan's end
  std::vector<Name> names;
};

}  // namespace rung
