#include "app/lsp/worker.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>

namespace rung::lsp {

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::post(Task task, std::chrono::milliseconds delay) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.push_back({Clock::now() + delay, std::move(task)});
  }
  changed_.notify_all();
}

void Worker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopped_) {
    const auto next = std::min_element(
        entries_.begin(), entries_.end(),
        [](const Entry& a, const Entry& b) { return a.due < b.due; });
    if (next == entries_.end()) {
      changed_.wait(lock);
    } else if (next->due > Clock::now()) {
      const Clock::time_point due = next->due;
      changed_.wait_until(lock, due);
    } else {
      const Task task = std::move(next->task);
      entries_.erase(next);
      lock.unlock();
      try {
        task();
      } catch (const std::exception& error) {
        std::fprintf(stderr, "rungproof: internal error: %s\n", error.what());
      }
      lock.lock();
    }
  }
}

}  // namespace rung::lsp
