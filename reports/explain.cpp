#include "reports/explain.h"

#include <fmt/format.h>

#include <array>

#include "reports/scan_table.h"

namespace rung {
namespace {

constexpr std::size_t kMaxValues = 12;

/// "I1 = 1, Q0 = 1": the cells that the property names, at the trace's end.
std::string values_at_end(const FileReport& file, const Trace& trace,
                          const std::vector<CellId>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size() && i < kMaxValues; ++i) {
    out += fmt::format("{}{} = {}", i == 0 ? "" : ", ",
                       file.program->cells[cells[i]].name,
                       trace.steps.back().values[cells[i].index()]);
  }
  if (cells.size() > kMaxValues) out += ", ...";
  return out;
}

/// What the last part of a latch obligation's name stands for; {0} {1} {2} are
/// the latch, its set and its reset.
struct LatchPart {
  std::string_view name;
  std::string_view broken;
};
constexpr std::array kLatchParts = {
    LatchPart{"settable", "no run ever sets `{0}`"},
    LatchPart{"sets",
              "`{1}` is true and `{2}` is not, yet `{0}` is false at the "
              "scan's end"},
    LatchPart{"holds", "`{0}` was on and falls although `{2}` is false"},
    LatchPart{"releasable",
              "nothing releases `{0}` any more, whatever the inputs"},
    LatchPart{"resets", "`{2}` is true, yet `{0}` is true at the scan's end"},
    LatchPart{"no-spurious-start", "`{0}` rises in a scan without `{1}`"},
};

std::string_view part_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{}
                                       : name.substr(dot + 1);
}

/// What is wrong at the end of the run, as the property's form has it; empty
/// where nothing better can be said than the property's own text.
std::string broken_clause(const Property& property,
                          const Obligation& obligation) {
  const std::vector<std::string>& f = property.formulas;
  switch (property.form) {
    case Property::Form::Always:
      return f.empty() ? "" : fmt::format("`{}` is false", f[0]);
    case Property::Form::Never:
      return f.empty() ? "" : fmt::format("`{}` is true", f[0]);
    case Property::Form::Latch:
      if (f.size() < 3) return "";
      for (const LatchPart& part : kLatchParts) {
        const bool set_wins = property.dominant_set && part.name == "sets";
        if (part.name != part_of(obligation.name)) continue;
        if (set_wins) {
          return fmt::format(
              "`{}` is true, yet `{}` is false at the scan's end", f[1], f[0]);
        }
        return fmt::format(fmt::runtime(part.broken), f[0], f[1], f[2]);
      }
      return "";
    case Property::Form::Recoverable:
      if (f.empty()) return "";
      return fmt::format("nothing leads to `{}` any more, whatever the inputs",
                         f[0]);
    case Property::Form::After:
      if (f.size() < 2) return "";
      return fmt::format(
          "`{}` came, and `{}` {}", f[0], f[1],
          property.absent ? "followed too soon" : "did not follow in time");
    case Property::Form::For:
      if (f.size() < 2) return "";
      return fmt::format("`{}` has been true for {}, yet `{}` is false", f[0],
                         duration(property.milliseconds), f[1]);
    case Property::Form::OnlyAfter:
      if (f.size() < 2) return "";
      return fmt::format("`{}` is true, and `{}` never was", f[0], f[1]);
    case Property::Form::Settles:
      return fmt::format(
          "an output still changes after {} at rest (no time passes, inputs "
          "are held)",
          quantity(static_cast<std::size_t>(property.scans), "scan"));
    case Property::Form::Eventually:
    case Property::Form::Interlock:
    case Property::Form::Reach:
      return "";
  }
  return "";
}

const Property* property_of(const FileReport& file,
                            const Obligation& obligation) {
  const auto& all = file.properties.properties;
  return obligation.property < all.size() ? &all[obligation.property] : nullptr;
}

std::string proof_phrase(const ObligationResult& result) {
  switch (result.obligation.goal) {
    case Goal::Reach:
      return fmt::format("a run gets there in {}",
                         quantity(result.scans, "scan"));
    case Goal::Recover:
      return "a run leads there from every reachable state";
    case Goal::Respond:
      return "every fair run gets there again and again";
    case Goal::Invariant:
      break;
  }
  return "it holds in every reachable state";
}

/// Of a run that goes round for ever.
std::string loop_clause(const Property& property, const Trace& trace) {
  const Trace::Step& first = trace.steps[*trace.loop];
  const std::uint64_t begin = first.scan - first.repeat + 1;
  const std::uint64_t end = trace.steps.back().scan;
  std::string out =
      begin == end
          ? fmt::format("scan {} can follow itself for ever", end)
          : fmt::format("scans {} to {} can follow each other for ever", begin,
                        end);
  for (std::size_t i = 1; i < property.formulas.size(); ++i) {
    out +=
        fmt::format("{} `{}`", i == 1 ? ", with" : ",", property.formulas[i]);
  }
  return out + fmt::format(", and `{}` does not come", property.formulas[0]);
}

std::string explain_violation(const FileReport& file,
                              const ObligationResult& result,
                              const Cones& cones) {
  const Obligation& obligation = result.obligation;
  // Not a run of this program, but what it was before.
  if (obligation.kind == "locked") return result.reason;
  const Property* property = property_of(file, obligation);
  std::string clause =
      property == nullptr ? "" : broken_clause(*property, obligation);
  if (!result.trace || result.trace->steps.empty()) {
    if (clause.empty() || part_of(obligation.name).empty()) {
      clause = "no run ever gets there";
    }
    return clause;
  }
  if (result.trace->loop && property != nullptr) {
    return loop_clause(*property, *result.trace);
  }
  std::string out =
      fmt::format("at the end of scan {}", result.trace->steps.back().scan);
  const std::string values = values_at_end(
      file, *result.trace, cones.named(formulas_of(file, obligation)));
  if (!clause.empty()) out += ", " + clause;
  if (!values.empty()) out += ": " + values;
  return out;
}

}  // namespace

const std::vector<std::string>& formulas_of(const FileReport& file,
                                            const Obligation& obligation) {
  static const std::vector<std::string> none;
  const Property* property = property_of(file, obligation);
  return property == nullptr ? none : property->formulas;
}

std::string verdict_phrase(const ObligationResult& result) {
  std::string out(to_string(result.verdict));
  if (result.verdict == Verdict::Bounded) {
    out += fmt::format(": no violation within {}, no proof",
                       quantity(result.scans, "scan"));
  }
  if (!result.reason.empty()) {
    out += ": " + result.reason;
  }
  return out;
}

std::string why_undecided(const ObligationResult& result) {
  const std::string phrase = verdict_phrase(result);
  const std::size_t colon = phrase.find(": ");
  return colon == std::string::npos ? "no reason given"
                                    : phrase.substr(colon + 2);
}

std::string title_of(const Obligation& obligation) {
  const bool is_named = obligation.text.starts_with(obligation.name + ":");
  return is_named ? obligation.text : obligation.name + ": " + obligation.text;
}

std::string explain(const FileReport& file, const ObligationResult& result,
                    const Cones& cones) {
  switch (result.verdict) {
    case Verdict::Violated:
      return explain_violation(file, result, cones);
    case Verdict::Proved:
      return proof_phrase(result);
    case Verdict::Bounded:
    case Verdict::Vacuous:
    case Verdict::Unknown:
      return verdict_phrase(result);
  }
  return {};
}

std::string quantity(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace rung
