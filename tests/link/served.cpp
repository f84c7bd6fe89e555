#include "tests/link/served.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace rung {

Served::Served(Exchange exchange, Wire wire) : exchange_(std::move(exchange)) {
  if (wire == Wire::Terminal) {
    open_terminal();
  } else {
    open_tcp();
  }
  thread_ = std::thread([this] { serve(); });
}

void Served::open_terminal() {
  wire_ = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(wire_, 0);
  ASSERT_EQ(::grantpt(wire_), 0);
  ASSERT_EQ(::unlockpt(wire_), 0);
  const std::string name = ::ptsname(wire_);
  other_end_ = ::open(name.c_str(), O_RDWR | O_NOCTTY);
  option_ = "--port " + name;
}

void Served::open_tcp() {
  listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  ASSERT_EQ(::bind(listening_, any, size), 0);
  ASSERT_EQ(::listen(listening_, 4), 0);
  ASSERT_EQ(::getsockname(listening_, any, &size), 0);
  option_ = "--tcp 127.0.0.1:" + std::to_string(ntohs(address.sin_port));
}

// The thread sees `spoken` and `heard` when bytes come: a connection is later
// than whoever set them.
void Served::serve() {
  while (!stopped_) {
    pollfd wanted{wire_ >= 0 ? wire_ : listening_, POLLIN, 0};
    const bool ready = ::poll(&wanted, 1, 1) > 0;
    if (wire_ < 0) {
      if (ready) wire_ = ::accept(listening_, nullptr, nullptr);
      continue;
    }
    std::string in;
    if (ready) {
      std::array<char, 256> buffer{};
      const ssize_t size = ::read(wire_, buffer.data(), buffer.size());
      if (size <= 0 && listening_ >= 0) {
        ::close(wire_);
        wire_ = -1;
        continue;
      }
      in.assign(buffer.data(),
                static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    }
    const std::string out = spoken(exchange_(in.empty() ? in : heard(in)));
    if (out.empty()) continue;
    if (listening_ >= 0) {
      ::send(wire_, out.data(), out.size(), MSG_NOSIGNAL);
    } else if (::write(wire_, out.data(), out.size()) < 0) {
      return;
    }
  }
}

void Served::stop() {
  stopped_ = true;
  if (thread_.joinable()) thread_.join();
  for (int* const file : {&wire_, &other_end_, &listening_}) {
    if (*file >= 0) ::close(*file);
    *file = -1;
  }
}

Said shell(const std::string& command) {
  Said said;
  std::FILE* const pipe = ::popen(("( " + command + " ) 2>&1").c_str(), "r");
  if (pipe == nullptr) return said;
  std::array<char, 4096> buffer{};
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(buffer.data(), 1, buffer.size(), pipe);
    said.text.append(buffer.data(), size);
  }
  const int status = ::pclose(pipe);
  said.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}

}  // namespace rung
