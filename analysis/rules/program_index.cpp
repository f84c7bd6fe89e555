#include "analysis/rules/program_index.h"

#include <algorithm>
#include <string_view>

#include "analysis/node_operands.h"
#include "analysis/rules/components.h"

namespace rung {

Grouped::Grouped(std::size_t keys, const std::vector<Pair>& pairs)
    : starts_(keys + 1, 0), items_(pairs.size()) {
  for (const auto& [key, item] : pairs) ++starts_[key + 1];
  for (std::size_t i = 0; i < keys; ++i) starts_[i + 1] += starts_[i];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const auto& [key, item] : pairs) items_[next[key]++] = item;
}

namespace {

class Indexer {
 public:
  Indexer(const Program& program, ProgramIndex& index)
      : program_(program), index_(index) {}

  void run() {
    const std::size_t nodes = program_.nodes.size();
    index_.rung_of.resize(nodes);
    index_.first.resize(nodes);
    index_.parent.assign(nodes, ProgramIndex::kNone);
    index_.rung_of_call.resize(program_.calls.size());
    index_.reads_itself.resize(program_.rungs.size());
    for (const RungId id : ids_of(program_.rungs)) add_rung(id.index());
    index_.writers = Grouped(program_.cells.size(), writers_);
    index_.reads = Grouped(program_.cells.size(), reads_);
    index_.calls = Grouped(program_.instances.size(), calls_);
  }

 private:
  void add_rung(std::uint32_t rung) {
    const Rung& it = program_.rungs[RungId(rung)];
    writers_.emplace_back(it.target.index(), rung);
    for (std::uint32_t i = it.begin; i < it.end; ++i) {
      index_.rung_of[i] = rung;
      add_node(i, rung);
      const Node& node = program_.nodes[i];
      if (node.op == NodeOp::Read && node.cell == it.target) {
        index_.reads_itself[rung] = true;
      } else if (node.op == NodeOp::Read) {
        index_.read_by_others[node.cell.index()] = true;
      }
    }
  }

  void adopt(std::uint32_t parent, std::uint32_t child) {
    index_.parent[child] = parent;
    index_.first[parent] = std::min(index_.first[parent], index_.first[child]);
  }

  void add_node(std::uint32_t i, std::uint32_t rung) {
    const Node& node = program_.nodes[i];
    index_.first[i] = i;
    if (node.op == NodeOp::Read) reads_.emplace_back(node.cell.index(), i);
    if (node.op == NodeOp::Call) {
      const ElementCall& call = program_.calls[node.call];
      index_.rung_of_call[node.call.index()] = rung;
      if (!call.operation->reads) {
        calls_.emplace_back(call.instance.index(), node.call.index());
      }
      for (const std::uint32_t argument : call.arguments) adopt(i, argument);
    }
    const std::uint32_t count = operand_count(node.op);
    if (count > 0) adopt(i, node.a);
    if (count > 1) adopt(i, node.b);
  }

  const Program& program_;
  ProgramIndex& index_;
  std::vector<Grouped::Pair> writers_;
  std::vector<Grouped::Pair> reads_;
  std::vector<Grouped::Pair> calls_;
};

void mark(const ProgramIndex& index, std::string_view name,
          std::vector<bool>& flags) {
  const CellId cell = index.find(name);
  if (cell.has_value()) flags[cell.index()] = true;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_word_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_';
}

void mark_words(const ProgramIndex& index, std::string_view text,
                std::vector<bool>& flags) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    std::size_t end = begin;
    while (end < text.size() && is_word_char(text[end])) ++end;
    if (end > begin) mark(index, text.substr(begin, end - begin), flags);
    begin = end + 1;
  }
}

using InstanceNames = std::unordered_map<std::string_view, std::uint32_t>;

/// Names such as T(0) in a property line.
void mark_instances(const InstanceNames& names, std::string_view text,
                    std::vector<bool>& flags) {
  for (std::size_t close = text.find(')'); close != std::string_view::npos;
       close = text.find(')', close + 1)) {
    std::size_t begin = close;
    while (begin > 0 && is_digit(text[begin - 1])) --begin;
    if (begin == 0 || text[begin - 1] != '(') continue;
    --begin;
    while (begin > 0 && is_word_char(text[begin - 1])) --begin;
    const auto found = names.find(text.substr(begin, close + 1 - begin));
    if (found != names.end()) flags[found->second] = true;
  }
}

void add_plant(const Program& program, ProgramIndex& index) {
  const Plant& plant = program.plant;
  for (const AstNode& node : plant.nodes) {
    if (node.op == AstOp::Name) mark(index, node.text, index.plant_reads);
  }
  for (const PlantStatement& statement : plant.statements) {
    if (statement.kind == AstPlantStatement::Kind::Assign) {
      mark(index, statement.target, index.plant_writes);
    }
  }
}

}  // namespace

ProgramIndex::ProgramIndex(const Program& program,
                           const PropertySet& properties)
    : plant_reads(program.cells.size()),
      plant_writes(program.cells.size()),
      mentioned(program.cells.size()),
      observed(program.instances.size()),
      component(cell_components(program)),
      read_by_others(program.cells.size()) {
  names.reserve(program.cells.size());
  for (const CellId id : ids_of(program.cells)) {
    names.emplace(program.cells[id].name, id);
  }
  Indexer(program, *this).run();
  in_loop = cells_in_loops(program, component);
  add_plant(program, *this);
  InstanceNames instances;
  for (const InstanceId id : ids_of(program.instances)) {
    instances.emplace(program.instances[id].name, id.index());
  }
  const auto add_line = [&](std::string_view line) {
    mark_words(*this, line, mentioned);
    mark_instances(instances, line, observed);
  };
  for (const AstAnnotation& line : program.annotations) {
    // What a suppression says about a cell is no use of it.
    if (!line.text.starts_with("allow")) add_line(line.text);
  }
  for (const Property& property : properties.properties) {
    if (!property.built_in) add_line(property.text);
  }
}

}  // namespace rung
