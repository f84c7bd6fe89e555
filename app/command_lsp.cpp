#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "app/commands.h"
#include "app/lsp/framing.h"
#include "app/lsp/server.h"

namespace rung {

/// Messages come in on standard input and go out on standard output.
int run_lsp(const Options& options) {
  lsp::Server server(options, stdout);
  lsp::MessageReader reader;
  std::array<char, std::size_t{1} << 16> buffer{};
  while (true) {
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return 1;  // the client is gone without `exit`
    reader.feed({buffer.data(), static_cast<std::size_t>(got)});
    while (const auto message = reader.next()) {
      if (message->error.empty()) {
        server.receive(message->body);
      } else {
        server.receive_error(message->error);
      }
      if (server.exit()) return *server.exit();
    }
  }
}

}  // namespace rung
