#include "smt/repair.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "smt/edits.h"
#include "smt/sat.h"

namespace rung {
namespace {

struct Candidate {
  RungId rung;
  std::string edit;
  SourceRange where;
  Program program;
};

std::string contact(const Program& program, CellId cell, bool negated) {
  return (negated ? "!" : "") + program.cells[cell].name;
}

/// All candidates, one at a time.
class Candidates {
 public:
  Candidates(const Program& program, const std::vector<RungId>& rungs,
             const std::vector<CellId>& named)
      : program_(program) {
    for (const bool series : {true, false}) {
      for (const bool negated : {series, !series}) {
        for (const RungId rung : rungs) {
          for (const CellId cell : named) {
            add_contact(rung, cell, series, negated);
          }
        }
      }
    }
    for (const RungId rung : rungs) {
      for (std::uint32_t i = program.rungs[rung].begin;
           i < program.rungs[rung].end; ++i) {
        change_contact(rung, i);
      }
    }
    std::stable_sort(
        ways_.begin(), ways_.end(),
        [](const Way& a, const Way& b) { return a.kind < b.kind; });
  }

  std::size_t size() const { return ways_.size(); }
  Candidate make(std::size_t number) const {
    const Way& way = ways_[number];
    Candidate result = {way.rung, {}, program_.rungs[way.rung].where, program_};
    const std::string name = contact(program_, way.cell, way.negated);
    switch (way.kind) {
      case Kind::Series:
        result.edit = "`&& " + name + "` in series with the rung";
        append_contact(result.program, way.rung, way.cell, way.negated,
                       NodeOp::And);
        break;
      case Kind::Parallel:
        result.edit = "`|| " + name + "` parallel to the rung";
        append_contact(result.program, way.rung, way.cell, way.negated,
                       NodeOp::Or);
        break;
      case Kind::Remove:
        result.edit = "without the contact `" + name + "`";
        result.where = program_.nodes[way.node].where;
        replace_by_constant(result.program, way.node, way.value);
        break;
      case Kind::Negate:
        result.edit = "the contact `" + name + "` negated";
        result.where = program_.nodes[way.node].where;
        negate_node(result.program, way.node);
        break;
    }
    return result;
  }

 private:
  enum class Kind : std::uint8_t { Series, Parallel, Remove, Negate };
  struct Way {
    Kind kind = Kind::Series;
    RungId rung;
    CellId cell;
    bool negated = false;
    std::uint32_t node = 0;  // Remove, Negate
    bool value = false;      // Remove: what stands for the contact then
  };

  void add_contact(RungId rung, CellId cell, bool series, bool negated) {
    const Rung& changed = program_.rungs[rung];
    const bool bit = program_.nodes[changed.root()].type == Type::Bit;
    if (!bit || changed.target == cell) return;
    ways_.push_back(
        {series ? Kind::Series : Kind::Parallel, rung, cell, negated});
  }

  /// A contact that is left out of a series conducts, of a parallel one not.
  void change_contact(RungId rung, std::uint32_t node) {
    const Node& read = program_.nodes[node];
    if (read.op != NodeOp::Read || read.type != Type::Bit) return;
    bool negated = false;
    std::uint32_t used = node;
    for (std::uint32_t i = node + 1; i < program_.rungs[rung].end; ++i) {
      const Node& user = program_.nodes[i];
      if (user.op == NodeOp::Not && user.a == used) {
        used = i;
        negated = !negated;
        continue;
      }
      const bool takes = user.a == used || user.b == used;
      const bool joins = user.op == NodeOp::And || user.op == NodeOp::Or;
      if (!takes || !joins) continue;
      ways_.push_back({Kind::Remove, rung, read.cell, negated, used,
                       user.op == NodeOp::And});
      break;
    }
    ways_.push_back({Kind::Negate, rung, read.cell, false, node});
  }

