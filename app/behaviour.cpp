#include "app/behaviour.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "smt/bound.h"
#include "smt/slices.h"

namespace rung {
namespace {

constexpr std::size_t kGroup = 6;  // outputs: 64 combinations
constexpr std::size_t kGroups = 4;
constexpr std::string_view kPrefix = "locked.";

/// What an obligation says, independent of lines: a name may have one in it.
std::string said(const Obligation& obligation, const PropertySet& properties) {
  const std::string& name = properties.properties[obligation.property].name;
  std::string part =
      obligation.name.substr(std::min(name.size(), obligation.name.size()));
  return part.empty() ? obligation.text
                      : obligation.text + " [" + part.substr(1) + "]";
}

bool is_ours(const Obligation& obligation) {
  return obligation.name.starts_with(kPrefix);
}

std::vector<std::vector<std::string>> output_groups(const Program& program,
                                                    std::string& not_listed) {
  std::vector<std::vector<std::string>> groups;
  std::size_t words = 0;
  std::size_t left = 0;
  for (const Cell& cell : program.cells) {
    if (cell.role != CellRole::Output) continue;
    if (cell.type != Type::Bit) {
      ++words;
    } else if (groups.size() == kGroups && groups.back().size() == kGroup) {
      ++left;
    } else {
      if (groups.empty() || groups.back().size() == kGroup)
        groups.emplace_back();
      groups.back().push_back(cell.name);
    }
  }
  if (words > 0) not_listed += fmt::format("{} of words", words);
  if (left > 0) {
    not_listed +=
        fmt::format("{}{} beyond the first {}", not_listed.empty() ? "" : ", ",
                    left, kGroup * kGroups);
  }
  return groups;
}

std::string formula_of(const std::vector<std::string>& outputs,
                       const std::string& combination) {
  std::string formula;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    formula += fmt::format("{}{}{}", i == 0 ? "" : " && ",
                           combination[i] == '1' ? "" : "!", outputs[i]);
  }
  return formula;
}

std::vector<std::string> all_combinations(std::size_t outputs) {
  std::vector<std::string> all;
  for (std::size_t value = 0; value < (std::size_t{1} << outputs); ++value) {
    std::string text;
    for (std::size_t bit = outputs; bit-- > 0;) {
      text += (value >> bit & 1U) != 0 ? '1' : '0';
    }
    all.push_back(std::move(text));
  }
  return all;
}

/// Where a property that no line has written is shown.
SourceRange place_of(const Program& program) {
  for (const Cell& cell : program.cells) {
    if (cell.role == CellRole::Output) return cell.where;
  }
  return program.rungs.empty() ? SourceRange()
                               : program.rungs[RungId(0)].target_where;
}

Property make_property(const Program& program, Property::Form form,
                       std::string name, std::string text,
                       std::vector<std::string> formulas) {
  Property property;
  property.form = form;
  property.name = std::string(kPrefix) + std::move(name);
  property.text = std::move(text);
  property.where = place_of(program);
  property.formulas = std::move(formulas);
  return property;
}

bool is_response(const Property& property) {
  return property.form == Property::Form::After && !property.absent &&
         !property.name.starts_with(kPrefix);
}

bool asks_for(const PropertySet& properties, const LockedResponse& response) {
  return std::any_of(properties.properties.begin(), properties.properties.end(),
                     [&](const Property& property) {
                       return is_response(property) &&
                              property.formulas[0] == response.cause &&
                              property.formulas[1] == response.response;
                     });
}

void measure_responses(const FileReport& report, const VerifyOptions& options,
                       Behaviour& behaviour) {
  for (const Property& property : report.properties.properties) {
    if (!is_response(property)) continue;
    const ResponseQuestion question{property.formulas[0], property.formulas[1]};
    LockedResponse response{question.cause, question.response, {}, {}};
    const auto is_same = [&](const LockedResponse& other) {
      return other.cause == response.cause &&
             other.response == response.response;
    };
    auto& all = behaviour.locked.responses;
    if (std::any_of(all.begin(), all.end(), is_same)) continue;
    const ResponseBounds bounds =
        find_bounds(*report.program, report.properties, question, options);
    const auto least = [](const SpanBound& bound) {
      return bound.kind == SpanBound::Kind::Exact
                 ? std::optional(bound.at_least)
                 : std::nullopt;
    };
    response.milliseconds = least(bounds.worst[0]);
    response.scans = least(bounds.worst[1]);
    for (const SelfCheckFailure& failure : bounds.failures) {
      behaviour.failures.push_back(failure);
    }
    all.push_back(std::move(response));
  }
}

/// Of everything that is asked about the program.
std::string slice_of(const Program& program, const PropertySet& properties) {
  TransitionSystem ts = build_transition_system(program);
  const std::vector<Obligation> obligations =
      make_obligations(program, properties, ts);
  const Slices slices(ts, properties, obligations);
  std::vector<Digest> all;
  all.reserve(obligations.size());
  for (const Obligation& obligation : obligations) {
    all.push_back(slices.of(obligation));
  }
  std::sort(all.begin(), all.end());
  Hasher hasher;
  for (const Digest& digest : all) hasher.add(digest);
  return to_string(hasher.finish());
}

void add_result(FileReport& report, std::uint32_t property, std::string name,
                std::string text, Verdict verdict, std::string reason,
                const ObligationResult* now) {
  ObligationResult result;
  Obligation& obligation = result.obligation;
  obligation.name = std::string(kPrefix) + std::move(name);
  obligation.kind = "locked";
  obligation.text = std::move(text);
  obligation.where =
      now != nullptr ? now->obligation.where : place_of(*report.program);
  obligation.property = property;
  result.verdict = verdict;
  result.reason = std::move(reason);
  if (now != nullptr) result.engine = now->engine;
  report.results.push_back(std::move(result));
}

/// A property that stands for what has none: it says nothing.
std::uint32_t add_empty(FileReport& report, const std::string& name) {
  report.properties.properties.push_back(make_property(
      *report.program, Property::Form::Always, name, "as locked", {}));
  return static_cast<std::uint32_t>(report.properties.properties.size() - 1);
}

void compare_settings(const LockedProgram& locked, FileReport& report) {
  const ScanInterval& scan = report.program->scan;
  const bool is_same = locked.semantics == report.semantics &&
                       locked.scan_min_ms == scan.min_ms &&
                       locked.scan_max_ms == scan.max_ms;
  if (is_same) return;
  add_result(
      report, add_empty(report, "settings"), "settings",
      "semantics and scan interval are as locked", Verdict::Violated,
      fmt::format("they were {}, {}..{} ms and are {}, {}..{} ms",
                  locked.semantics, locked.scan_min_ms, locked.scan_max_ms,
                  report.semantics, scan.min_ms, scan.max_ms),
      nullptr);
}

void compare_verdicts(const LockedProgram& locked, FileReport& report) {
  std::map<std::string, std::size_t> now;
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const Obligation& obligation = report.results[i].obligation;
    if (obligation.built_in || is_ours(obligation)) continue;
    now.emplace(said(obligation, report.properties), i);
  }
  std::vector<std::string> fresh;
  for (const auto& [text, index] : now) {
    if (locked.verdicts.count(text) == 0) fresh.push_back(text);
  }
  if (!fresh.empty()) {
    report.notes.push_back(
        fmt::format("not in the lock, so not compared with it: `{}`",
                    fmt::join(fresh, "`, `")));
  }
  for (const auto& [text, verdict] : locked.verdicts) {
    const auto found = now.find(text);
    if (found == now.end()) {
      add_result(
          report, add_empty(report, "gone"), "gone", text, Verdict::Violated,
          "the lock has it as " + verdict + ", the program no longer", nullptr);
      continue;
    }
    const ObligationResult result = report.results[found->second];
    if (to_string(result.verdict) == verdict) continue;
    const bool is_open = result.verdict == Verdict::Unknown ||
                         result.verdict == Verdict::Bounded;
    add_result(report, add_empty(report, "verdict"), result.obligation.name,
               text, is_open ? Verdict::Unknown : Verdict::Violated,
               fmt::format("it was {} when locked and is {} now", verdict,
                           to_string(result.verdict)),
               &result);
  }
}

