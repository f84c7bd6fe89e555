#pragma once

namespace CaDiCaL {
class Solver;
}

namespace rung {

/// For thousands of small queries on one formula. Call it before any clause.
void prepare_for_queries(CaDiCaL::Solver& solver);

}  // namespace rung
