#include "analysis/response.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "analysis/execute.h"
#include "analysis/formula.h"
#include "analysis/property_check.h"
#include "analysis/replay_formula.h"
#include "analysis/simulator.h"

namespace rung {
namespace {

constexpr std::int64_t kNone = -1;

/// Follows the waits of a run, scan by scan.
class WaitWatch {
 public:
  WaitWatch(const Program& program, const std::vector<std::string>& assumptions,
            const ResponseQuestion& question)
      : names_(program), simulator_(program) {
    formulas_.emplace_back(program, names_, question.cause);
    formulas_.emplace_back(program, names_, question.response);
    for (const std::string& text : assumptions) {
      formulas_.emplace_back(program, names_, text);
    }
    for (FormulaWatch& formula : formulas_) formula.start(simulator_);
  }

  Simulator& simulator() { return simulator_; }
  Waits& waits() { return waits_; }

  void scan(std::int64_t dt_ms) {
    for (FormulaWatch& formula : formulas_) formula.begin(simulator_);
    simulator_.scan(dt_ms);
    for (FormulaWatch& formula : formulas_) formula.end(simulator_);
    for (std::size_t i = 2; i < formulas_.size(); ++i) {
      if (!formulas_[i].holds()) waits_.valid = false;
    }
    note_longest();
    note_shortest();
  }

  /// Scans behind the one just run that do the same; kForever: all.
  std::uint64_t idle_scans(std::int64_t dt_ms) {
    const std::uint64_t idle = simulator_.idle_scans(dt_ms);
    const auto never =
        static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    std::uint64_t result = idle >= never ? kForever : idle;
    for (FormulaWatch& formula : formulas_) {
      result = std::min(result, formula.steady_scans(simulator_, dt_ms));
    }
    return result;
  }

  void skip(std::uint64_t count, std::int64_t dt_ms) {
    if (count == 0) return;
    simulator_.skip(count, dt_ms);
    for (FormulaWatch& formula : formulas_) formula.skip(count);
    if (waits_.open) keep_longest();
  }

 private:
  bool cause() const { return formulas_[0].holds(); }
  bool response() const { return formulas_[1].holds(); }
  Span now() const {
    return {simulator_.now_ms(), static_cast<std::int64_t>(simulator_.scans())};
  }
  Wait since(const Span& start) const {
    const Span end = now();
    return {{end.milliseconds - start.milliseconds, end.scans - start.scans},
            simulator_.scans()};
  }

  void note_longest() {
    if (!waits_.open && cause()) {
      waits_.open = true;
      oldest_ = now();
    }
    if (!waits_.open) return;
    keep_longest();
    if (response()) waits_.open = false;
  }

  void keep_longest() {
    const Wait wait = since(oldest_);
    for (const SpanUnit unit : {SpanUnit::Milliseconds, SpanUnit::Scans}) {
      Wait& longest = waits_.longest[static_cast<std::size_t>(unit)];
      const bool longer = in(wait.span, unit) > in(longest.span, unit);
      if (longest.end == 0 || longer) longest = wait;
    }
  }

  void note_shortest() {
    if (cause() && !was_) latest_ = now();
    was_ = cause();
    if (!response() || latest_.scans == kNone) return;
    const Wait wait = since(latest_);
    for (const SpanUnit unit : {SpanUnit::Milliseconds, SpanUnit::Scans}) {
      Wait& shortest = waits_.shortest[static_cast<std::size_t>(unit)];
      const bool shorter = in(wait.span, unit) < in(shortest.span, unit);
      if (shortest.end == 0 || shorter) shortest = wait;
    }
  }

