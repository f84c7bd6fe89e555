#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"
#include "analysis/transition_system.h"

namespace rung {

/// What is asked of a program, for other model checkers: can `bad` be true at
/// the end of a scan, when `legal` held in it and in all scans before?
///
/// Of what must hold in every scan `bad` is the violation, or a scan behind
/// which the encoding is not the program (a Fault): "no" is a proof. Of a
/// `reach` it is the goal, and such scans are not legal: "yes" is a witness.
struct ModelProblem {
  TransitionSystem ts;
  std::vector<std::string> names;  // of the obligations, all asked as one
  ExprId bad;
  ExprId legal;
  std::string error;  // why it cannot be asked
};

/// Errors: nothing asked, a kind that is no reachability, invariants together
///         with `reach`: in `error`.
ModelProblem make_problem(const Program& program, const PropertySet& properties,
                          const std::function<bool(std::string_view)>& wanted);

/// Binary AIGER of before 1.9, so that every reader has it: one output, which
/// is `bad`, latches that begin with 0, and a latch that remembers a scan that
/// was not legal. Inputs and latches are bits, named like `T(0).elapsed[3]`.
/// Source: Biere, "The AIGER And-Inverter Graph (AIG) Format", 2007.
std::string to_aiger(const ModelProblem& problem);

/// BTOR2, a word for a word: signed bit vectors that hold every value of their
/// term, so nothing overflows.
/// Source: Niemetz, Preiner, Wolf, Biere, "Btor2, BtorMC and Boolector 3.0",
///         CAV 2018.
std::string to_btor2(const ModelProblem& problem);

/// Constrained Horn clauses in SMT-LIB 2 over Bool and Int: `sat` says that
/// `bad` is never met.
std::string to_horn(const ModelProblem& problem);

}  // namespace rung
