#include "reports/ladder/svg.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/assets.h"
#include "reports/locate.h"
#include "reports/markup.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = LadderShape::Kind;

constexpr int kUnit = 9;        // pixels of a character
constexpr int kRow = 52;        // pixels of a row
constexpr int kWire = 28;       // of a row's wire, from its top
constexpr int kName = 14;       // of the text above a symbol, from the wire
constexpr int kValue = 20;      // of the text below it
constexpr int kHalfSymbol = 6;  // half of the gap in a contact
constexpr int kHalfHeight = 9;  // of a symbol
constexpr int kHalfBox = 11;    // of a box
constexpr int kCaption = 22;    // pixels of a line of text above a rung
constexpr int kMargin = 20;
constexpr std::size_t kCaptionColumns = 110;

/// One rung: the strokes of each net, and the texts.
class RungPicture {
 public:
  /// Without a state in a page: the script writes the values.
  enum class Use : std::uint8_t { File, Page };

  RungPicture(const LadderRung& rung, const RungState* state, Use use)
      : state_(state),
        use_(use),
        strokes_(static_cast<std::size_t>(rung.nets)),
        powered_(state != nullptr ? powered_nets(rung, *state)
                                  : std::vector<bool>(strokes_.size(), false)) {
    const int right = rung.width * kUnit;
    move(0, 0, LadderRung::kLeftRail);
    add(fmt::format("V{}", rung.height * kRow));
    move(right, 0, LadderRung::kRightRail);
    add(fmt::format("V{}", rung.height * kRow));
    for (const LadderShape& shape : rung.shapes) draw(shape);
  }

  std::string elements() const {
    if (use_ == Use::Page) return live_strokes() + texts_;
    std::string all;
    for (const std::string& net : strokes_) all += net;
    return fmt::format("<path d=\"{}\"/>\n", all) + texts_;
  }

 private:
  /// A path a net: the script changes which have power.
  std::string live_strokes() const {
    std::string out;
    for (std::size_t net = 0; net < strokes_.size(); ++net) {
      if (strokes_[net].empty()) continue;
      out += fmt::format("<path data-net=\"{}\"{} d=\"{}\"/>\n", net,
                         powered_[net] ? " class=\"on\"" : "", strokes_[net]);
    }
    return out;
  }

  void add(std::string_view stroke) { strokes_[net_] += stroke; }

  /// Begins a stroke of what is connected to `net`.
  void move(int x, int y, int net) {
    net_ = static_cast<std::size_t>(net);
    add(fmt::format("M{} {}", x, y));
  }

  void horizontal(int from, int to, int y, int net) {
    if (from == to) return;
    move(from, y, net);
    add(fmt::format("H{}", to));
  }

  void text(int x, int y, std::string_view style, std::string_view value) {
    texts_ += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", x, y, style,
                          markup(value));
  }

  void draw(const LadderShape& shape) {
    const int x = shape.x * kUnit;
    const int y = shape.y * kRow + kWire;
    if (shape.kind == Kind::Wire) {
      horizontal(x, x + shape.width * kUnit, y, shape.from);
    } else if (shape.kind == Kind::Riser) {
      if (shape.height == 0) return;
      move(x, y, shape.from);
      add(fmt::format("v{}", shape.height * kRow));
    } else {
      draw_symbol(shape, x, y);
    }
  }

  void draw_symbol(const LadderShape& shape, int x, int y) {
    const int end = x + shape.width * kUnit;
    const int middle = (x + end) / 2;
    const bool is_box = shape.kind == Kind::Box;
    const int half =
        is_box ? (text_width(shape.text) + 1) * kUnit / 2 : kHalfSymbol;
    horizontal(x, middle - half, y, shape.from);
    horizontal(middle + half, end, y, shape.to);
    draw_sides(shape, middle - half, middle + half, y);
    if (use_ == Use::Page) begin_symbol(shape);
    text(middle, is_box ? y + 4 : y - kName, "", shape.text);
    if (use_ == Use::Page) {
      text(middle, y + kValue + (is_box ? 4 : 0), " class=\"value\"",
           state_ != nullptr ? value_of(shape) : "");
      texts_ += "</g>\n";
    }
  }

  /// What the script must know to say why a coil has power.
  void begin_symbol(const LadderShape& shape) {
    texts_ +=
        fmt::format("<g data-kind=\"{}\" data-from=\"{}\" data-to=\"{}\"{}>\n",
                    name_of(shape.kind), shape.from, shape.to,
                    shape.behind_input ? " data-behind=\"1\"" : "");
  }

  static std::string_view name_of(Kind kind) {
    switch (kind) {
      case Kind::Contact:
        return "contact";
      case Kind::Negated:
        return "negated";
      case Kind::Box:
        return "box";
      case Kind::Coil:
        return "coil";
      case Kind::Wire:
      case Kind::Riser:
        break;
    }
    return "";
  }

  void draw_sides(const LadderShape& shape, int left, int right, int y) {
    switch (shape.kind) {
      case Kind::Wire:
      case Kind::Riser:
        return;
      case Kind::Contact:
      case Kind::Negated:
        side(left, y, fmt::format("v{}", 2 * kHalfHeight), shape.from);
        side(right, y, fmt::format("v{}", 2 * kHalfHeight), shape.to);
        if (shape.kind == Kind::Negated) {
          move(left, y + kHalfHeight, shape.from);
          add(fmt::format("L{} {}", right, y - kHalfHeight));
        }
        return;
      case Kind::Coil:
        side(left + 3, y,
             fmt::format("q-6 {} 0 {}", kHalfHeight, 2 * kHalfHeight),
             shape.from);
        side(right - 3, y,
             fmt::format("q6 {} 0 {}", kHalfHeight, 2 * kHalfHeight),
             shape.from);
        return;
      case Kind::Box:
        move(left, y - kHalfBox, shape.to);
        add(fmt::format("H{}v{}H{}z", right, 2 * kHalfBox, left));
        return;
    }
  }

  void side(int x, int y, std::string_view stroke, int net) {
    move(x, y - kHalfHeight, net);
    add(stroke);
  }

  static int text_width(const std::string& text) {
    return static_cast<int>(printable_width(text));
  }

  std::string value_of(const LadderShape& shape) const {
    const auto value = shown_value(shape, *state_);
    return value ? fmt::format("{}", *value) : "-";
  }

  const RungState* state_;
  Use use_;
  std::vector<std::string> strokes_;  // by net
  std::vector<bool> powered_;         // by net
  std::size_t net_ = 0;               // of the stroke being drawn
  std::string texts_;
};

