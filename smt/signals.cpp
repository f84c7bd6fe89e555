#include "smt/signals.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "base/text.h"

namespace rung {
namespace {

using Names = std::unordered_map<std::string_view, CellId>;

Names names_of(const Program& program) {
  Names names;
  for (const CellId id : ids_of(program.cells)) {
    names.emplace(program.cells[id].name, id);
  }
  return names;
}

std::string range_of(const Cell& cell) {
  if (cell.type == Type::Bit) return "a bit";
  return "a word in " + std::to_string(cell.low) + ".." +
         std::to_string(cell.high);
}

class Matcher {
 public:
  Matcher(const Program& a, const Program& b)
      : a_(a),
        b_(b),
        partner_of_a_(a.cells.size()),
        partner_of_b_(b.cells.size()),
        mapped_(a.cells.size(), false) {}

  SharedSignals match(
      const std::vector<std::pair<std::string, std::string>>& map) {
    if (a_.scan.min_ms != b_.scan.min_ms || a_.scan.max_ms != b_.scan.max_ms) {
      fail("the scan takes " + interval(a_.scan) +
           " in the first program and " + interval(b_.scan) + " in the second");
    }
    match_by_map(map);
    match_by_name();
    for (const CellId id : ids_of(a_.cells)) place_first(id);
    for (const CellId id : ids_of(b_.cells)) place_second(id);
    if (shared_.outputs.empty()) {
      fail("the two programs share no output: name pairs with --map");
    }
    return std::move(shared_);
  }

 private:
  void fail(std::string why) {
    if (shared_.error.empty()) shared_.error = std::move(why);
  }

  static std::string interval(const ScanInterval& scan) {
    return std::to_string(scan.min_ms) + ".." + std::to_string(scan.max_ms) +
           " ms";
  }

  CellId look_up(const Names& names, const Program& program,
                 const std::string& name, std::string_view which) {
    const auto found = names.find(name);
    if (found != names.end()) return found->second;
    std::vector<std::string_view> all;
    for (const Cell& cell : program.cells) all.emplace_back(cell.name);
    std::string why = "`" + name;
    why += "` is no signal of the ";
    why += which;
    why += " program";
    why += did_you_mean(name, all);
    fail(std::move(why));
    return {};
  }

  void match_by_map(
      const std::vector<std::pair<std::string, std::string>>& map) {
    const Names names_a = names_of(a_);
    const Names names_b = names_of(b_);
    for (const auto& [first, second] : map) {
      const CellId a = look_up(names_a, a_, first, "first");
      const CellId b = look_up(names_b, b_, second, "second");
      if (!a.has_value() || !b.has_value()) continue;
      if (partner_of_a_[a.index()].has_value() ||
          partner_of_b_[b.index()].has_value()) {
        std::string why = "the map names `" + first;
        why += "` or `" + second;
        fail(why += "` twice");
      }
      join(a, b);
      mapped_[a.index()] = true;
    }
  }

  void match_by_name() {
    const Names names_b = names_of(b_);
    for (const CellId a : ids_of(a_.cells)) {
      if (partner_of_a_[a.index()].has_value()) continue;
      const auto found = names_b.find(a_.cells[a].name);
      if (found == names_b.end()) continue;
      if (partner_of_b_[found->second.index()].has_value()) continue;
      join(a, found->second);
    }
  }

  void join(CellId a, CellId b) {
    partner_of_a_[a.index()] = b;
    partner_of_b_[b.index()] = a;
  }

  void place_first(CellId a) {
    const Cell& cell = a_.cells[a];
    const CellId b = partner_of_a_[a.index()];
    if (!b.has_value()) {
      if (cell.role == CellRole::Input) shared_.inputs.push_back({a, {}});
      if (cell.role == CellRole::Output)
        shared_.alone.push_back("a." + cell.name);
      return;
    }
    const Cell& other = b_.cells[b];
    const bool is_input = cell.role == CellRole::Input;
    if (is_input != (other.role == CellRole::Input)) {
      fail("`" + cell.name + "` is an input of the " +
           (is_input ? "first" : "second") + " program only; the " +
           (is_input ? "second" : "first") + " writes it");
    } else if (is_input) {
      require_same(cell, other, true);
      shared_.inputs.push_back({a, b});
    } else if (mapped_[a.index()] || (cell.role == CellRole::Output &&
                                      other.role == CellRole::Output)) {
      require_same(cell, other, false);
      shared_.outputs.push_back({a, b});
    } else {
      shared_.cells.push_back({a, b});
      note_half_output(cell, other);
    }
  }

