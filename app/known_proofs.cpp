#include "app/known_proofs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/explanation.h"
#include "analysis/simulator.h"
#include "app/certificate_names.h"
#include "app/packed_result.h"
#include "smt/slices.h"

namespace rung {
namespace {

/// No other budget, engine or machine would say otherwise.
bool is_decided(const ObligationResult& result) {
  switch (result.verdict) {
    case Verdict::Proved:
      return result.reason.empty();
    case Verdict::Violated:
    case Verdict::Vacuous:
      return true;
    case Verdict::Bounded:
    case Verdict::Unknown:
      break;
  }
  return false;
}

/// Where a run comes back to, or what it cannot get back to, is more than its
/// last scan: executing it again would not show that.
bool shows_itself(const ObligationResult& result) {
  return result.obligation.goal == Goal::Invariant ||
         result.obligation.goal == Goal::Reach;
}

class Knowledge {
 public:
  Knowledge(const Program& program, const PropertySet& properties)
      : program_(program),
        properties_(properties),
        ts_(build_transition_system(program)),
        obligations_(make_obligations(program, properties, ts_)),
        slices_(ts_, properties, obligations_),
        names_(ts_) {
    for (const Obligation& obligation : obligations_) {
      ++count_[obligation.name];
    }
  }

  /// Of `wanted` ones, all that `known` has.
  std::vector<ObligationResult> recall(
      std::string_view known,
      const std::function<bool(std::string_view)>& wanted) const {
    const Packed packed = from_bytes(known);
    std::vector<ObligationResult> found;
    try {
      if (packed.is_null()) return {};
      const auto cells = packed.at(0).get<std::vector<std::string>>();
      for (const Obligation& obligation : obligations_) {
        const bool is_one = count_.at(obligation.name) == 1;
        if (!is_one || (wanted && !wanted(obligation.name))) continue;
        const auto entry = packed.at(1).find(to_string(slices_.of(obligation)));
        if (entry == packed.at(1).end()) continue;
        auto result = revive(*entry, cells, obligation);
        if (result) found.push_back(std::move(*result));
      }
    } catch (const std::exception&) {
      return {};  // it is something else
    }
    return found;
  }

  std::string remember(const std::vector<ObligationResult>& results) const {
    std::map<std::string_view, const Obligation*> by_name;
    for (const Obligation& obligation : obligations_) {
      by_name.emplace(obligation.name, &obligation);
    }
    Packed entries = Packed::object();
    for (const ObligationResult& result : results) {
      const auto found = by_name.find(result.obligation.name);
      if (found == by_name.end() || !is_decided(result)) continue;
      if (count_.at(found->second->name) != 1) continue;
      if (result.trace && !shows_itself(result)) continue;
      Packed named = named_slices(result);
      if (named.is_null()) continue;
      entries[to_string(slices_.of(*found->second))] =
          Packed::array({pack_result(result), std::move(named)});
    }
    Packed cells = Packed::array();
    for (const Cell& cell : program_.cells) cells.push_back(cell.name);
    return to_bytes(Packed::array({std::move(cells), std::move(entries)}));
  }

  /// Are there no others that are wanted?
  bool is_all(const std::set<std::string>& taken,
              const std::function<bool(std::string_view)>& wanted) const {
    return std::all_of(obligations_.begin(), obligations_.end(),
                       [&](const Obligation& obligation) {
                         return taken.count(obligation.name) != 0 ||
                                (wanted && !wanted(obligation.name));
                       });
  }

 private:
  /// What the certificate names: as it is printed, as slices name it, and what
  /// it depends on. Null where that cannot be told.
  Packed named_slices(const ObligationResult& result) const {
    Packed named = Packed::array();
    if (!result.certificate) return named;
    if (!result.certificate->smtlib_path.empty()) return nullptr;
    for (const VarId var : names_.in(*result.certificate)) {
      const auto slice = slices_.of(var);
      if (!slice) return nullptr;
      named.push_back(Packed::array(
          {ts_.vars[var].name, slices_.name(var), to_string(*slice)}));
    }
    return named;
  }

