#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reports/ladder/layout.h"
#include "reports/ladder/text.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = LadderShape::Kind;

constexpr int kUnit = 9;        // pixels of a character
constexpr int kRow = 44;        // pixels of a row
constexpr int kWire = 30;       // of a row's wire, from its top
constexpr int kHalfSymbol = 6;  // half of the gap in a contact
constexpr int kMargin = 20;

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

class Picture {
 public:
  void rung(const LadderRung& rung, int width) {
    width_ = std::max(width, rung.width);
    for (const LadderShape& shape : rung.shapes) draw(shape);
    line(0, top_, 0, top_ + rung.height * kRow);
    line(width_ * kUnit, top_, width_ * kUnit, top_ + rung.height * kRow);
    widest_ = std::max(widest_, width_);
    top_ += rung.height * kRow;
  }

  std::string take() const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{0} {0} {1} {2}\" "
        "role=\"img\">\n<title>ladder</title>\n"
        "<g fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\">\n{3}"
        "</g>\n<g fill=\"currentColor\" font-family=\"monospace\" "
        "font-size=\"12\" text-anchor=\"middle\">\n{4}</g>\n</svg>\n",
        -kMargin, widest_ * kUnit + 2 * kMargin, top_ + 2 * kMargin, lines_,
        texts_);
  }

 private:
  void line(int x1, int y1, int x2, int y2) {
    if (x1 == x2 && y1 == y2) return;
    lines_ += fmt::format("<path d=\"M{} {}L{} {}\"/>\n", x1, y1, x2, y2);
  }

  void text(int x, int y, std::string_view value) {
    texts_ += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y,
                          escaped(value));
  }

  void draw(const LadderShape& shape) {
    const int x = shape.x * kUnit;
    const int y = top_ + shape.y * kRow + kWire;
    switch (shape.kind) {
      case Kind::Wire:
        line(x, y, x + shape.width * kUnit, y);
        return;
      case Kind::Riser:
        line(x, y, x, y + shape.height * kRow);
        return;
      case Kind::Contact:
      case Kind::Negated:
      case Kind::Box:
        symbol(shape, x, x + shape.width * kUnit, y);
        return;
      case Kind::Coil: {
        const int left = (width_ - shape.width) * kUnit;
        line(x, y, left, y);
        symbol(shape, left, width_ * kUnit, y);
        return;
      }
    }
  }

  void symbol(const LadderShape& shape, int from, int to, int y) {
    const int middle = (from + to) / 2;
    int half = kHalfSymbol;
    if (shape.kind == Kind::Box) {
      half = (static_cast<int>(printable_width(shape.text)) + 1) * kUnit / 2;
      lines_ +=
          fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"20\"/>\n",
                      middle - half, y - 10, 2 * half);
      text(middle, y + 4, shape.text);
    } else {
      text(middle, y - 14, shape.text);
    }
    line(from, y, middle - half, y);
    line(middle + half, y, to, y);
    if (shape.kind == Kind::Coil) {
      lines_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", middle,
                            y, half);
    } else if (shape.kind != Kind::Box) {
      line(middle - half, y - 9, middle - half, y + 9);
      line(middle + half, y - 9, middle + half, y + 9);
      if (shape.kind == Kind::Negated) {
        line(middle - half, y + 9, middle + half, y - 9);
      }
    }
  }

  std::string lines_;
  std::string texts_;
  int top_ = 0;
  int width_ = 0;
  int widest_ = 0;
};

}  // namespace

std::string draw_ladder_svg(const Program& program) {
  std::vector<LadderRung> rungs;
  int width = 0;
  for (const Rung& rung : program.rungs) {
    rungs.push_back(lay_out_rung(program, rung));
    width = std::max(width, rungs.back().width);
  }
  Picture picture;
  for (const LadderRung& rung : rungs) picture.rung(rung, width);
  return picture.take();
}

}  // namespace rung
