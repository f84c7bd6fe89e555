#include "smt/script/refute.h"

#include <algorithm>
#include <cadical.hpp>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>

#include "smt/script/unit_propagation.h"
#include "smt/solver_settings.h"

namespace rung::script {
namespace {

/// A file in memory that a solver writes its proof to: binary DRAT, steps of
/// 'a' or 'd', literals as 2 |x| + (x < 0) in base 128, a 0 at the end.
class ProofFile {
 public:
  ProofFile() : file_(open_memstream(&text_, &size_)) {
    if (file_ == nullptr) throw std::bad_alloc();
  }
  ~ProofFile() {
    std::fclose(file_);
    std::free(text_);
  }
  ProofFile(const ProofFile&) = delete;
  ProofFile& operator=(const ProofFile&) = delete;

  FILE* get() const { return file_; }

  std::int64_t steps() const { return steps_; }

  /// Has `checker` derive what was added since the last call. Deletions are
  /// left out. False when some step is not seen to be right.
  bool follow(UnitPropagation& checker) {
    std::fflush(file_);
    std::vector<int> clause;
    while (at_ < size_) {
      const char step = text_[at_++];
      clause.clear();
      for (unsigned code = number(); code != 0; code = number()) {
        const int variable = static_cast<int>(code / 2);
        clause.push_back(code % 2 != 0 ? -variable : variable);
      }
      ++steps_;
      if (step == 'd') continue;
      if (step != 'a' || !checker.derive(clause)) return false;
    }
    return true;
  }

 private:
  unsigned number() {
    unsigned result = 0;
    for (unsigned shift = 0; at_ < size_ && shift < 32; shift += 7) {
      const auto byte = static_cast<unsigned char>(text_[at_++]);
      result |= (byte & 127U) << shift;
      if (byte < 128) return result;
    }
    return 0;
  }

  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* file_;
  std::size_t at_ = 0;
  std::int64_t steps_ = 0;
};

/// A solver that writes down its proof.
class Prover {
 public:
  Prover() {
    // What is eliminated and put back has steps that unit propagation cannot
    // follow.
    solver_.configure("plain");
    prepare_for_queries(solver_);
    solver_.trace_proof(proof_.get(), "proof");
  }

  void add(int literal) { solver_.add(literal); }

  int solve(int assumed, std::int64_t conflicts) {
    constexpr std::int64_t kMost = std::numeric_limits<int>::max();
    solver_.limit("conflicts", static_cast<int>(std::min(conflicts, kMost)));
    solver_.assume(assumed);
    const int status = solver_.solve();
    solver_.flush_proof_trace();
    return status;
  }

  ProofFile& proof() { return proof_; }

 private:
  ProofFile proof_;
  CaDiCaL::Solver solver_;
};

}  // namespace

struct Refuter::Impl {
  std::vector<int> clauses;
  int variables = 0;
  UnitPropagation checker;
  std::unique_ptr<Prover> prover;  // made when first needed
  bool failed = false;             // a call of it did not come back

  Prover& solver() {
    if (prover == nullptr) {
      prover = std::make_unique<Prover>();
      for (const int literal : clauses) prover->add(literal);
    }
    return *prover;
  }
};

Refuter::Refuter(const std::vector<int>& clauses, int variables,
                 const std::vector<int>& assumed)
    : impl_(std::make_unique<Impl>()) {
  impl_->variables = variables;
  impl_->clauses = clauses;
  for (const int literal : assumed) {
    impl_->clauses.insert(impl_->clauses.end(), {literal, 0});
  }
  std::vector<int> clause;
  for (const int literal : impl_->clauses) {
    if (literal != 0) {
      clause.push_back(literal);
      continue;
    }
    impl_->checker.add(clause);
    clause.clear();
  }
}

Refuter::~Refuter() {
  // After an exception the solver ends the process when it is touched again.
  if (impl_->failed) static_cast<void>(impl_->prover.release());
}

std::int64_t Refuter::steps() const {
  return impl_->prover == nullptr ? 0 : impl_->prover->proof().steps();
}

Refuter::Answer Refuter::refute(const std::vector<int>& claims,
                                std::int64_t conflicts) {
  UnitPropagation& checker = impl_->checker;
  // Only while `now` holds, one of the claims is false.
  const int now = ++impl_->variables;
  std::vector<int> clause = {-now};
  for (const int claim : claims) {
    if (!checker.derive({claim})) clause.push_back(-claim);
  }
  if (clause.size() == 1) return Answer::Refuted;
  impl_->failed = true;
  Prover& prover = impl_->solver();
  for (const int literal : clause) prover.add(literal);
  prover.add(0);
  const int status = prover.solve(now, conflicts);
  impl_->failed = false;
  checker.add(clause);
  if (!prover.proof().follow(checker)) return Answer::Unproved;
  if (status == 10) return Answer::Model;
  if (status != 20) return Answer::Unknown;
  return checker.derive({-now}) ? Answer::Refuted : Answer::Unproved;
}

}  // namespace rung::script
