#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/lsp/features.h"

namespace rung::lsp {
namespace {

/// Is one program the other but for the name of one cell? Places are left out:
/// a longer name moves them.
class SameButRenamed {
 public:
  SameButRenamed(const Snapshot& before, const Snapshot& after, CellId renamed,
                 std::string_view name)
      : before_(before), after_(after), renamed_(renamed), name_(name) {}

  bool check() const {
    const Program& a = *before_.program();
    const Program& b = *after_.program();
    if (a.language != b.language || a.dialect != b.dialect ||
        a.evaluation != b.evaluation || a.scan.min_ms != b.scan.min_ms ||
        a.scan.max_ms != b.scan.max_ms) {
      return false;
    }
    return same_cells(a, b) && same_instances(a, b) && same_calls(a, b) &&
           same_nodes(a, b) && same_rungs(a, b) && same_plants(a, b) &&
           same_properties();
  }

 private:
  template <class List, class Same>
  static bool all_same(const List& a, const List& b, Same same) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  }

  bool same_cells(const Program& a, const Program& b) const {
    if (a.cells.size() != b.cells.size()) return false;
    for (const CellId id : ids_of(a.cells)) {
      const Cell& x = a.cells[id];
      const Cell& y = b.cells[id];
      const std::string_view wanted = id == renamed_ ? name_ : x.name;
      const bool same = y.name == wanted && x.type == y.type &&
                        x.role == y.role && x.initial == y.initial &&
                        x.low == y.low && x.high == y.high &&
                        x.plant_written == y.plant_written;
      if (!same) return false;
    }
    return true;
  }

  static bool same_instances(const Program& a, const Program& b) {
    return all_same(a.instances, b.instances,
                    [](const Instance& x, const Instance& y) {
                      return x.kind == y.kind && x.index == y.index &&
                             x.name == y.name && x.clock_cap == y.clock_cap;
                    });
  }

  static bool same_calls(const Program& a, const Program& b) {
    return all_same(
        a.calls, b.calls, [](const ElementCall& x, const ElementCall& y) {
          return x.instance == y.instance && x.operation == y.operation &&
                 x.parameter == y.parameter && x.arguments == y.arguments;
        });
  }

  static bool same_nodes(const Program& a, const Program& b) {
    return all_same(a.nodes, b.nodes, [](const Node& x, const Node& y) {
      return x.op == y.op && x.type == y.type && x.skip_when == y.skip_when &&
             x.a == y.a && x.b == y.b && x.target == y.target &&
             x.value == y.value && x.cell == y.cell && x.call == y.call;
    });
  }

  static bool same_rungs(const Program& a, const Program& b) {
    return all_same(a.rungs, b.rungs, [](const Rung& x, const Rung& y) {
      return x.target == y.target && x.begin == y.begin && x.end == y.end;
    });
  }

  bool same_name(std::string_view a, std::string_view b) const {
    return a == before_.program()->cells[renamed_].name ? b == name_ : a == b;
  }

  bool same_plants(const Program& a, const Program& b) const {
    const auto same = [this](const PlantStatement& x, const PlantStatement& y) {
      return x.kind == y.kind && same_name(x.target, y.target) &&
             x.value.begin == y.value.begin && x.value.end == y.value.end;
    };
    return all_same(a.plant.statements, b.plant.statements, same) &&
           all_same(a.plant.initials, b.plant.initials, same) &&
           all_same(a.plant.nodes, b.plant.nodes,
                    [this](const AstNode& x, const AstNode& y) {
                      return x.op == y.op && x.arguments == y.arguments &&
                             same_name(x.text, y.text);
                    });
  }

  /// Their formulas have the new name where they had the old one, for every
  /// mention was replaced; what is left to see is that they are as many.
  bool same_properties() const {
    const PropertySet& a = before_.loaded.report.properties;
    const PropertySet& b = after_.loaded.report.properties;
    return a.assumptions.size() == b.assumptions.size() &&
           all_same(a.properties, b.properties,
                    [](const Property& x, const Property& y) {
                      return x.form == y.form &&
                             (x.built_in || x.name == y.name) &&
                             x.formulas.size() == y.formulas.size();
                    });
  }

  const Snapshot& before_;
  const Snapshot& after_;
  CellId renamed_;
  std::string_view name_;
};

}  // namespace

Json rename_range_at(const View& view, std::uint32_t offset) {
  const Occurrence* const name = occurrence_at(view.snapshot, offset);
  return name == nullptr ? Json() : range_of(view, name->where);
}

Rename rename_at(const View& view, std::uint32_t offset,
                 const std::string& name, const Options& options) {
  const Snapshot& before = view.snapshot;
  if (before.program() == nullptr) {
    return {nullptr, "the text has errors: nothing can be renamed in it"};
  }
  const Occurrence* const here = occurrence_at(before, offset);
  if (here == nullptr) return {nullptr, "no signal is named here"};
  if (find_cell(*before.program(), name).has_value()) {
    return {nullptr, fmt::format("`{}` is another signal", name)};
  }
  Json edits = Json::array();
  std::string text;
  std::uint32_t from = 0;
  for (const Occurrence& it : before.occurrences) {
    if (it.cell != here->cell) continue;
    edits.push_back({{"range", range_of(view, it.where)}, {"newText", name}});
    text += before.text.text().substr(from, it.where.begin - from) + name;
    from = it.where.end;
  }
  text += before.text.text().substr(from);
  const auto after = take_snapshot(before.loaded.report.path, before.version,
                                   TextDocument(std::move(text)), options);
  if (after->program() == nullptr) {
    const auto& errors = after->loaded.report.findings;
    return {nullptr, errors.empty() ? "the program could not be read then"
                                    : errors.front().message};
  }
  if (!SameButRenamed(before, *after, here->cell, name).check()) {
    return {nullptr,
            fmt::format("with `{}` the program would not be the same", name)};
  }
  return {{{"changes", {{view.uri, std::move(edits)}}}}, ""};
}

}  // namespace rung::lsp
