#include "smt/script/unit_propagation.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace rung::script {

void UnitPropagation::make_room(const std::vector<int>& clause) {
  std::size_t most = 0;
  for (const int literal : clause) {
    most = std::max(most, static_cast<std::size_t>(std::abs(literal)));
  }
  if (values_.size() >= 2 * most + 2) return;
  values_.resize(2 * most + 2, 0);
  watches_.resize(2 * most + 2);
}

void UnitPropagation::assign(int literal) {
  values_[slot(literal)] = 1;
  values_[slot(-literal)] = -1;
  trail_.push_back(literal);
}

/// Invariant: without assumptions everything is propagated.
void UnitPropagation::add(const std::vector<int>& clause) {
  if (contradiction_) return;
  make_room(clause);
  std::vector<int> kept = clause;
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const int literal : kept) {
    const bool both = std::binary_search(kept.begin(), kept.end(), -literal);
    if (both || is_true(literal)) return;
  }
  std::erase_if(kept, [&](int literal) { return is_false(literal); });
  if (kept.empty()) {
    contradiction_ = true;
  } else if (kept.size() == 1) {
    assign(kept.front());
    contradiction_ = !propagate();
  } else {
    const auto at = static_cast<std::uint32_t>(literals_.size());
    literals_.push_back(static_cast<int>(kept.size()));
    literals_.insert(literals_.end(), kept.begin(), kept.end());
    watches_[slot(kept[0])].push_back({at, kept[1]});
    watches_[slot(kept[1])].push_back({at, kept[0]});
  }
}

bool UnitPropagation::implies(const std::vector<int>& clause) {
  if (contradiction_) return true;
  make_room(clause);
  const std::size_t before = trail_.size();
  bool conflict = false;
  for (const int literal : clause) {
    if (is_true(literal)) {
      conflict = true;
      break;
    }
    if (!is_false(literal)) assign(-literal);
  }
  conflict = conflict || !propagate();
  undo(before);
  return conflict;
}

bool UnitPropagation::derive(const std::vector<int>& clause) {
  if (!implies(clause)) return false;
  add(clause);
  return true;
}

/// False: some clause has no literal left.
bool UnitPropagation::propagate() {
  while (propagated_ < trail_.size()) {
    if (!visit(-trail_[propagated_++])) return false;
  }
  return true;
}

/// All clauses that watch a literal that became false.
bool UnitPropagation::visit(int falsified) {
  std::vector<Watch>& watching = watches_[slot(falsified)];
  std::size_t kept = 0;
  bool conflict = false;
  for (std::size_t i = 0; i < watching.size(); ++i) {
    const Watch watch = watching[i];
    if (conflict || is_true(watch.other)) {
      watching[kept++] = watch;
      continue;
    }
    if (find_watch(watch.clause, falsified)) continue;
    const int* literals = literals_.data() + watch.clause + 1;
    const int first = literals[0];
    watching[kept++] = {watch.clause, first};
    if (is_true(first)) continue;
    conflict = is_false(first);
    if (!conflict) assign(first);
  }
  watching.resize(kept);
  return !conflict;
}

/// Watches another literal instead; false when there is none. The watched ones
/// stand first, and the falsified one second afterwards.
bool UnitPropagation::find_watch(std::uint32_t clause, int falsified) {
  int* literals = literals_.data() + clause + 1;
  const auto size = static_cast<std::size_t>(literals_[clause]);
  if (literals[0] == falsified) std::swap(literals[0], literals[1]);
  if (is_true(literals[0])) return false;
  for (std::size_t i = 2; i < size; ++i) {
    if (is_false(literals[i])) continue;
    std::swap(literals[1], literals[i]);
    watches_[slot(literals[1])].push_back({clause, literals[0]});
    return true;
  }
  return false;
}

void UnitPropagation::undo(std::size_t size) {
  while (trail_.size() > size) {
    values_[slot(trail_.back())] = 0;
    values_[slot(-trail_.back())] = 0;
    trail_.pop_back();
  }
  propagated_ = size;
}

}  // namespace rung::script
