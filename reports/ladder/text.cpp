#include "reports/ladder/text.h"

#include <fmt/format.h>

#include <vector>

#include "reports/ladder/layout.h"
#include "reports/locate.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = LadderShape::Kind;

// Where wires leave a cell of the canvas.
constexpr unsigned kUp = 1;
constexpr unsigned kDown = 2;
constexpr unsigned kLeft = 4;
constexpr unsigned kRight = 8;

std::string_view junction(unsigned directions, bool ascii) {
  static constexpr std::string_view kUnicode[16] = {
      " ", "│", "│", "│", "─", "┘", "┐", "┤",
      "─", "└", "┌", "├", "─", "┴", "┬", "┼"};
  static constexpr std::string_view kAscii[16] = {" ", "|", "|", "|", "-", "+",
                                                  "+", "+", "-", "+", "+", "+",
                                                  "-", "+", "+", "+"};
  return ascii ? kAscii[directions] : kUnicode[directions];
}

/// A grid of characters: wires first, text over them.
class Canvas {
 public:
  Canvas(int width, int height, bool ascii)
      : width_(width),
        height_(height),
        ascii_(ascii),
        wires_(cells(width, height), 0),
        texts_(cells(width, height)) {}

  void connect(int x, int y, unsigned directions) {
    if (inside(x, y)) wires_[index(x, y)] |= directions;
  }

  /// From the middle of one cell to the middle of another.
  void horizontal(int from, int to, int y) {
    for (int x = from; x < to; ++x) {
      connect(x, y, kRight);
      connect(x + 1, y, kLeft);
    }
  }
  void vertical(int x, int from, int to) {
    for (int y = from; y < to; ++y) {
      connect(x, y, kDown);
      connect(x, y + 1, kUp);
    }
  }

  void write(int x, int y, std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
      const Character character = decode(text, at);
      const auto width = static_cast<int>(display_width(character.code));
      if (width == 0 && inside(x - 1, y)) {
        texts_[index(x - 1, y)] += text.substr(at, character.bytes);
      } else if (inside(x, y)) {
        texts_[index(x, y)] = text.substr(at, character.bytes);
        if (width == 2 && inside(x + 1, y)) covered(x + 1, y);
      }
      x += width;
      at += character.bytes;
    }
  }

  std::string line(int y) const {
    std::string out;
    for (int x = 0; x < width_; ++x) {
      const std::string& text = texts_[index(x, y)];
      if (text == kCovered) continue;
      out += text.empty() ? junction(wires_[index(x, y)], ascii_)
                          : std::string_view(text);
    }
    while (out.ends_with(' ')) out.pop_back();
    return out;
  }

 private:
  static constexpr std::string_view kCovered = "\x01";

  static std::size_t cells(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  void covered(int x, int y) { texts_[index(x, y)] = kCovered; }
  bool inside(int x, int y) const {
    return x >= 0 && x < width_ && y >= 0 && y < height_;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  bool ascii_;
  std::vector<unsigned> wires_;
  std::vector<std::string> texts_;
};

/// Each row of the layout is two lines: names, then wires and symbols.
constexpr int line_of(int row) { return 2 * row + 1; }

std::string_view symbol(Kind kind, bool ascii) {
  switch (kind) {
    case Kind::Contact:
      return ascii ? "| |" : "┤ ├";
    case Kind::Negated:
      return ascii ? "|/|" : "┤/├";
    case Kind::Coil:
      return "( )";
    case Kind::Wire:
    case Kind::Riser:
    case Kind::Box:
      return "";
  }
  return "";
}

class RungDrawing {
 public:
  RungDrawing(const LadderRung& rung, bool ascii)
      : rung_(rung),
        canvas_(rung.width + 1, 2 * rung.height, ascii),
        ascii_(ascii) {
    canvas_.vertical(0, 0, 2 * rung.height - 1);
    canvas_.connect(0, 0, kUp);
    for (const LadderShape& shape : rung.shapes) draw(shape);
  }

  std::string text() const {
    std::string out;
    for (int y = 0; y < 2 * rung_.height; ++y) {
      out += "    " + canvas_.line(y) + "\n";
    }
    return out;
  }

 private:
  void draw(const LadderShape& shape) {
    const int y = line_of(shape.y);
    switch (shape.kind) {
      case Kind::Wire:
        canvas_.horizontal(shape.x, shape.x + shape.width, y);
        return;
      case Kind::Riser:
        canvas_.vertical(shape.x, y, line_of(shape.y + shape.height));
        return;
      case Kind::Box:
        canvas_.horizontal(shape.x, shape.x + shape.width, y);
        canvas_.write(shape.x + 2, y, "[" + shape.text + "]");
        return;
      case Kind::Contact:
      case Kind::Negated:
        draw_symbol(shape);
        return;
      case Kind::Coil:
        draw_symbol(shape);
        canvas_.connect(rung_.width, y, kUp | kDown);
        return;
    }
  }

  void draw_symbol(const LadderShape& shape) {
    const int y = line_of(shape.y);
    canvas_.horizontal(shape.x, shape.x + shape.width, y);
    const int symbol_at = shape.x + (shape.width + 1 - 3) / 2;
    canvas_.write(symbol_at, y, symbol(shape.kind, ascii_));
    const auto text = static_cast<int>(printable_width(shape.text));
    canvas_.write(symbol_at + 1 - (text - 1) / 2, y - 1, shape.text);
  }

  const LadderRung& rung_;
  Canvas canvas_;
  bool ascii_;
};

}  // namespace

std::string draw_ladder(const SourceSet& sources, const Program& program,
                        bool ascii) {
  const std::vector<LadderRung> rungs = lay_out_ladder(program);
  Locator locator(sources);
  std::string out;
  for (const RungId id : ids_of(program.rungs)) {
    const Place place = locator.of(program.rungs[id].where);
    out +=
        fmt::format("{:>3} {}:{}\n", id.index() + 1,
                    printable(sources[program.file].path()), place.begin.line);
    out += RungDrawing(rungs[id.index()], ascii).text();
    out += '\n';
  }
  return out;
}

}  // namespace rung
