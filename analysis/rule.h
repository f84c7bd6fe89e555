#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/property.h"
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
    std::optional<Trace> witness;  // of No from always(): replayed
  };

  /// Is `condition` (a term of the context's transition system) true at the
  /// end of every scan of every run? Yes is proved and re-checked; No has a
  /// witness run that ends in a scan where it is false.
  virtual Evidence always(ExprId condition) = 0;
  /// The same for many at once: much cheaper than one by one.
  virtual std::vector<Evidence> always(
      const std::vector<ExprId>& conditions) = 0;
};

struct RuleContext {
  const SourceSet& sources;
  const Program& program;
  const PropertySet& properties;
  TransitionSystem& ts;  // rules may build terms in it
  Oracle* oracle;        // null: solver-decided rules say nothing
};

enum class Decision : std::uint8_t { Syntax, Solver };

/// A lint rule: its identity, its documentation and its check, in one file
/// under analysis/rules/.
struct Rule {
  std::string_view code;  // "RP101": never reused once released
  std::string_view name;  // reads well after "allow": "allow double-coil"
  Severity severity;
  Decision decision;
  std::string_view doc;  // Markdown with the four headings of docs/rules
  void (*check)(const RuleContext&, DiagnosticSink&);
};

/// Every rule, sorted by code.
std::span<const Rule* const> all_rules();

/// By code or name; null when there is none.
const Rule* find_rule(std::string_view code_or_name);

/// Runs every rule. Solver rules get `context.oracle`.
void run_rules(const RuleContext& context, DiagnosticSink& sink);

}  // namespace rung
