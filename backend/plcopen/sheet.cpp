#include "backend/plcopen/sheet.h"

#include <algorithm>
#include <string>
#include <utility>

#include "backend/plcopen/page.h"
#include "backend/unit/iec_text.h"

namespace rung::backend::plcopen {
namespace {

using Kind = Circuit::Kind;

struct Size {
  std::size_t columns = 1;
  std::size_t rows = 1;
};

/// Of each part of a network.
std::vector<Size> sizes_of(const Network& network) {
  std::vector<Size> sizes(network.size());
  // Parts stand behind what they are parts of.
  for (std::size_t i = network.size(); i-- > 0;) {
    const Circuit& circuit = network[i];
    if (circuit.parts.empty()) continue;
    const bool series = circuit.kind == Kind::Series;
    Size size{0, 0};
    for (const std::uint32_t part : circuit.parts) {
      const Size& one = sizes[part];
      size.columns = series ? size.columns + one.columns
                            : std::max(size.columns, one.columns);
      size.rows = series ? std::max(size.rows, one.rows) : size.rows + one.rows;
    }
    sizes[i] = size;
  }
  return sizes;
}

/// An expression of numbers as boxes: operands stand to the left of theirs.
struct Tree {
  struct Part {
    std::size_t level = 0;  // 0: a variable or a literal
    std::size_t rows = 1;
    Cell at;
    std::vector<std::size_t> operands;
  };
  std::vector<Part> parts;  // by term
};

Tree tree_of(const Terms& terms, bool enabled, Cell first) {
  Tree tree;
  tree.parts.resize(terms.size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].size == 1) continue;
    Tree::Part& part = tree.parts[i];
    const std::size_t right = i - 1;
    if (terms[i].op != NodeOp::Negate) {
      part.operands.push_back(right - terms[right].size);
    }
    part.operands.push_back(right);
    const bool negation = part.operands.size() == 1;  // 0 - x
    part.rows = (enabled ? 1 : 0) + (negation ? 1 : 0);
    for (const std::size_t operand : part.operands) {
      Tree::Part& one = tree.parts[operand];
      part.level = std::max(part.level, one.level + 1);
      // A box has a head; the first is beside that of what it is for.
      const bool first_one = operand != right;
      one.at.row = part.rows + (first_one || one.level == 0 ? 0 : 1);
      part.rows = one.at.row + one.rows;
    }
  }
  tree.parts.back().at = {first.column + tree.parts.back().level, first.row};
  for (std::size_t i = terms.size(); i-- > 0;) {
    const Tree::Part part = tree.parts[i];
    for (const std::size_t operand : part.operands) {
      Tree::Part& one = tree.parts[operand];
      one.at.row += part.at.row;  // so far within `part`
      one.at.column =
          one.level == 0 ? part.at.column - 1 : first.column + one.level;
    }
  }
  return tree;
}

/// A number that is taken over behind a condition needs a box for that.
bool moves(const Rung& rung) {
  return !rung.enable.empty() && rung.word.size() == 1;
}

/// The column of the box of a call.
std::size_t box_column(const Rung& rung) {
  std::size_t column = 1;
  for (const Input& input : rung.inputs) {
    if (input.power.empty()) continue;
    column = std::max(column, sizes_of(input.power)[0].columns);
  }
  return column;
}

/// With the one of its coils.
std::size_t columns_of(const Rung& rung) {
  switch (rung.kind) {
    case Rung::Kind::Coil:
      return sizes_of(rung.power)[0].columns + 1;
    case Rung::Kind::Call:
      return box_column(rung) + 2;
    case Rung::Kind::Compare:
    case Rung::Kind::Word:
      break;
  }
  return tree_of(rung.word, false, {}).parts.back().level + 3;
}

class Sheet {
 public:
  Sheet(const Unit& unit, Page page, std::size_t columns,
        const RungComments& comments)
      : unit_(unit),
        page_(std::move(page)),
        last_(columns - 1),
        comments_(comments) {}

  void run(const std::vector<Rung>& rungs,
           const std::vector<std::string>& at_top) {
    comment(at_top);
    for (const Rung& rung : rungs) {
      open_rung(rung.source.index());
      draw(rung);
    }
    open_rung(static_cast<std::uint32_t>(comments_.before.size()));
    comment(comments_.at_end);
  }

