#include "backend/ascii/canvas.h"

#include <algorithm>

namespace rung::backend {
namespace {

using Kind = Circuit::Kind;

struct Size {
  std::size_t width = 0;
  std::size_t rows = 1;
};

std::size_t width_of(const std::string& name) {
  return std::max<std::size_t>(name.size() + 2, 7);
}

class Canvas {
 public:
  explicit Canvas(std::size_t rows) : lines_(rows * 2, "|") {}

  void put(std::size_t line, std::size_t x, std::string_view text) {
    if (lines_.size() <= line) lines_.resize(line + 1, "|");
    std::string& target = lines_[line];
    if (target.size() < x + text.size()) target.resize(x + text.size(), ' ');
    target.replace(x, text.size(), text);
  }
  /// A symbol in the middle of a wire, its name above.
  void element(std::size_t line, std::size_t x, std::size_t width,
               std::string_view symbol, const std::string& name) {
    put(line, x, std::string(width, '-'));
    put(line, x + (width - symbol.size()) / 2, symbol);
    put(line - 1, x + (width - name.size()) / 2, name);
  }
  std::string text() const {
    std::string all;
    for (const std::string& line : lines_) all += line + '\n';
    return all;
  }

 private:
  std::vector<std::string> lines_;
};

std::vector<Size> sizes_of(const Network& network, const Unit& unit) {
  std::vector<Size> sizes(network.size());
  // Parts stand behind what they are parts of.
  for (std::size_t i = network.size(); i-- > 0;) {
    const Circuit& circuit = network[i];
    Size& size = sizes[i];
    if (circuit.kind == Kind::Constant) size.width = 2;
    if (circuit.kind == Kind::Contact) {
      size.width = width_of(unit.variables[circuit.cell].name);
    }
    if (circuit.kind == Kind::Parallel) size.rows = 0;
    for (const std::uint32_t part : circuit.parts) {
      if (circuit.kind == Kind::Series) {
        // A wire between two parts: joints do not touch.
        size.width += sizes[part].width + (size.width == 0 ? 0 : 1);
        size.rows = std::max(size.rows, sizes[part].rows);
      } else {
        size.width = std::max(size.width, sizes[part].width + 4);
        size.rows += sizes[part].rows;
      }
    }
  }
  return sizes;
}

struct Place {
  std::uint32_t at = 0;
  std::size_t x = 0;
  std::size_t row = 0;
  std::size_t width = 0;
};

void draw(const Network& network, const Unit& unit,
          const std::vector<Size>& sizes, const Place& place, Canvas& canvas,
          std::vector<Place>& todo) {
  const Circuit& circuit = network[place.at];
  const std::size_t line = place.row * 2 + 1;
  canvas.put(line, place.x, std::string(place.width, '-'));
  if (circuit.kind == Kind::Contact) {
    canvas.element(line, place.x, place.width, circuit.negated ? "[/]" : "[ ]",
                   unit.variables[circuit.cell].name);
  } else if (circuit.kind == Kind::Series) {
    std::size_t x = place.x;
    for (const std::uint32_t part : circuit.parts) {
      todo.push_back({part, x, place.row, sizes[part].width});
      x += sizes[part].width + 1;
    }
  } else if (circuit.kind == Kind::Parallel) {
    std::size_t row = place.row;
    const std::size_t right = place.x + place.width - 1;
    for (const std::uint32_t part : circuit.parts) {
      for (std::size_t y = line + 1; y < row * 2 + 1; ++y) {
        // Down from the row above.
        if (part == circuit.parts.front()) break;
        canvas.put(y, place.x, "|");
        canvas.put(y, right, "|");
      }
      row += sizes[part].rows;
    }
    row = place.row;
    for (const std::uint32_t part : circuit.parts) {
      // A wire between two joints.
      canvas.put(row * 2 + 1, place.x,
                 "+" + std::string(place.width - 2, '-') + "+");
      todo.push_back({part, place.x + 2, row, place.width - 4});
      row += sizes[part].rows;
    }
  }
}

}  // namespace

std::string draw_rung(const Network& network, const Unit& unit,
                      const std::string& coil) {
  const std::vector<Size> sizes = sizes_of(network, unit);
  Canvas canvas(sizes[0].rows);
  canvas.put(1, 0, "+-");
  std::vector<Place> todo = {{0, 2, 0, sizes[0].width}};
  while (!todo.empty()) {
    const Place place = todo.back();
    todo.pop_back();
    draw(network, unit, sizes, place, canvas, todo);
  }
  const bool never = network[0].kind == Kind::Constant && !network[0].value;
  canvas.element(1, 2 + sizes[0].width, width_of(coil), never ? "(/)" : "( )",
                 coil);
  return canvas.text();
}

std::string draw_timer(const Circuit& contact, const Unit& unit,
                       const Block& block, const std::string& preset,
                       const std::string& coil) {
  const std::string& name = unit.variables[contact.cell].name;
  const std::size_t width = std::max(width_of(name), preset.size() + 1);
  const std::size_t x = 2 + width;
  Canvas canvas(3);
  canvas.put(0, x + 1, block.name);
  canvas.put(1, x, "+-----+");
  canvas.put(2, x,
             "| " + std::string(block.type) +
                 std::string(4 - block.type.size(), ' ') + "|");
  canvas.put(3, 0, "+-");
  canvas.element(3, 2, width, contact.negated ? "[/]" : "[ ]", name);
  canvas.put(3, x, "|IN  Q|");
  canvas.element(3, x + 7, width_of(coil), "( )", coil);
  canvas.put(4, x - preset.size(), preset + "|PT ET|");
  canvas.put(5, x, "+-----+");
  return canvas.text();
}

}  // namespace rung::backend
