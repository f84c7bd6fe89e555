#include "tank_chart.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>

namespace rung {
namespace {

constexpr double kWidth = 860;
constexpr double kLeft = 56;
constexpr double kPlotWidth = 720;
constexpr double kPlotHeight = 150;
constexpr double kPanelHeight = 216;
constexpr double kTop = 34;

constexpr std::string_view kStyle = R"(<style>
text { font: 12px sans-serif; fill: #444c56; }
.title { font-size: 13px; font-weight: bold; }
.page { fill: #ffffff; }
.frame { fill: none; stroke: #aab1bb; }
.bound { fill: none; stroke: #b35900; stroke-dasharray: 5 4; }
.name { fill: #b35900; }
.level { fill: none; stroke: #0b63ce; stroke-width: 1.6; }
.valve { fill: #0b63ce; }
@media (prefers-color-scheme: dark) {
text { fill: #c3cad3; }
.page { fill: #12171e; }
.frame { stroke: #5a636e; }
.bound { stroke: #f0a04b; }
.name { fill: #f0a04b; }
.level { stroke: #6cb2ff; }
.valve { fill: #6cb2ff; }
}
</style>
)";

/// Draws one tank; its panel begins at `top`.
class Panel {
 public:
  Panel(const TankHistory& tank, double top)
      : tank_(tank), top_(top + kTop), length_(tank.samples.size()) {}

  std::string draw() const {
    std::string text = fmt::format(
        "<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n"
        "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/>\n",
        kLeft, top_ - 10, tank_.title, kLeft, top_, kPlotWidth, kPlotHeight);
    text += axis();
    text += bound(tank_.low, 12) + bound(tank_.high, -4);
    text += line() + valve();
    return text;
  }

 private:
  double x(std::size_t ms) const {
    return kLeft +
           kPlotWidth * static_cast<double>(ms) / static_cast<double>(length_);
  }
  double y(double level) const {
    return top_ + kPlotHeight * (1 - level / 1023);
  }

  std::string axis() const {
    std::string text;
    for (const int level : {0, 1023}) {
      text += label(kLeft - 6, y(level) + 4, "end", std::to_string(level));
    }
    for (std::size_t ms = 0; ms <= length_; ms += 1000) {
      text += label(x(ms), top_ + kPlotHeight + 26, "middle",
                    std::to_string(ms / 1000) + " s");
    }
    return text;
  }

  static std::string label(double x, double y, std::string_view anchor,
                           std::string_view text) {
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
        anchor, text);
  }

  std::string bound(int level, double below) const {
    return fmt::format(
        "<path class=\"bound\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n"
        "<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        kLeft, y(level), kPlotWidth, kLeft + kPlotWidth + 6, y(level) + below,
        level);
  }

  /// Straight between two changes of its slope.
  std::string line() const {
    const auto& samples = tank_.samples;
    std::string text = "<path class=\"level\" d=\"M";
    for (std::size_t at = 0; at < samples.size(); ++at) {
      const bool end = at == 0 || at + 1 == samples.size();
      const bool straight =
          !end && samples[at].level * 2 ==
                      samples[at - 1].level + samples[at + 1].level;
      if (straight) continue;
      text += fmt::format("{}{:.1f} {:.1f}", at == 0 ? "" : "L", x(at),
                          y(static_cast<double>(samples[at].level) / 1000));
    }
    return text + "\"/>\n";
  }

  /// Bars below the frame while it is open.
  std::string valve() const {
    std::string text;
    const auto& samples = tank_.samples;
    for (std::size_t at = 0; at < samples.size(); ++at) {
      if (!samples[at].open) continue;
      const std::size_t begin = at;
      while (at < samples.size() && samples[at].open) ++at;
      text += fmt::format(
          "<rect class=\"valve\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
          "height=\"6\"/>\n",
          x(begin), top_ + kPlotHeight + 4, x(at) - x(begin));
    }
    return text + label(kLeft + kPlotWidth + 6, top_ + kPlotHeight + 11,
                        "start", "valve open");
  }

  const TankHistory& tank_;
  double top_;
  std::size_t length_;
};

double number_at(std::string_view text, std::size_t& at) {
  std::string digits;
  while (at < text.size() &&
         (std::isdigit(static_cast<unsigned char>(text[at])) != 0 ||
          text[at] == '.')) {
    digits += text[at++];
  }
  return std::strtod(digits.c_str(), nullptr);
}

}  // namespace

std::string tank_chart(const std::vector<TankHistory>& tanks) {
  const double height = kPanelHeight * static_cast<double>(tanks.size());
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\">\n",
      kWidth, height);
  text += kStyle;
  text += "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
  double top = 0;
  for (const TankHistory& tank : tanks) {
    text += Panel(tank, top).draw();
    top += kPanelHeight;
  }
  return text + "</svg>\n";
}

bool same_drawing(std::string_view one, std::string_view other,
                  double tolerance) {
  const auto digit = [](std::string_view text, std::size_t at) {
    return std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < one.size() && j < other.size()) {
    if (digit(one, i) && digit(other, j)) {
      if (std::abs(number_at(one, i) - number_at(other, j)) > tolerance) {
        return false;
      }
    } else if (one[i++] != other[j++]) {
      return false;
    }
  }
  return i == one.size() && j == other.size();
}

}  // namespace rung
