#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"
#include "analysis/rule_selection.h"
#include "analysis/transition_system.h"
#include "base/diagnostic.h"

namespace rung {

/// What a solver-decided rule may ask. Implemented in smt/, so that rules see
/// no solver. All questions of a file share one session.
class Oracle {
 public:
  virtual ~Oracle() = default;

  enum class Answer : std::uint8_t { Yes, No, Unknown };
  struct Evidence {
    Answer answer = Answer::Unknown;
    std::string engine;
    std::optional<Trace> witness;  // of No, if wanted: replayed
  };

  struct Question {
    ExprId condition;  // a term of the context's transition system
    bool wants_witness = true;
  };

  /// Is each condition true at the end of every scan of every run? Yes is
  /// proved and re-checked; No has a witness run, where one is wanted, that
  /// ends in a scan where the condition is false. Many at once are much
  /// cheaper than one by one.
  virtual std::vector<Evidence> answer(
      const std::vector<Question>& questions) = 0;

  Evidence always(ExprId condition) {
    return always(std::vector<ExprId>{condition}).front();
  }
  std::vector<Evidence> always(const std::vector<ExprId>& conditions) {
    std::vector<Question> questions;
    questions.reserve(conditions.size());
    for (const ExprId condition : conditions) questions.push_back({condition});
    return answer(questions);
  }
};

struct RuleContext {
  const SourceSet& sources;
  const Program& program;
  const PropertySet& properties;
  TransitionSystem& ts;      // rules may build terms in it
  Oracle* oracle;            // null: solver-decided rules say nothing
  RuleSelection rules = {};  // those that are off neither look nor ask
};

enum class Decision : std::uint8_t { Syntax, Solver };

/// What a check works with: the context, tables over the program, and the way
/// to report and to ask. Defined in analysis/rules/rule_run.h.
class RuleRun;

/// A lint rule: its identity, its documentation and its check, in one file
/// under analysis/rules/.
struct Rule {
  std::string_view code;  // "RP101": never reused once released
  std::string_view name;  // reads well after "allow": "allow double-coil"
  Severity severity;      // of most findings; what is proved harmless is a note
  Decision decision;
  std::string_view doc;  // Markdown with the four headings of docs/rules
  void (*check)(RuleRun& run);
  Pack pack = Pack::Default;
};

/// Every rule, sorted by code.
std::span<const Rule* const> all_rules();

/// By code or name; null when there is none.
const Rule* find_rule(std::string_view code_or_name);

/// Effort of the solver rules. Counts, not seconds: the same on every machine.
struct RuleBudget {
  /// Terms of the transition system; in a larger one nothing is asked, and
  /// what only a solver can tell stays open.
  std::size_t largest_system = 120'000;
  std::size_t proof_questions = 4096;        // in all, after sampling
  std::size_t witness_questions = 64;        // in all
  std::uint64_t sampling_work = 15'000'000;  // term evaluations, about
};

/// What the solver rules did: a summary may say it.
struct RuleSummary {
  std::size_t asked = 0;      // questions
  std::size_t sampled = 0;    // answered no by a sampled run
  std::size_t undecided = 0;  // left without an answer: nothing is claimed
  bool too_large = false;     // the program: no question was asked
};

/// Runs every rule that is on. First each check, which may ask questions; then
/// all questions of all rules go to `context.oracle` in one call, and the rules
/// judge the answers. Without an oracle every answer is Unknown.
/// `//@ allow NAME_OR_CODE: reason` on the line of a finding or on the line
/// above gives it a waiver; it comes to `sink` as the others do.
RuleSummary run_rules(const RuleContext& context, DiagnosticSink& sink,
                      const RuleBudget& budget = {});

}  // namespace rung
