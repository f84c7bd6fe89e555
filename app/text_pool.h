#pragma once

#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace rung {

/// Texts that reports point into: a rule's are constants of the program, those
/// of an answer that was kept have to live somewhere. For any thread.
class TextPool {
 public:
  std::string_view keep(std::string text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return *texts_.insert(std::move(text)).first;
  }

 private:
  std::mutex mutex_;
  std::set<std::string> texts_;  // a node is never moved
};

}  // namespace rung