  /// An output here, a memory cell there: not compared, but said.
  void note_half_output(const Cell& cell, const Cell& other) {
    if (cell.role == CellRole::Output)
      shared_.alone.push_back("a." + cell.name);
    if (other.role == CellRole::Output) {
      shared_.alone.push_back("b." + other.name);
    }
  }

  void place_second(CellId b) {
    if (partner_of_b_[b.index()].has_value()) return;
    const Cell& cell = b_.cells[b];
    if (cell.role == CellRole::Input) shared_.inputs.push_back({{}, b});
    if (cell.role == CellRole::Output)
      shared_.alone.push_back("b." + cell.name);
  }

  void require_same(const Cell& cell, const Cell& other, bool also_range) {
    if (cell.type == other.type &&
        (!also_range || (cell.low == other.low && cell.high == other.high))) {
      return;
    }
    fail("`" + cell.name + "` is " + range_of(cell) +
         " in the first program and " + range_of(other) + " in the second");
  }

  const Program& a_;
  const Program& b_;
  std::vector<CellId> partner_of_a_;
  std::vector<CellId> partner_of_b_;
  std::vector<bool> mapped_;  // by cell of the first program
  SharedSignals shared_;
};

/// The least cap with which the instances' own comparisons are exact.
std::vector<std::int64_t> own_caps(const Program& program) {
  std::vector<std::int64_t> caps(program.instances.size(), 1);
  for (const ElementCall& call : program.calls) {
    std::int64_t& cap = caps[call.instance.index()];
    cap = std::max(cap, call.parameter + 1);
  }
  return caps;
}

/// A value that timers share which do the same by comparisons that differ a
/// little (`> 999`, `>= 1000`), whatever they are called.
std::int64_t rounded_cap(std::int64_t cap) {
  std::int64_t rounded = 7;
  while (rounded < cap + 7) rounded = 2 * rounded + 1;
  return rounded;
}

}  // namespace

SharedSignals share_signals(
    const Program& a, const Program& b,
    const std::vector<std::pair<std::string, std::string>>& map) {
  return Matcher(a, b).match(map);
}

std::pair<Program, Program> with_common_caps(const Program& a,
                                             const Program& b) {
  std::pair<Program, Program> both(a, b);
  for (Program* program : {&both.first, &both.second}) {
    const std::vector<std::int64_t> caps = own_caps(*program);
    for (const InstanceId id : ids_of(program->instances)) {
      program->instances[id].clock_cap = rounded_cap(caps[id.index()]);
    }
  }
  return both;
}

namespace {

constexpr std::uint32_t kNoState = 0xffff'ffff;

std::vector<std::uint32_t> states_of_cells(const Program& program,
                                           const TransitionSystem& ts) {
  std::vector<std::uint32_t> states(program.cells.size(), kNoState);
  for (std::uint32_t i = 0; i < ts.states.size(); ++i) {
    const CellId cell = ts.vars[ts.states[i].var].cell;
    if (cell.has_value()) states[cell.index()] = i;
  }
  return states;
}

}  // namespace

std::vector<StatePair> states_by_name(const Program& a, const Program& b,
                                      const TransitionSystem& ts_a,
                                      const TransitionSystem& ts_b,
                                      const SharedSignals& shared) {
  std::vector<StatePair> pairs;
  const auto add = [&](std::uint32_t first, std::uint32_t second) {
    if (first == kNoState || second == kNoState) return;
    const State& x = ts_a.states[first];
    const State& y = ts_b.states[second];
    if (x.init != y.init || ts_a.vars[x.var].type != ts_b.vars[y.var].type) {
      return;
    }
    pairs.push_back({first, second});
  };
  const auto cells_a = states_of_cells(a, ts_a);
  const auto cells_b = states_of_cells(b, ts_b);
  for (const auto* list : {&shared.outputs, &shared.cells}) {
    for (const SignalPair& pair : *list) {
      add(cells_a[pair.a.index()], cells_b[pair.b.index()]);
    }
  }
  std::unordered_map<std::string_view, InstanceId> instances;
  for (const InstanceId id : ids_of(b.instances)) {
    instances.emplace(b.instances[id].name, id);
  }
  for (const InstanceId id : ids_of(a.instances)) {
    const auto found = instances.find(a.instances[id].name);
    if (found == instances.end()) continue;
    if (b.instances[found->second].kind != a.instances[id].kind) continue;
    const auto& first = ts_a.instance_states[id.index()];
    const auto& second = ts_b.instance_states[found->second.index()];
    for (std::size_t i = 0; i < first.size(); ++i) add(first[i], second[i]);
  }
  return pairs;
}

}  // namespace rung