  const Program& program_;
  std::vector<Way> ways_;
};

class RepairSearch {
 public:
  RepairSearch(const Program& program, const PropertySet& properties,
               const std::vector<ObligationResult>& before,
               const ObligationResult& violated, std::uint32_t property,
               const VerifyOptions& options, double seconds)
      : program_(program),
        properties_(properties),
        violated_(violated),
        property_(property),
        options_(options),
        deadline_(seconds) {
    options_.smtlib_directory.clear();
    options_.progress = nullptr;
    options_.budget.seconds = std::min(options_.budget.seconds, kOneTry);
    for (const ObligationResult& result : before) {
      verdict_[result.obligation.name] = result.verdict;
    }
  }

  std::optional<Repair> run(RungId blamed) {
    const std::vector<CellId> named =
        named_bits(program_, properties_.properties[property_]);
    const std::vector<RungId> rungs = writers(named, blamed);
    const Candidates candidates(program_, rungs, named);
    const Stimulus stimulus =
        violated_.trace ? stimulus_of(program_, *violated_.trace) : Stimulus();
    std::optional<Repair> best;
    std::size_t best_left = 0;  // violations with it
    for (std::size_t i = 0, more = 0; i < candidates.size(); ++i) {
      if (deadline_.passed() || (best && ++more > kMore)) break;
      Candidate candidate = candidates.make(i);
      if (!avoids(candidate.program, stimulus)) continue;
      if (!is_proved(candidate.program)) continue;
      const std::optional<std::size_t> left = left_over(candidate.program);
      if (!left || (best && *left >= best_left)) continue;
      best_left = *left;
      best =
          Repair{candidate.rung, std::move(candidate.edit), candidate.where,
                 std::make_shared<const Program>(std::move(candidate.program))};
      if (best_left == 0) break;
    }
    return best;
  }

 private:
  static constexpr double kOneTry = 2;
  static constexpr std::size_t kMore = 32;  // candidates, once there is one

  /// The rungs that write a bit of the property, the one to blame first.
  std::vector<RungId> writers(const std::vector<CellId>& named,
                              RungId blamed) const {
    std::vector<RungId> rungs;
    if (blamed.has_value()) rungs.push_back(blamed);
    for (const RungId id : ids_of(program_.rungs)) {
      const bool writes = std::find(named.begin(), named.end(),
                                    program_.rungs[id].target) != named.end();
      if (writes && id != blamed) rungs.push_back(id);
    }
    return rungs;
  }

  /// Does the run that was found end well in the changed program?
  bool avoids(const Program& changed, const Stimulus& stimulus) const {
    const Replay replayed = replay(changed, properties_, property_,
                                   violated_.obligation.part, stimulus);
    return replayed.decided_at == 0;
  }

  bool is_proved(const Program& changed) const {
    VerifyOptions one = options_;
    one.wanted = [this](std::string_view name) {
      return name == violated_.obligation.name;
    };
    const VerifyReport report = verify(changed, properties_, one);
    return report.failures.empty() && report.results.size() == 1 &&
           report.results.front().verdict == Verdict::Proved;
  }

  /// How many violations are left; no value when something proved is lost.
  std::optional<std::size_t> left_over(const Program& changed) const {
    VerifyOptions all = options_;
    all.wanted = nullptr;
    const VerifyReport report = verify(changed, properties_, all);
    if (!report.failures.empty()) return std::nullopt;
    std::size_t left = 0;
    for (const ObligationResult& result : report.results) {
      const auto old = verdict_.find(result.obligation.name);
      const bool needed = old == verdict_.end() ||
                          old->second == Verdict::Proved ||
                          old->first == violated_.obligation.name;
      if (needed && result.verdict != Verdict::Proved) return std::nullopt;
      if (result.verdict == Verdict::Violated) ++left;
    }
    return left;
  }

  const Program& program_;
  const PropertySet& properties_;
  const ObligationResult& violated_;
  std::uint32_t property_;
  VerifyOptions options_;
  Deadline deadline_;
  std::map<std::string, Verdict> verdict_;  // before, by name
};

}  // namespace

std::optional<Repair> find_repair(const Program& program,
                                  const PropertySet& properties,
                                  const std::vector<ObligationResult>& before,
                                  const ObligationResult& violated,
                                  std::uint32_t property, RungId blamed,
                                  const VerifyOptions& options,
                                  double seconds) {
  return RepairSearch(program, properties, before, violated, property, options,
                      seconds)
      .run(blamed);
}

}  // namespace rung
