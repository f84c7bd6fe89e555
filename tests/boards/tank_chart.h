#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung {

/// A tank's level at the end of every millisecond, in thousandths, and its
/// valve.
struct TankHistory {
  std::string title;
  int low = 0;  // what its valve is to hold it between
  int high = 0;
  struct Sample {
    std::int64_t level = 0;
    bool open = false;
  };
  std::vector<Sample> samples;
};

/// The levels (0 to 1023) over time as an SVG, for light and dark pages.
std::string tank_chart(const std::vector<TankHistory>& tanks);

/// Alike but for numbers, which may differ by `tolerance`.
bool same_drawing(std::string_view one, std::string_view other,
                  double tolerance);

}  // namespace rung
