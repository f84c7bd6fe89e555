#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace rung {

/// A stream of bytes to a controller. What fails says so in words.
class Port {
 public:
  explicit Port(int file) : file_(file) {}
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// What has come, at most so long after now; empty: nothing. No value: the
  /// stream has ended, error() says why.
  std::optional<std::string> read(int milliseconds);
  [[nodiscard]] bool write(std::string_view bytes);
  const std::string& error() const { return error_; }

 private:
  int file_;
  std::string error_;
};

/// A port, or why there is none.
struct OpenedPort {
  std::unique_ptr<Port> port;
  std::string error;
};

/// 8 data bits, no parity, no flow control. A port that is no terminal, or a
/// speed that it has not, is an error.
OpenedPort open_serial(const std::string& path, unsigned baud);

/// `HOST:PORT`, `[IPV6]:PORT`.
OpenedPort open_tcp(const std::string& address, double seconds);

}  // namespace rung
