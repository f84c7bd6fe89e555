#pragma once

#include "frontend/rockwell/project.h"

namespace rung::rockwell {

/// Where the comment of a rung stands.
struct CommentPlace {
  bool main = false;   // in the main routine
  bool first = false;  // of the routine's rungs
  bool last = false;
};

/// Property lines (`@ never a && b`, each in a line of its own), and the
/// annotations of l5x2c: `<CBEFORE! a = nondet_bool(); !>` names inputs, and
/// `<CAFTER! if(a) assert(b); !>` is a property of every scan's end.
/// Errors: RP087 for anything else that they say.
void read_annotations(const Text& comment, CommentPlace place, Project& project,
                      Ast& ast, ErrorLimit& errors);

}  // namespace rung::rockwell