/// Rungs below each other.
class Picture {
 public:
  void add(const LadderRung& rung, const std::string& caption) {
    body_ += fmt::format(
        "<g transform=\"translate(0 {})\">\n"
        "<text class=\"caption\" x=\"0\" y=\"{}\">{}</text>\n"
        "<g transform=\"translate(0 {})\">\n{}</g>\n</g>\n",
        top_, kCaption - 8, markup(caption, kCaptionColumns), kCaption,
        RungPicture(rung, nullptr, RungPicture::Use::File).elements());
    top_ += kCaption + rung.height * kRow + kMargin;
    const std::size_t columns =
        std::min(printable_width(caption), kCaptionColumns + 1);
    columns_ = std::max({columns_, rung.width, static_cast<int>(columns)});
  }

  std::string file(const std::string& title) const {
    const int width = columns_ * kUnit + 2 * kMargin;
    const std::int64_t height = top_ + kMargin;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ladder\" "
        "width=\"{0}\" height=\"{1}\" viewBox=\"{2} {2} {0} {1}\" "
        "role=\"img\" aria-labelledby=\"title\">\n"
        "<title id=\"title\">{3}</title>\n<style>\n{4}</style>\n"
        "<rect class=\"paper\" x=\"{2}\" y=\"{2}\" width=\"{0}\" "
        "height=\"{1}\"/>\n{5}</svg>\n",
        width, height, -kMargin, markup(title), kLadderStyle.text, body_);
  }

 private:
  std::string body_;
  std::int64_t top_ = 0;
  int columns_ = 0;
};

}  // namespace

std::string draw_ladder_svg(const SourceSet& sources, const Program& program) {
  const std::vector<LadderRung> rungs = lay_out_ladder(program);
  const std::string& path = sources[program.file].path();
  Locator locator(sources);
  Picture picture;
  for (const RungId id : ids_of(program.rungs)) {
    const Rung& rung = program.rungs[id];
    picture.add(rungs[id.index()],
                fmt::format("{}  {}:{}  {}", id.index() + 1, path,
                            locator.of(rung.where).begin.line,
                            first_line(sources, rung)));
  }
  return picture.file("ladder of " + path);
}

std::string draw_rung_svg(const LadderRung& rung, const RungState* state,
                          std::string_view label) {
  const int width = rung.width * kUnit + 2 * kMargin;
  const int height = rung.height * kRow;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ladder\" "
      "width=\"{0}\" height=\"{1}\" viewBox=\"{2} 0 {0} {1}\" role=\"img\" "
      "aria-label=\"{3}\">\n{4}</svg>\n",
      width, height, -kMargin, markup(label),
      RungPicture(rung, state, RungPicture::Use::Page).elements());
}

std::string_view first_line(const SourceSet& sources, const Rung& rung) {
  const std::string_view text = sources.text(rung.where);
  return text.substr(0, text.find_first_of("\r\n"));
}

}  // namespace rung