 private:
  void comment(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    page_.comment(row_, lines);
    row_ += (lines.size() + 1) / 2 + 1;
  }

  void open_rung(std::uint32_t rung) {
    std::vector<std::string> lines;
    for (; next_rung_ <= rung && next_rung_ < comments_.before.size();
         ++next_rung_) {
      const auto& more = comments_.before[next_rung_];
      lines.insert(lines.end(), more.begin(), more.end());
    }
    comment(lines);
  }

  void draw(const Rung& rung) {
    const bool boxes = rung.kind != Rung::Kind::Coil;
    if (boxes) ++row_;  // their heads
    page_.begin_rung(row_);
    switch (rung.kind) {
      case Rung::Kind::Coil:
        draw_coil(rung);
        break;
      case Rung::Kind::Call:
        draw_call(rung);
        break;
      case Rung::Kind::Compare:
      case Rung::Kind::Word:
        draw_word(rung);
        break;
    }
    ++row_;
  }

  const std::string& name_of(CellId cell) const {
    return unit_.variables[cell].name;
  }

  void draw_coil(const Rung& rung) {
    const Circuit& root = rung.power[0];
    const bool constant = root.kind == Kind::Constant;
    const bool never = constant && !root.value;
    if (never && rung.storage != Storage::None) return;
    const Size size = sizes_of(rung.power)[0];
    const Feed power =
        constant ? Feed{page_.left_rail(row_)} : network(rung.power, {0, row_});
    page_.right_rail(page_.coil({last_, row_}, name_of(rung.target), never,
                                rung.storage, power));
    row_ += size.rows;
  }

  /// Contacts between the left rail and the ends that are given back.
  Feed network(const Network& network, Cell first) {
    struct Place {
      std::uint32_t part = 0;
      Cell at;
      std::size_t from = 0;  // in `feeds`; 0: the rail
      std::size_t to = 0;
    };
    const std::vector<Size> sizes = sizes_of(network);
    std::vector<Feed> feeds(2);
    std::vector<Place> todo = {{0, first, 0, 1}};
    while (!todo.empty()) {
      const Place place = todo.back();
      todo.pop_back();
      const Circuit& circuit = network[place.part];
      if (circuit.kind == Kind::Contact) {
        const Feed feed = place.from == 0 ? Feed{page_.left_rail(place.at.row)}
                                          : feeds[place.from];
        feeds[place.to].push_back(page_.contact(place.at, name_of(circuit.cell),
                                                circuit.negated, feed));
        continue;
      }
      std::vector<Place> parts;
      Cell at = place.at;
      std::size_t from = place.from;
      for (const std::uint32_t part : circuit.parts) {
        if (circuit.kind == Kind::Parallel) {
          parts.push_back({part, at, from, place.to});
          at.row += sizes[part].rows;
          continue;
        }
        const bool last = part == circuit.parts.back();
        if (!last) feeds.emplace_back();
        const std::size_t to = last ? place.to : feeds.size() - 1;
        parts.push_back({part, at, from, to});
        at.column += sizes[part].columns;
        from = to;
      }
      todo.insert(todo.end(), parts.rbegin(), parts.rend());
    }
    return feeds[1];
  }

  /// A contact or a constant, for an input of a box in the next column.
  Feed bit(const Network& power, Cell at) {
    const Circuit& root = power[0];
    if (root.kind != Kind::Constant) return network(power, at);
    if (root.value) return {page_.left_rail(at.row)};
    return {page_.in_variable(at, "FALSE")};
  }

  void draw_call(const Rung& rung) {
    const Block& block = unit_.blocks[rung.block];
    const bool enabled = !rung.enable.empty();
    const std::size_t column = box_column(rung);
    std::vector<BoxPin> pins;
    std::size_t row = row_;
    if (enabled)
      pins.push_back({"EN", bit(network_of(rung.enable), {0, row++})});
    for (const Input& input : rung.inputs) {
      BoxPin& pin = pins.emplace_back();
      pin.name = input.pin;
      const Cell at = {0, row++};
      if (!input.power.empty()) pin.feed = bit(input.power, at);
      if (!input.word.empty()) {
        pin.feed = {
            page_.in_variable({column - 1, at.row}, leaf(input.word[0]))};
      }
      if (input.pin == "PT") {
        pin.feed = {
            page_.in_variable({column - 1, at.row}, iec_time(*rung.preset))};
      }
    }
    std::vector<std::string_view> outputs = pins_of(block.type).outputs;
    if (enabled) outputs.insert(outputs.begin(), "ENO");
    const std::vector<End> ends =
        page_.box({column, row_}, block.type, block.name, pins, outputs);
    for (const Output& output : rung.outputs) {
      const auto at = static_cast<std::size_t>(
          std::find(outputs.begin(), outputs.end(), output.pin) -
          outputs.begin());
      sink(output.target, {column + 1, row_ + at}, ends[at]);
    }
    row_ += std::max(pins.size(), outputs.size());
  }

