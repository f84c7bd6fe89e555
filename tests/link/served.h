#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "tests/link/controller.h"

namespace rung {

/// A controller behind a pseudo terminal or a TCP port, in a thread of its own.
/// It may be looked at once stop() has returned.
class Served {
 public:
  enum class Wire { Terminal, Tcp };

  /// Time passes for the controller: it takes bytes, which may be none, and
  /// gives others.
  using Exchange = std::function<std::string(const std::string&)>;

  Served(Exchange exchange, Wire wire);
  Served(EmulatedController& controller, Wire wire)
      : Served(
            [&controller](const std::string& bytes) {
              return controller.exchange(bytes);
            },
            wire) {}
  ~Served() { stop(); }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  /// `--port ...` or `--tcp ...`.
  const std::string& option() const { return option_; }
  void stop();

  /// What becomes of the bytes that the controller says, and of those that it
  /// is sent. Set before anybody connects.
  std::function<std::string(std::string)> spoken = same;
  std::function<std::string(std::string)> heard = same;

 private:
  static std::string same(std::string bytes) { return bytes; }
  void serve();
  void open_terminal();
  void open_tcp();

  Exchange exchange_;
  std::string option_;
  int listening_ = -1;
  int wire_ = -1;
  int other_end_ = -1;  // keeps a terminal alive between two commands
  std::atomic<bool> stopped_ = false;
  std::thread thread_;
};

/// A shell command: what it said, and its exit status.
struct Said {
  int status = -1;
  std::string text;
};
Said shell(const std::string& command);

}  // namespace rung
