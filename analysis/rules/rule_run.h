#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "analysis/rule.h"
#include "analysis/rules/latch.h"
#include "analysis/rules/past.h"
#include "analysis/rules/program_index.h"

namespace rung {

#define RUNG_RULE(ident) extern const Rule ident;
#include "analysis/rules/rules.def"
#undef RUNG_RULE

/// One run of all rules over one program.
///
/// A check reads, reports and asks. What it asks is answered after every check
/// has run, all at once: one solver session, and one induction over the
/// conjunction of all claims, cost far less than a session a rule.
class RuleRun {
 public:
  using Answer = Oracle::Answer;
  using Evidence = Oracle::Evidence;
  using Judge = std::function<void(RuleRun&, std::span<const Evidence>)>;

  /// What an answer is worth to the rule that asks.
  enum class Want : std::uint8_t {
    Proof,    // only Yes leads to a finding; No needs no witness
    Witness,  // No leads to a finding, which shows the witness
  };

  struct Details {
    std::vector<Label> labels = {};
    std::string help = {};
    bool downgrade = false;  // proved harmless: a note
  };

  RuleRun(const RuleContext& context, DiagnosticSink& sink,
          const RuleBudget& budget);

  const SourceSet& sources;
  const Program& program;
  const PropertySet& properties;
  TransitionSystem& ts;
  const ProgramIndex index;
  const std::vector<Latch> latches;
  const bool has_oracle;  // will anyone answer?
  Past past;              // what was in the scan before

  void report(SourceRange where, std::string message, Details details);
  void report(SourceRange where, std::string message);

  /// Is each condition true at the end of every scan of every run? `judge` is
  /// called once, with an answer for each condition, in order.
  void ask(Want want, std::vector<ExprId> always, Judge judge);

  /// A rung for whose value another rule has told the reason: rules that
  /// would tell consequences stay silent there. Rules speak in the order of
  /// their codes, those decided on the syntax before those that ask.
  void explain(RungId rung) { explained_[rung.index()] = true; }
  bool explained(RungId rung) const { return explained_[rung.index()]; }
  /// A call that another rule has told to be dead.
  void explain(CallId call) { dead_[call.index()] = true; }
  bool explained(CallId call) const { return dead_[call.index()]; }

  void check(const Rule& rule);
  RuleSummary decide();

 private:
  struct Question {
    const Rule* rule = nullptr;
    Want want = Want::Proof;
    std::size_t begin = 0;  // in conditions_
    std::size_t end = 0;
    Judge judge;
  };

  bool names_made_cell(std::string_view message) const;
  void enumerate_all(std::vector<Evidence>& answers) const;
  void sample_proofs(std::vector<Evidence>& answers);
  void ask_oracle(std::vector<Evidence>& answers) const;

  const RuleSelection& selection_;
  const bool too_large_;
  DiagnosticSink& sink_;
  Oracle* oracle_;
  RuleBudget budget_;
  RuleSummary summary_;
  const Rule* rule_ = nullptr;
  std::unordered_set<std::string_view> made_;  // names of cells
  std::vector<bool> explained_;                // by rung
  std::vector<bool> dead_;                     // by call
  std::vector<Question> questions_;
  std::vector<ExprId> conditions_;
};

}  // namespace rung