  std::optional<ObligationResult> revive(const Packed& entry,
                                         const std::vector<std::string>& cells,
                                         const Obligation& obligation) const {
    ObligationResult result = unpack_result(entry.at(0), cells.size());
    result.obligation = obligation;
    if (!is_decided(result)) return std::nullopt;
    if (result.certificate && !adapt(*result.certificate, entry.at(1))) {
      return std::nullopt;
    }
    if (result.trace && !execute(result, cells)) return std::nullopt;
    return result;
  }

  bool adapt(Certificate& certificate, const Packed& named) const {
    NewNames new_names;
    for (const Packed& one : named) {
      const auto var = slices_.find(one.at(1).get<std::string>());
      if (!var) return false;
      const auto slice = slices_.of(*var);
      if (!slice || to_string(*slice) != one.at(2)) return false;
      const auto printed = one.at(0).get<std::string>();
      const std::string& now = ts_.vars[*var].name;
      if (printed != now) new_names.emplace_back(printed, now);
    }
    rename(certificate, new_names);
    return true;
  }

  /// Inputs that the run does not know rest, as in any run that an engine
  /// finds.
  bool execute(ObligationResult& result,
               const std::vector<std::string>& cells) const {
    std::unordered_map<std::string_view, std::size_t> column;
    for (std::size_t i = 0; i < cells.size(); ++i) column[cells[i]] = i;
    Trace known = *result.trace;
    for (Trace::Step& step : known.steps) {
      std::vector<std::int64_t> values;
      for (const Cell& cell : program_.cells) {
        const auto found = column.find(cell.name);
        const std::int64_t value =
            found == column.end() ? 0 : step.values[found->second];
        values.push_back(std::clamp(value, cell.low, cell.high));
      }
      step.values = std::move(values);
    }
    if (known.loop || known.steps.empty()) return false;
    const Stimulus stimulus = stimulus_of(program_, known);
    const Obligation& obligation = result.obligation;
    const Replay run = replay(program_, properties_, obligation.property,
                              obligation.part, stimulus);
    if (!run.assumptions_hold || run.decided_at != result.scans) return false;
    result.trace = simulate_changes(program_, stimulus);
    return result.trace->steps.back().scan == result.scans;
  }

  const Program& program_;
  const PropertySet& properties_;
  TransitionSystem ts_;
  std::vector<Obligation> obligations_;
  Slices slices_;
  CertificateNames names_;
  std::unordered_map<std::string_view, int> count_;  // by name
};

bool asks_what_settles(const PropertySet& properties) {
  return std::any_of(properties.properties.begin(), properties.properties.end(),
                     [](const Property& property) {
                       return property.form == Property::Form::Settles;
                     });
}

}  // namespace

KnownProofs verify_unknown(const Program& program,
                           const PropertySet& properties,
                           const VerifyOptions& options, std::string& known) {
  const Knowledge knowledge(program, properties);
  KnownProofs proofs;
  std::vector<ObligationResult> recalled =
      knowledge.recall(known, options.wanted);
  proofs.taken = recalled.size();
  std::set<std::string> taken;
  for (const ObligationResult& result : recalled) {
    taken.insert(result.obligation.name);
  }
  VerifyOptions rest = options;
  rest.wanted = [&](std::string_view name) {
    return taken.count(std::string(name)) == 0 &&
           (!options.wanted || options.wanted(name));
  };
  if (!knowledge.is_all(taken, options.wanted) ||
      asks_what_settles(properties)) {
    proofs.report = verify(program, properties, rest);
  }
  std::vector<ObligationResult>& results = proofs.report.results;
  results.insert(results.end(), std::make_move_iterator(recalled.begin()),
                 std::make_move_iterator(recalled.end()));
  std::stable_sort(results.begin(), results.end(),
                   [](const ObligationResult& a, const ObligationResult& b) {
                     return std::pair(a.obligation.property,
                                      a.obligation.part) <
                            std::pair(b.obligation.property, b.obligation.part);
                   });
  // What was not asked now may still be known.
  if (!options.wanted) known = knowledge.remember(results);
  return proofs;
}

}  // namespace rung