void compare_outputs(const LockedProgram& locked, FileReport& report) {
  std::string not_listed;
  const auto now = output_groups(*report.program, not_listed);
  std::vector<std::vector<std::string>> before;
  for (const OutputGroup& group : locked.groups) {
    before.push_back(group.outputs);
  }
  if (now == before) return;
  const auto names = [](const std::vector<std::vector<std::string>>& groups) {
    std::vector<std::string> all;
    for (const auto& group : groups)
      all.insert(all.end(), group.begin(), group.end());
    return fmt::format("{}", fmt::join(all, " "));
  };
  add_result(report, add_empty(report, "outputs"), "outputs",
             "the outputs are as locked", Verdict::Violated,
             fmt::format("they were {} and are {}", names(before), names(now)),
             nullptr);
}

}  // namespace

Behaviour measure(const FileReport& report, const VerifyOptions& options) {
  const Program& program = *report.program;
  Behaviour behaviour;
  LockedProgram& locked = behaviour.locked;
  locked.semantics = report.semantics;
  locked.scan_min_ms = program.scan.min_ms;
  locked.scan_max_ms = program.scan.max_ms;
  PropertySet asked = report.properties;
  std::erase_if(asked.properties,
                [](const Property& property) { return property.built_in; });
  for (auto& outputs : output_groups(program, locked.not_listed)) {
    OutputGroup& group = locked.groups.emplace_back();
    group.outputs = std::move(outputs);
    for (const std::string& one : all_combinations(group.outputs.size())) {
      Property property =
          make_property(program, Property::Form::Reach,
                        fmt::format("{}.{}", locked.groups.size() - 1, one),
                        one, {formula_of(group.outputs, one)});
      property.built_in = true;
      asked.properties.push_back(std::move(property));
    }
  }
  locked.slice = slice_of(program, asked);
  VerifyReport answer = verify(program, asked, options);
  behaviour.failures = std::move(answer.failures);
  for (const ObligationResult& result : answer.results) {
    const Obligation& obligation = result.obligation;
    const bool is_open = result.verdict == Verdict::Unknown ||
                         result.verdict == Verdict::Bounded;
    if (is_open) {
      behaviour.open.push_back(fmt::format(
          "`{}` is {}", is_ours(obligation) ? obligation.name : obligation.text,
          to_string(result.verdict)));
    }
    if (!is_ours(obligation)) {
      locked.verdicts[said(obligation, asked)] = to_string(result.verdict);
    } else if (result.verdict == Verdict::Proved) {
      const std::size_t group =
          static_cast<std::size_t>(obligation.name[kPrefix.size()] - '0');
      locked.groups[group].combinations.push_back(obligation.text);
    }
  }
  measure_responses(report, options, behaviour);
  return behaviour;
}

