#include "smt/proofs.h"

#include <utility>

namespace rung {
namespace {

constexpr std::size_t kBatch = 500;  // lemmas and conditions in one check

}  // namespace

std::size_t Proofs::add(Invariant invariant, std::vector<ExprId> goals,
                        std::string name) {
  proofs_.push_back(
      {std::move(invariant), std::move(goals), std::move(name), {}});
  return proofs_.size() - 1;
}

void Proofs::check(const CertificateOptions& options) {
  std::size_t begin = 0;
  while (begin < proofs_.size()) {
    const std::size_t end = batch_end(begin);
    // A batch that fails is checked one by one, to tell whose fault it is; a
    // file that was asked for is one of each.
    const bool together = end - begin > 1 && options.smtlib_directory.empty() &&
                          check_together(begin, end, options);
    for (std::size_t i = begin; i < end && !together; ++i) {
      Proof& proof = proofs_[i];
      CertificateOptions own = options;
      own.name = proof.name;
      proof.report = session_.check(ts_, proof.invariant, proof.goals, own);
    }
    begin = end;
  }
}

/// Proofs with one k, until they are many.
std::size_t Proofs::batch_end(std::size_t begin) const {
  std::size_t size = 0;
  std::size_t end = begin;
  do {
    const Invariant& invariant = proofs_[end].invariant;
    size += invariant.lemmas.size() + invariant.conditions.size();
    ++end;
  } while (end < proofs_.size() && size < kBatch &&
           proofs_[end].invariant.k == proofs_[begin].invariant.k);
  return end;
}

bool Proofs::check_together(std::size_t begin, std::size_t end,
                            const CertificateOptions& options) {
  Invariant all;
  all.k = proofs_[begin].invariant.k;
  std::vector<ExprId> goals;
  for (std::size_t i = begin; i < end; ++i) {
    const Proof& proof = proofs_[i];
    all.lemmas.insert(all.lemmas.end(), proof.invariant.lemmas.begin(),
                      proof.invariant.lemmas.end());
    all.conditions.insert(all.conditions.end(),
                          proof.invariant.conditions.begin(),
                          proof.invariant.conditions.end());
    goals.insert(goals.end(), proof.goals.begin(), proof.goals.end());
  }
  CertificateReport report = session_.check(ts_, all, goals, options);
  if (report.outcome != CertificateOutcome::Accepted) return false;
  report.milliseconds /= static_cast<double>(end - begin);
  for (std::size_t i = begin; i < end; ++i) proofs_[i].report = report;
  return true;
}

}  // namespace rung