  ObservationNames names_;
  Simulator simulator_;
  std::vector<FormulaWatch> formulas_;  // P, Q, the assumptions
  Waits waits_;
  Span oldest_;               // P without an answer
  Span latest_ = {0, kNone};  // rise of P
  bool was_ = false;          // P, a scan before
};

void run(const Stimulus& stimulus, std::uint64_t limit, WaitWatch& watch) {
  for (const StimulusStep& step : stimulus.steps) {
    set_inputs(watch.simulator(), stimulus, step);
    if (run_scans(watch, step.repeat, step.dt_ms, limit)) continue;
    watch.waits().valid = false;
    return;
  }
}

std::string_view trimmed(std::string_view text) {
  return Slice{text, {}}.part(0).text;
}

/// Drops `(` in front of `left`, and as many `)` behind `right`, which are
/// around both.
void unwrap(std::string_view& left, std::string_view& right) {
  const auto opened = std::count(left.begin(), left.end(), '(') -
                      std::count(left.begin(), left.end(), ')');
  for (std::ptrdiff_t i = 0; i < opened; ++i) {
    left = trimmed(left.substr(1));
    right = trimmed(right.substr(0, right.size() - 1));
  }
}

/// A node's range leaves parentheses around it out: so the text is cut at the
/// arrow between both.
ResponseQuestion sides_of(const Formula& formula, std::string_view text) {
  const std::uint32_t right_root = formula.root() - 1;
  const FormulaNode& right_node = formula.nodes[right_root];
  const FormulaNode& left_node = formula.nodes[right_root - right_node.size];
  const std::size_t arrow = text.find("->", left_node.end);
  std::string_view left = trimmed(text.substr(0, arrow));
  std::string_view right = trimmed(text.substr(arrow + 2));
  unwrap(left, right);
  return {std::string(left), std::string(right)};
}

}  // namespace

std::optional<ResponseQuestion> read_response(Program& program,
                                              const Slice& text,
                                              DiagnosticSink& sink) {
  const PropertyNames names(program);
  FormulaChecker checker(program, names, sink);
  if (!checker.check(text)) return std::nullopt;
  const Formula formula = parse_formula(text.text);
  const FormulaNode& root = formula.nodes.back();
  if (root.op != FormulaOp::Implies) {
    sink.report({.code = "RP060",
                 .severity = Severity::Error,
                 .where = text.where,
                 .message = "a response is asked for as `P -> Q`"});
    return std::nullopt;
  }
  ResponseQuestion question = sides_of(formula, text.text);
  // With what remembers around it, it looks back further.
  if (!checker.check_made(rise_of(question), text.where)) return std::nullopt;
  return question;
}

std::string rise_of(const ResponseQuestion& question) {
  // Before the first scan there is no scan end: nothing was once true.
  return "(" + question.cause + ") && !(prev(" + question.cause +
         ") && prev(once(true)))";
}

Waits measure_waits(const Program& program,
                    const std::vector<std::string>& assumptions,
                    const ResponseQuestion& question, const Stimulus& stimulus,
                    std::uint64_t limit) {
  WaitWatch watch(program, assumptions, question);
  run(stimulus, limit, watch);
  return watch.waits();
}

Held hold(const Program& program, const std::vector<std::string>& assumptions,
          const ResponseQuestion& question, Stimulus stimulus,
          std::int64_t dt_ms, std::uint64_t limit) {
  WaitWatch watch(program, assumptions, question);
  run(stimulus, limit, watch);
  Held held = {Held::End::Unknown, std::move(stimulus)};
  if (!watch.waits().valid || !watch.waits().open ||
      held.stimulus.steps.empty())
    return held;
  StimulusStep more = held.stimulus.steps.back();
  more.dt_ms = dt_ms;
  more.repeat = 0;
  for (std::uint64_t executed = 0; executed < limit; ++executed) {
    watch.scan(dt_ms);
    ++more.repeat;
    if (!watch.waits().valid) return held;
    if (!watch.waits().open) {
      held.end = Held::End::Answered;
      break;
    }
    const std::uint64_t idle = watch.idle_scans(dt_ms);
    if (idle == kForever) {
      held.end = Held::End::Never;
      break;
    }
    watch.skip(idle, dt_ms);
    more.repeat += idle;
  }
  if (held.end != Held::End::Unknown) held.stimulus.steps.push_back(more);
  return held;
}

}  // namespace rung
