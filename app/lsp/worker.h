#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rung::lsp {

/// A thread for what takes time: one task after the other, none before it is
/// due. What is no longer wanted is for the task itself to see.
class Worker {
 public:
  using Task = std::function<void()>;

  Worker();
  ~Worker();  // waits for the task that runs, and drops the others
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void post(Task task, std::chrono::milliseconds delay = {});

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    Clock::time_point due;
    Task task;
  };

  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Entry> entries_;  // in the order in which they were posted
  bool stopped_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace rung::lsp
