#include "frontend/ascii/boxes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "frontend/token_list.h"

namespace rung::ascii {
namespace {

/// 500ms, 5s, 3m, 2h
std::optional<std::int64_t> milliseconds_of(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, value);
  if (problem != std::errc() || value < 0 || value > 0x7fff'ffff) {
    return std::nullopt;
  }
  const std::string_view unit(stop, static_cast<std::size_t>(end - stop));
  constexpr std::array<std::pair<std::string_view, std::int64_t>, 4> kUnits = {
      {{"ms", 1}, {"s", 1000}, {"m", 60'000}, {"h", 3'600'000}}};
  for (const auto& [name, factor] : kUnits) {
    if (name == unit && value * factor <= 0x7fff'ffff) return value * factor;
  }
  return std::nullopt;
}

class Finder {
 public:
  Finder(Drawing& drawing, ErrorLimit& errors)
      : drawing_(drawing), errors_(errors) {}

  std::map<Place, Box> run() {
    for (std::uint32_t row = 1; row + 1 < drawing_.rows(); ++row) {
      for (std::uint32_t i = 0; i < drawing_.columns(row); ++i) {
        if (is_corner(row, i)) box(row, i);
      }
    }
    return std::move(out_);
  }

 private:
  // The walls of a box begin below, and a name stands between them.
  bool is_corner(std::uint32_t row, std::uint32_t column) {
    if (drawing_.at(row, column) != '+' ||
        drawing_.at(row, column + 1) != '-' ||
        (column > 0 && drawing_.at(row, column - 1) == '-')) {
      return false;
    }
    right_ = column + 1;
    while (drawing_.at(row, right_) == '-') ++right_;
    if (drawing_.at(row, right_) != '+' || right_ - column < 4 ||
        drawing_.at(row + 1, column) != '|' ||
        drawing_.at(row + 1, right_) != '|') {
      return false;
    }
    kind_ = only_text(row + 1, column + 1, right_);
    return !kind_.empty();
  }

  void fail(std::string_view code, std::uint32_t row, std::uint32_t column,
            std::string message) {
    errors_.error(code, drawing_.range(row, column, right_ + 1),
                  std::move(message));
  }

  std::string_view only_text(std::uint32_t row, std::uint32_t begin,
                             std::uint32_t end) {
    while (begin < end && drawing_.at(row, begin) == ' ') ++begin;
    std::uint32_t stop = begin;
    while (stop < end && is_text(drawing_.at(row, stop))) ++stop;
    for (std::uint32_t i = stop; i < end; ++i) {
      if (drawing_.at(row, i) != ' ') return {};
    }
    return drawing_.text(row, begin, stop);
  }

  void box(std::uint32_t top, std::uint32_t left) {
    std::uint32_t bottom = top + 1;
    while (bottom < top + 4 && drawing_.at(bottom, left) == '|' &&
           drawing_.at(bottom, right_) == '|') {
      ++bottom;
    }
    const bool closed =
        drawing_.at(bottom, left) == '+' && drawing_.at(bottom, right_) == '+';
    if (!closed || bottom != top + 4) {
      return fail("RP051", top, left,
                  "a box has a name, `IN` and `Q`, and `PT` and `ET` between "
                  "its walls");
    }
    const std::uint32_t wire = top + 2;
    Box box;
    box.kind = kind_;
    box.end = right_ + 1;
    box.where = drawing_.range(wire, left, right_ + 1);
    if (kind_ != "TON" && kind_ != "TOF" && kind_ != "TP") {
      return fail("RP087", top + 1, left,
                  "the box " + quoted_excerpt(kind_) +
                      " is not supported: they are TON, TOF, TP");
    }
    if (!ports(wire, left, "IN", "Q") || !ports(wire + 1, left, "PT", "ET")) {
      return fail("RP051", wire, left,
                  "`IN` and `Q` are expected in one row of this box, `PT` and "
                  "`ET` in the next one");
    }
    if (!instance(top - 1, left, box) || !preset(wire + 1, left, box)) return;
    if (drawing_.at(wire + 1, right_ + 1) == '-') {
      return fail("RP087", wire + 1, left, "a wire from `ET` is not supported");
    }
    for (std::uint32_t row = top; row <= bottom; ++row) {
      drawing_.blank(row, left, right_ + 1);
    }
    out_.emplace(Place{wire, left}, box);
  }

  // `|IN   Q|`
  bool ports(std::uint32_t row, std::uint32_t left, std::string_view in,
             std::string_view out) {
    const std::string_view text = drawing_.text(row, left + 1, right_);
    return text.starts_with(in) && text.ends_with(out) &&
           text.size() > in.size() + out.size() &&
           text.substr(in.size(), text.size() - in.size() - out.size())
                   .find_first_not_of(' ') == text.npos;
  }

  bool instance(std::uint32_t row, std::uint32_t left, Box& box) {
    std::vector<Text>& texts = drawing_.texts(row);
    const std::size_t at = drawing_.first_text(row, left);
    if (at < texts.size() && texts[at].begin <= right_ &&
        !texts[at].text.empty()) {
      box.instance = texts[at].text;
      box.instance_where = drawing_.range(row, texts[at].begin, texts[at].end);
      texts[at].used = true;
      return true;
    }
    fail("RP051", row + 1, left, "no name stands above this box");
    return false;
  }

  // Its row has no wire: it is among the texts.
  bool preset(std::uint32_t row, std::uint32_t left, Box& box) {
    std::vector<Text>& texts = drawing_.texts(row);
    const std::size_t at =
        left == 0 ? texts.size() : drawing_.first_text(row, left - 1);
    if (at < texts.size() && texts[at].end == left) {
      texts[at].used = true;
      const auto time = milliseconds_of(texts[at].text);
      box.preset_ms = time.value_or(0);
      if (time) return true;
    }
    fail("RP053", row, left,
         "a time is expected left of `PT`, as in `500ms|PT`");
    return false;
  }

  Drawing& drawing_;
  ErrorLimit& errors_;
  std::map<Place, Box> out_;
  std::uint32_t right_ = 0;
  std::string_view kind_;
};

}  // namespace

std::map<Place, Box> take_boxes(Drawing& drawing, ErrorLimit& errors) {
  return Finder(drawing, errors).run();
}

}  // namespace rung::ascii
