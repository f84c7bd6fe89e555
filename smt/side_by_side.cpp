#include "smt/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "analysis/rebuilt.h"

namespace rung {
namespace {

/// An answer over terms that its group made, and those terms.
struct Made {
  GroupAnswer answer;
  std::vector<std::pair<ExprId, Expr>> terms;  // operands first
};

class SideBySide {
 public:
  SideBySide(TransitionSystem& ts, const std::vector<ExprId>& growth,
             const std::vector<std::vector<Target*>>& groups,
             const PortfolioOptions& options,
             const std::function<void(std::size_t)>& progress)
      : ts_(ts),
        growth_(growth),
        groups_(groups),
        options_(options),
        progress_(progress),
        made_(groups.size()) {}

  std::vector<GroupAnswer> run(std::uint32_t jobs) {
    // Alone it needs no copy of the terms.
    alone_ = groups_.size() == 1;
    const std::size_t workers = std::min<std::size_t>(jobs, groups_.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < workers; ++i) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) thread.join();
    std::vector<GroupAnswer> answers;
    answers.reserve(made_.size());
    for (Made& made : made_) answers.push_back(taken_over(made));
    return answers;
  }

 private:
  void work() {
    std::unique_ptr<TransitionSystem> own;  // copied once for each worker
    for (std::size_t i = next_++; i < groups_.size(); i = next_++) {
      if (progress_) {
        const std::lock_guard<std::mutex> lock(progress_mutex_);
        progress_(i);
      }
      const std::vector<Target*>& group = groups_[i];
      std::vector<Target> before;
      try {
        for (const Target* target : group) before.push_back(*target);
        if (alone_) {
          made_[i] = decide(ts_, group);
          continue;
        }
        if (own == nullptr) {
          own = std::make_unique<TransitionSystem>(ts_);
        } else {
          own->exprs = ts_.exprs;  // without what the last group made
        }
        made_[i] = decide(*own, group);
      } catch (const std::exception& error) {
        made_[i] = {};
        for (std::size_t j = 0; j < before.size(); ++j) {
          *group[j] = std::move(before[j]);
        }
        for (Target* target : group) give_up(*target, error.what());
      }
    }
  }

  /// What was shown of it before rests on the group's invariant, and there is
  /// none.
  static void give_up(Target& target, const char* why) {
    if (target.status == Target::Status::Unreachable) {
      target.status = Target::Status::Open;
    }
    target.failure = why;
  }

  Made decide(TransitionSystem& ts, const std::vector<Target*>& group) {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t old = ts_.exprs.size();
    Portfolio portfolio(ts, growth_, group, options_);
    portfolio.run();
    Made made;
    made.answer.invariant = portfolio.invariant();
    made.answer.overflow = portfolio.cone().circuit().overflow();
    std::vector<ExprId> open;
    for (const LemmaClause& lemma : made.answer.invariant.lemmas) {
      for (const LemmaAtom& atom : lemma) open.push_back(atom.term);
    }
    if (!alone_) made.terms = new_terms(ts.exprs, old, std::move(open));
    made.answer.milliseconds = std::chrono::duration<double, std::milli>(
                                   std::chrono::steady_clock::now() - start)
                                   .count();
    return made;
  }

  /// Those under `open` that were made behind the first `old` ones.
  static std::vector<std::pair<ExprId, Expr>> new_terms(
      const ExprArena& exprs, std::size_t old, std::vector<ExprId> open) {
    std::vector<bool> seen(exprs.size() - old, false);
    while (!open.empty()) {
      const ExprId id = open.back();
      open.pop_back();
      if (!id.has_value() || id.index() < old || seen[id.index() - old]) {
        continue;
      }
      seen[id.index() - old] = true;
      const Expr& e = exprs[id];
      open.insert(open.end(), {e.a, e.b, e.c});
    }
    std::vector<std::pair<ExprId, Expr>> terms;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const ExprId id(static_cast<std::uint32_t>(old + i));
      if (seen[i]) terms.emplace_back(id, exprs[id]);
    }
    return terms;
  }

  GroupAnswer taken_over(Made& made) {
    std::unordered_map<ExprId, ExprId> here;
    const auto known = [&](ExprId id) {
      const auto found = here.find(id);
      return found == here.end() ? id : found->second;
    };
    for (const auto& [id, e] : made.terms) {
      here.emplace(id,
                   rebuilt(ts_.exprs, e, known(e.a), known(e.b), known(e.c)));
    }
    for (LemmaClause& lemma : made.answer.invariant.lemmas) {
      for (LemmaAtom& atom : lemma) {
        if (atom.term.has_value()) atom.term = known(atom.term);
      }
    }
    return std::move(made.answer);
  }

  TransitionSystem& ts_;  // not changed while groups are decided
  const std::vector<ExprId>& growth_;
  const std::vector<std::vector<Target*>>& groups_;
  const PortfolioOptions& options_;
  const std::function<void(std::size_t)>& progress_;
  std::vector<Made> made_;
  bool alone_ = false;
  std::atomic<std::size_t> next_ = 0;
  std::mutex progress_mutex_;
};

}  // namespace

std::vector<GroupAnswer> decide_side_by_side(
    TransitionSystem& ts, const std::vector<ExprId>& growth,
    const std::vector<std::vector<Target*>>& groups,
    const PortfolioOptions& options, std::uint32_t jobs,
    const std::function<void(std::size_t)>& progress) {
  return SideBySide(ts, growth, groups, options, progress).run(jobs);
}

}  // namespace rung