  void sink(CellId target, Cell at, const End& end) {
    if (unit_.variables[target].type == Type::Word) {
      page_.out_variable(at, name_of(target), {end});
    } else {
      page_.right_rail(page_.coil({last_, at.row}, name_of(target), false,
                                  Storage::None, {end}));
    }
  }

  std::string leaf(const Term& term, bool time = false) const {
    if (term.op == NodeOp::Read) return name_of(term.cell);
    return time ? iec_time(term.value) : std::to_string(term.value);
  }

  /// The elapsed time of a block is compared with times.
  bool is_time(const Terms& word) const {
    return std::any_of(word.begin(), word.end(), [&](const Term& term) {
      return term.op == NodeOp::Read && unit_.variables[term.cell].pin == "ET";
    });
  }

  /// A number, or a comparison of two.
  void draw_word(const Rung& rung) {
    const std::size_t head = moves(rung) ? 1 : 0;
    const Tree tree =
        tree_of(rung.word, !rung.enable.empty(), {0, row_ + head});
    const Feed enable =
        rung.enable.empty() ? Feed() : bit(network_of(rung.enable), {0, row_});
    const bool time = is_time(rung.word);
    std::vector<End> ends;
    for (std::size_t i = 0; i < rung.word.size(); ++i) {
      const Tree::Part& part = tree.parts[i];
      if (part.level == 0) {
        ends.push_back(page_.in_variable(part.at, leaf(rung.word[i], time)));
        continue;
      }
      std::vector<BoxPin> pins;
      std::string_view pin = "IN1";
      if (part.operands.size() == 1) {  // a negation
        const std::size_t row = part.at.row + (enable.empty() ? 0 : 1);
        pins.push_back(
            {pin, {page_.in_variable({part.at.column - 1, row}, "0")}});
        pin = "IN2";
      }
      for (const std::size_t operand : part.operands) {
        pins.push_back({pin, {ends[operand]}});
        pin = "IN2";
      }
      ends.push_back(
          function(part.at, iec_function(rung.word[i].op), enable, pins));
    }
    End end = ends.back();
    Cell at = tree.parts.back().at;
    if (moves(rung)) {
      at = {at.column + 1, row_};
      end = function(at, "MOVE", enable, {{"IN", {end}}});
    }
    if (!enable.empty()) ++at.row;  // OUT is below ENO
    sink(rung.target, {at.column + 1, at.row}, end);
    row_ += tree.parts.back().rows + head + 1;
  }

  End function(Cell at, std::string_view type, const Feed& enable,
               std::vector<BoxPin> pins) {
    std::vector<std::string_view> outputs = {"OUT"};
    if (!enable.empty()) {
      pins.insert(pins.begin(), {"EN", enable});
      outputs.insert(outputs.begin(), "ENO");
    }
    return page_.box(at, type, "", pins, outputs).back();
  }

  const Unit& unit_;
  Page page_;
  std::size_t last_;  // the column of the coils
  const RungComments& comments_;
  std::size_t row_ = 0;
  std::size_t next_rung_ = 0;
};

}  // namespace

void draw_rungs(pugi::xml_node body, const Unit& unit,
                const std::vector<Rung>& rungs, const RungComments& comments,
                const std::vector<std::string>& at_top) {
  std::size_t longest = 0;
  for (const Variable& variable : unit.variables) {
    longest = std::max(longest, variable.name.size());
  }
  for (const Block& block : unit.blocks) {
    longest = std::max(longest, block.name.size());
  }
  std::size_t columns = 1;
  for (const Rung& rung : rungs) columns = std::max(columns, columns_of(rung));
  Sheet(unit, Page(body, longest, columns), columns, comments)
      .run(rungs, at_top);
}

}  // namespace rung::backend::plcopen
