#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "reports/unicode.h"

namespace rung {
namespace {

constexpr std::chrono::milliseconds kPatience(1000);
constexpr std::chrono::milliseconds kInterval(200);
constexpr std::size_t kWidth = 78;

}  // namespace

Progress::Progress(bool enabled)
    : enabled_(enabled && ::isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + kPatience) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::string_view text) {
  if (!enabled_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  shown_ = true;
  fmt::print(stderr, "\r\x1b[K{}", printable(text.substr(0, kWidth)));
  std::fflush(stderr);
}

std::function<void(std::string_view)> Progress::of(std::string file) {
  if (!enabled_) return {};
  return [this, file = std::move(file)](std::string_view text) {
    show(fmt::format("{}: {}", file, text));
  };
}

}  // namespace rung
