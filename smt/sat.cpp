#include "smt/sat.h"

#include <algorithm>
#include <cadical.hpp>
#include <chrono>

#include "smt/solver_settings.h"

namespace rung {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// CaDiCaL asks at every conflict and decision; the clock costs more than
/// most of those.
class DeadlineTerminator : public CaDiCaL::Terminator {
 public:
  explicit DeadlineTerminator(const Deadline* deadline) : deadline_(deadline) {}
  bool terminate() override {
    if (deadline_ == nullptr || ++asked_ % 64 != 0) return false;
    return deadline_->passed();
  }

 private:
  const Deadline* deadline_;
  unsigned asked_ = 0;
};

}  // namespace

void prepare_for_queries(CaDiCaL::Solver& solver) {
  solver.set("quiet", 1);
  // Simplifying the formula between queries costs more than it saves.
  for (const char* option : {"inprocessing", "rephase", "lucky", "walk"}) {
    solver.set(option, 0);
  }
  // It takes the time of every call for its statistics: by the cheaper clock.
  solver.set("realtime", 1);
  solver.set("profile", 0);
}

Deadline::Deadline(double seconds, const std::atomic<bool>* stop)
    : at_ns_(now_ns() + static_cast<std::int64_t>(seconds * 1e9)),
      stop_(stop) {}

bool Deadline::passed() const {
  return now_ns() >= at_ns_ || (stop_ != nullptr && stop_->load());
}

Deadline Deadline::part(double share) const {
  const auto left = static_cast<double>(at_ns_ - now_ns());
  return Deadline(std::max(left, 0.0) * share / 1e9, stop_);
}

std::string sat_version() { return CaDiCaL::Solver::version(); }

struct Sat::Impl {
  explicit Impl(const Deadline* deadline) : terminator(deadline) {}
  CaDiCaL::Solver solver;
  DeadlineTerminator terminator;
  int variables = 0;
  bool failed = false;  // a call of the solver did not come back

  template <class Action>
  auto use(Action action) {
    failed = true;
    const auto result = action(solver);
    failed = false;
    return result;
  }
  template <class Clause>
  void add(const Clause& clause) {
    use([&](CaDiCaL::Solver& s) {
      for (int literal : clause) s.add(literal);
      s.add(0);
      return true;
    });
  }
};

Sat::Sat(const Deadline* deadline) : deadline_(deadline) {}

Sat::~Sat() {
  if (impl_ == nullptr) return;
  // After an exception, most often for want of memory, the solver ends the
  // process when it is touched again: it is left where it is.
  if (impl_->failed) {
    static_cast<void>(impl_.release());
  } else {
    impl_->solver.disconnect_terminator();
  }
}

/// The solver costs more to make than many a session to decide, and some never
/// ask it anything.
Sat::Impl& Sat::impl() const {
  if (impl_ != nullptr) return *impl_;
  impl_ = std::make_unique<Impl>(deadline_);
  CaDiCaL::Solver& solver = impl_->solver;
  prepare_for_queries(solver);
  solver.connect_terminator(&impl_->terminator);
  return *impl_;
}

int Sat::new_variable() { return ++impl().variables; }

void Sat::add(std::initializer_list<int> clause) { impl().add(clause); }

void Sat::add(const std::vector<int>& clause) { impl().add(clause); }

void Sat::assume(int literal) {
  impl().use([&](CaDiCaL::Solver& solver) {
    solver.assume(literal);
    return true;
  });
}

void Sat::constrain(const std::vector<int>& clause) {
  impl().use([&](CaDiCaL::Solver& solver) {
    for (int literal : clause) solver.constrain(literal);
    solver.constrain(0);
    return true;
  });
}

SatAnswer Sat::solve(std::int64_t conflicts) {
  const int variables = impl().variables;
  const int status = impl().use([&](CaDiCaL::Solver& solver) {
    // An unused variable must be known to the solver before value() asks it.
    solver.reserve(variables);
    if (conflicts >= 0) solver.limit("conflicts", static_cast<int>(conflicts));
    return solver.solve();
  });
  switch (status) {
    case 10:
      return SatAnswer::Sat;
    case 20:
      return SatAnswer::Unsat;
    default:
      return SatAnswer::Unknown;
  }
}

bool Sat::value(int literal) const { return impl().solver.val(literal) > 0; }
bool Sat::failed(int literal) const { return impl().solver.failed(literal); }
void Sat::phase(int literal) { impl().solver.phase(literal); }

AigClauses::AigClauses(const Aig& aig, Sat& sat) : aig_(&aig), sat_(&sat) {}

void AigClauses::define(std::uint32_t node) {
  const int v = sat_->new_variable();
  variable_[node] = v;
  if (node == 0) return sat_->add({-v});
  if (!aig_->is_gate(node)) return;
  const int a = known_literal(aig_->left(node));
  const int b = known_literal(aig_->right(node));
  sat_->add({-v, a});
  sat_->add({-v, b});
  sat_->add({v, -a, -b});
}

int AigClauses::known_literal(AigLit a) const {
  if (aig_node(a) >= variable_.size()) return 0;
  const int v = variable_[aig_node(a)];
  return aig_inverted(a) ? -v : v;
}

int AigClauses::literal(AigLit a) {
  if (variable_.size() < aig_->size()) variable_.resize(aig_->size(), 0);
  stack_.push_back(aig_node(a));
  while (!stack_.empty()) {
    const std::uint32_t node = stack_.back();
    if (variable_[node] != 0) {
      stack_.pop_back();
      continue;
    }
    bool ready = true;
    if (aig_->is_gate(node)) {
      for (AigLit operand : {aig_->left(node), aig_->right(node)}) {
        if (variable_[aig_node(operand)] != 0) continue;
        stack_.push_back(aig_node(operand));
        ready = false;
      }
    }
    if (!ready) continue;
    stack_.pop_back();
    define(node);
  }
  return known_literal(a);
}

bool AigClauses::value(AigLit a) const {
  const int literal = known_literal(a);
  return literal == 0 ? aig_inverted(a) : sat_->value(literal);
}

void AigClauses::require(AigLit a) { sat_->add({literal(a)}); }

}  // namespace rung
