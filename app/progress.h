#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace rung {

/// A line on the terminal for work that takes more than a second. Nothing when
/// standard error is no terminal. May be called from several threads.
class Progress {
 public:
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text);

  /// For VerifyOptions::progress: the file's name before what is said.
  std::function<void(std::string_view)> of(std::string file);

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool shown_ = false;
  Clock::time_point next_;
  std::mutex mutex_;
};

}  // namespace rung