void add_locked(const LockedProgram& locked, FileReport& report) {
  const Program& program = *report.program;
  std::vector<Property>& properties = report.properties.properties;
  std::string ignored;
  const auto now = output_groups(program, ignored);
  for (std::size_t i = 0; i < locked.groups.size(); ++i) {
    const OutputGroup& group = locked.groups[i];
    if (i >= now.size() || now[i] != group.outputs) continue;
    std::string any;
    for (const std::string& one : group.combinations) {
      any +=
          (any.empty() ? "(" : " || (") + formula_of(group.outputs, one) + ")";
      Property still = make_property(
          program, Property::Form::Reach, fmt::format("{}.{}", i, one),
          fmt::format("as locked, `{}` occurs", formula_of(group.outputs, one)),
          {formula_of(group.outputs, one)});
      still.built_in = true;
      properties.push_back(std::move(still));
    }
    if (group.combinations.size() == std::size_t{1} << group.outputs.size()) {
      continue;
    }
    properties.push_back(make_property(
        program, Property::Form::Always, fmt::format("{}.others", i),
        fmt::format("as locked, no other combination of {} occurs",
                    fmt::join(group.outputs, " ")),
        {any}));
  }
  for (const LockedResponse& response : locked.responses) {
    // Its formulas are read of the program's own lines, never of the lock.
    if (!asks_for(report.properties, response)) continue;
    const std::size_t number = properties.size();
    const auto bound = [&](std::string_view unit, std::int64_t most) {
      Property property = make_property(
          program, Property::Form::After,
          fmt::format("response{}.{}", number, unit),
          fmt::format("as locked: after {}, {} within {} {}", response.cause,
                      response.response, most, unit),
          {response.cause, response.response});
      (unit == "ms" ? property.milliseconds : property.scans) = most;
      properties.push_back(std::move(property));
    };
    if (response.milliseconds) bound("ms", *response.milliseconds);
    if (response.scans) bound("scans", *response.scans);
  }
}

void compare_locked(const LockedProgram* locked, FileReport& report) {
  if (locked == nullptr) {
    add_result(report, add_empty(report, "program"), "program",
               "the lock has this program", Verdict::Violated,
               "it has not: `rungproof lock --update` puts it in", nullptr);
    return;
  }
  compare_settings(*locked, report);
  compare_outputs(*locked, report);
  compare_verdicts(*locked, report);
  for (const LockedResponse& response : locked->responses) {
    if (asks_for(report.properties, response)) continue;
    add_result(report, add_empty(report, "response"), "response",
               fmt::format("after {}, {}", response.cause, response.response),
               Verdict::Violated,
               "the lock has bounds of it, and no property asks for it now",
               nullptr);
  }
}

}  // namespace rung
