#include "app/port.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace rung {
namespace {

constexpr int kWriteMs = 5000;

std::string system_error() { return std::strerror(errno); }

/// Whether the file is ready in time; a signal is no reason to go on waiting.
bool ready(int file, short events, int milliseconds) {
  pollfd wanted{file, events, 0};
  return ::poll(&wanted, 1, milliseconds) > 0;
}

struct Speed {
  unsigned baud;
  speed_t code;
};
constexpr Speed kSpeeds[] = {
    {9600, B9600},     {19200, B19200},     {38400, B38400},
    {57600, B57600},   {115200, B115200},   {230400, B230400},
    {500000, B500000}, {1000000, B1000000},
};

std::optional<speed_t> speed_of(unsigned baud) {
  for (const Speed& speed : kSpeeds) {
    if (speed.baud == baud) return speed.code;
  }
  return std::nullopt;
}

/// Why the port cannot be set up; empty when it is.
std::string set_up(int file, speed_t speed) {
  termios settings{};
  if (::tcgetattr(file, &settings) != 0) return "it is no serial port";
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  // Hanging up resets many boards: the next command shall find this one as it
  // is.
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
  if (::tcsetattr(file, TCSANOW, &settings) != 0) return system_error();
  ::tcflush(file, TCIOFLUSH);
  return "";
}

struct Address {
  std::string host;
  std::string service;
};

std::optional<Address> split(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
    return std::nullopt;
  }
  Address address{text.substr(0, colon), text.substr(colon + 1)};
  const bool bracketed =
      address.host.starts_with('[') && address.host.ends_with(']');
  if (bracketed) {
    address.host = address.host.substr(1, address.host.size() - 2);
  } else if (address.host.find(':') != std::string::npos) {
    return std::nullopt;
  }
  return address;
}

/// A connected socket, or -1 and errno.
int connect_to(const addrinfo& target, int milliseconds) {
  const int file = ::socket(
      target.ai_family, target.ai_socktype | SOCK_NONBLOCK, target.ai_protocol);
  if (file < 0) return -1;
  int failed = 0;
  if (::connect(file, target.ai_addr, target.ai_addrlen) != 0) {
    failed = errno;
    if (failed == EINPROGRESS) {
      socklen_t size = sizeof failed;
      failed = ETIMEDOUT;
      if (ready(file, POLLOUT, milliseconds)) {
        ::getsockopt(file, SOL_SOCKET, SO_ERROR, &failed, &size);
      }
    }
  }
  if (failed == 0) {
    // Frames are small, and each is answered before the next one.
    const int on = 1;
    ::setsockopt(file, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return file;
  }
  ::close(file);
  errno = failed;
  return -1;
}

}  // namespace

Port::~Port() { ::close(file_); }

std::optional<std::string> Port::read(int milliseconds) {
  if (!ready(file_, POLLIN, milliseconds)) return "";
  std::array<char, 4096> buffer{};
  const ssize_t size = ::read(file_, buffer.data(), buffer.size());
  if (size > 0) return std::string(buffer.data(), static_cast<size_t>(size));
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return "";
  error_ = size == 0 ? "the other end has closed it" : system_error();
  return std::nullopt;
}

bool Port::write(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!ready(file_, POLLOUT, kWriteMs)) {
      error_ = "it takes no bytes";
      return false;
    }
    const ssize_t size = ::write(file_, bytes.data(), bytes.size());
    if (size < 0 && errno != EAGAIN && errno != EINTR) {
      error_ = system_error();
      return false;
    }
    if (size > 0) bytes.remove_prefix(static_cast<std::size_t>(size));
  }
  return true;
}

OpenedPort open_serial(const std::string& path, unsigned baud) {
  const std::optional<speed_t> speed = speed_of(baud);
  if (!speed) {
    return {nullptr, fmt::format("--baud: there is no speed of {}", baud)};
  }
  const int file =
      ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    return {nullptr, fmt::format("--port {}: {}", path, system_error())};
  }
  auto port = std::make_unique<Port>(file);
  const std::string error = set_up(file, *speed);
  if (!error.empty()) {
    return {nullptr, fmt::format("--port {}: {}", path, error)};
  }
  return {std::move(port), ""};
}

OpenedPort open_tcp(const std::string& address, double seconds) {
  const std::optional<Address> parts = split(address);
  if (!parts) {
    return {nullptr,
            fmt::format("--tcp {}: it is not of the form HOST:PORT", address)};
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int status = ::getaddrinfo(parts->host.c_str(), parts->service.c_str(),
                                   &hints, &found);
  if (status != 0) {
    return {nullptr,
            fmt::format("--tcp {}: {}", address, ::gai_strerror(status))};
  }
  int file = -1;
  for (const addrinfo* it = found; it != nullptr && file < 0;
       it = it->ai_next) {
    file = connect_to(*it, static_cast<int>(seconds * 1000));
  }
  const std::string error = system_error();
  ::freeaddrinfo(found);
  if (file < 0) {
    return {nullptr, fmt::format("--tcp {}: {}", address, error)};
  }
  return {std::make_unique<Port>(file), ""};
}

}  // namespace rung
