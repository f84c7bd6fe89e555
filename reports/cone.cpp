#include "reports/cone.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace rung {
namespace {

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

/// The words of a formula. An instance is one: `T(0)` of `T(0).q`.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  bool next(std::string_view& word) {
    while (at_ < text_.size() && !is_word(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    word = text_.substr(begin, at_ - begin);
    return !word.empty();
  }

  /// The word just read with the parentheses behind it, if it has any.
  std::string_view with_index(std::string_view word) const {
    if (at_ >= text_.size() || text_[at_] != '(') return word;
    const std::size_t close = text_.find(')', at_);
    if (close == std::string_view::npos) return word;
    return text_.substr(at_ - word.size(), close + 1 - (at_ - word.size()));
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

template <class IdT>
void sort_unique(std::vector<IdT>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

Cones::Cones(const Program& program)
    : program_(program),
      writers_(program.cells.size()),
      callers_(program.instances.size()) {
  for (const CellId id : ids_of(program.cells)) {
    cells_.emplace(program.cells[id].name, id);
  }
  for (const InstanceId id : ids_of(program.instances)) {
    instances_.emplace(program.instances[id].name, id);
  }
  for (const RungId id : ids_of(program.rungs)) {
    const Rung& rung = program.rungs[id];
    writers_[rung.target.index()].push_back(id);
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      if (program.nodes[i].op != NodeOp::Call) continue;
      const ElementCall& call = program.calls[program.nodes[i].call];
      callers_[call.instance.index()].push_back(id);
    }
  }
}

Cones::Found Cones::look_up(std::span<const std::string> formulas) const {
  Found found;
  for (const std::string& formula : formulas) {
    Words words(formula);
    for (std::string_view word; words.next(word);) {
      const auto instance = instances_.find(words.with_index(word));
      if (instance != instances_.end()) {
        found.instances.push_back(instance->second);
      }
      const auto cell = cells_.find(word);
      if (cell != cells_.end()) found.cells.push_back(cell->second);
    }
  }
  sort_unique(found.cells);
  return found;
}

std::vector<CellId> Cones::named(std::span<const std::string> formulas) const {
  return look_up(formulas).cells;
}

std::vector<CellId> Cones::of(std::span<const std::string> formulas) const {
  const Found roots = look_up(formulas);
  std::unordered_set<CellId> cells(roots.cells.begin(), roots.cells.end());
  std::unordered_set<InstanceId> instances;
  std::unordered_set<RungId> rungs;
  std::vector<RungId> work;
  const auto enter = [&](const std::vector<RungId>& more) {
    for (const RungId id : more) {
      if (rungs.insert(id).second) work.push_back(id);
    }
  };
  for (const CellId cell : roots.cells) enter(writers_[cell.index()]);
  for (const InstanceId id : roots.instances) {
    if (instances.insert(id).second) enter(callers_[id.index()]);
  }
  while (!work.empty()) {
    const Rung& rung = program_.rungs[work.back()];
    work.pop_back();
    for (std::uint32_t i = rung.begin; i < rung.end; ++i) {
      const Node& node = program_.nodes[i];
      if (node.op == NodeOp::Read && cells.insert(node.cell).second) {
        enter(writers_[node.cell.index()]);
      } else if (node.op == NodeOp::Call) {
        const InstanceId id = program_.calls[node.call].instance;
        if (instances.insert(id).second) enter(callers_[id.index()]);
      }
    }
  }
  std::vector<CellId> out(cells.begin(), cells.end());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<RungId> Cones::drivers(std::span<const CellId> cells) const {
  std::vector<RungId> out;
  for (const CellId cell : cells) {
    const std::vector<RungId>& writers = writers_[cell.index()];
    out.insert(out.end(), writers.begin(), writers.end());
  }
  sort_unique(out);
  return out;
}

}  // namespace rung
