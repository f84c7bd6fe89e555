#pragma once

#include <exception>
#include <string>
#include <utility>

namespace rung {

/// What went wrong in `action`: the text of its exception, never empty then.
/// A solver that runs out of memory costs one answer and not the report.
template <class Action>
std::string attempt(Action&& action) {
  try {
    std::forward<Action>(action)();
    return {};
  } catch (const std::exception& error) {
    std::string what = error.what();
    return what.empty() ? "an exception without a text" : what;
  }
}

}  // namespace rung
