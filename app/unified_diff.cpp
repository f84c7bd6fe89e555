#include "app/unified_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rung {
namespace {

using Lines = std::vector<std::string_view>;  // with their line ends

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

/// Lines [a_begin, a_end) of one text became [b_begin, b_end) of the other.
struct Change {
  std::size_t a_begin, a_end, b_begin, b_end;
};

/// The greedy algorithm of Myers (1986): the furthest point of each diagonal,
/// step by step, and the way back. Nothing when it takes too many steps.
class Shortest {
 public:
  Shortest(const Lines& a, const Lines& b) : a_(a), b_(b) {}

  /// Pairs of lines that stay, from the last one to the first.
  std::vector<std::pair<std::size_t, std::size_t>> kept() {
    constexpr std::int64_t kMostSteps = 1500;
    const auto most = static_cast<std::int64_t>(a_.size() + b_.size());
    std::vector<std::int64_t> furthest(2 * kMostSteps + 3, 0);
    std::vector<std::vector<std::int64_t>> history;
    for (std::int64_t d = 0; d <= std::min(most, kMostSteps); ++d) {
      history.push_back(furthest);
      if (step(d, kMostSteps + 1, furthest)) {
        return way_back(d, kMostSteps + 1, history);
      }
    }
    return {};
  }

 private:
  static bool goes_down(const std::vector<std::int64_t>& v, std::int64_t d,
                        std::int64_t k, std::int64_t middle) {
    const auto at = static_cast<std::size_t>(middle + k);
    return k == -d || (k != d && v[at - 1] < v[at + 1]);
  }

  bool step(std::int64_t d, std::int64_t middle,
            std::vector<std::int64_t>& v) const {
    const auto n = static_cast<std::int64_t>(a_.size());
    const auto m = static_cast<std::int64_t>(b_.size());
    for (std::int64_t k = -d; k <= d; k += 2) {
      const auto at = static_cast<std::size_t>(middle + k);
      std::int64_t x = goes_down(v, d, k, middle) ? v[at + 1] : v[at - 1] + 1;
      std::int64_t y = x - k;
      while (x < n && y < m && y >= 0 &&
             a_[static_cast<std::size_t>(x)] ==
                 b_[static_cast<std::size_t>(y)]) {
        ++x;
        ++y;
      }
      v[at] = x;
      if (x >= n && y >= m) return true;
    }
    return false;
  }

  std::vector<std::pair<std::size_t, std::size_t>> way_back(
      std::int64_t d, std::int64_t middle,
      const std::vector<std::vector<std::int64_t>>& history) const {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    auto x = static_cast<std::int64_t>(a_.size());
    auto y = static_cast<std::int64_t>(b_.size());
    for (; d >= 0; --d) {
      const auto& v = history[static_cast<std::size_t>(d)];
      const std::int64_t k = x - y;
      const bool down = goes_down(v, d, k, middle);
      const std::int64_t from = down ? k + 1 : k - 1;
      const std::int64_t x0 =
          d == 0 ? 0 : v[static_cast<std::size_t>(middle + from)];
      const std::int64_t y0 = d == 0 ? 0 : x0 - from;
      const std::int64_t first = d == 0 ? 0 : (down ? x0 : x0 + 1);
      while (x > first) {
        --x;
        --y;
        pairs.emplace_back(x, y);
      }
      x = x0;
      y = y0;
    }
    return pairs;
  }

  const Lines& a_;
  const Lines& b_;
};

/// Equal lines at both ends are no matter of a search.
std::vector<Change> changes_of(const Lines& a, const Lines& b) {
  std::size_t head = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) ++head;
  std::size_t tail = 0;
  while (tail < a.size() - head && tail < b.size() - head &&
         a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) {
    ++tail;
  }
  const auto middle = [&](const Lines& all) {
    return Lines(all.begin() + static_cast<std::ptrdiff_t>(head),
                 all.end() - static_cast<std::ptrdiff_t>(tail));
  };
  const Lines a_middle = middle(a);
  const Lines b_middle = middle(b);
  auto kept = Shortest(a_middle, b_middle).kept();
  std::reverse(kept.begin(), kept.end());
  kept.emplace_back(a_middle.size(), b_middle.size());
  std::vector<Change> changes;
  std::size_t x = 0;
  std::size_t y = 0;
  for (const auto& [i, j] : kept) {
    if (i > x || j > y) {
      changes.push_back({head + x, head + i, head + y, head + j});
    }
    x = i + 1;
    y = j + 1;
  }
  return changes;
}

void add_line(char mark, std::string_view line, std::string& out) {
  out += mark;
  out += line;
  if (!line.ends_with('\n')) out += "\n\\ No newline at end of file\n";
}

std::string range_text(std::size_t begin, std::size_t count) {
  const std::size_t first = count == 0 ? begin : begin + 1;
  return count == 1 ? fmt::format("{}", first)
                    : fmt::format("{},{}", first, count);
}

constexpr std::size_t kContext = 3;

/// Changes [first, last) are near each other: one hunk.
void add_hunk(const Lines& a, const Lines& b, const Change* first,
              const Change* last, std::string& out) {
  const std::size_t before = std::min(kContext, first->a_begin);
  const std::size_t behind = std::min(kContext, a.size() - last[-1].a_end);
  const std::size_t a_begin = first->a_begin - before;
  const std::size_t b_begin = first->b_begin - before;
  out += fmt::format("@@ -{} +{} @@\n",
                     range_text(a_begin, last[-1].a_end + behind - a_begin),
                     range_text(b_begin, last[-1].b_end + behind - b_begin));
  std::size_t at = a_begin;
  for (const Change* change = first; change != last; ++change) {
    for (; at < change->a_begin; ++at) add_line(' ', a[at], out);
    for (; at < change->a_end; ++at) add_line('-', a[at], out);
    for (std::size_t i = change->b_begin; i < change->b_end; ++i) {
      add_line('+', b[i], out);
    }
  }
  for (; at < last[-1].a_end + behind; ++at) add_line(' ', a[at], out);
}

}  // namespace

std::string unified_diff(const std::string& path, std::string_view before,
                         std::string_view after) {
  if (before == after) return "";
  const Lines a = lines_of(before);
  const Lines b = lines_of(after);
  const std::vector<Change> changes = changes_of(a, b);
  std::string out = fmt::format("--- {0}\n+++ {0}\n", path);
  for (std::size_t i = 0; i < changes.size();) {
    std::size_t end = i + 1;
    while (end < changes.size() &&
           changes[end].a_begin - changes[end - 1].a_end <= 2 * kContext) {
      ++end;
    }
    add_hunk(a, b, changes.data() + i, changes.data() + end, out);
    i = end;
  }
  return out;
}

}  // namespace rung
