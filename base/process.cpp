#include "base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>

extern char** environ;

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

/// Both ends of a pipe, closed on every way out.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (pipe2(static_cast<int*>(ends), O_CLOEXEC) != 0) ends[0] = ends[1] = -1;
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_end(int index) {
    if (ends[index] >= 0) close(ends[index]);
    ends[index] = -1;
  }
};

int spawn(std::vector<std::string> arguments, int out, pid_t& child) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null",
                                   O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDERR_FILENO);
  const int failed = posix_spawnp(&child, argv.front(), &actions, nullptr,
                                  argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

/// Reads to the end of the stream; false when the time was up before.
bool read_all(int in, Clock::time_point deadline, std::size_t most_bytes,
              std::string& text) {
  char buffer[4096];
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                          deadline - Clock::now())
                          .count();
    if (left <= 0) return false;
    pollfd wait{in, POLLIN, 0};
    const int ready =
        poll(&wait, 1, static_cast<int>(std::min<std::int64_t>(left, 1000)));
    if (ready < 0 && errno != EINTR) return false;
    if (ready <= 0) continue;
    const ssize_t count = read(in, static_cast<char*>(buffer), sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    if (text.size() < most_bytes) {
      text.append(static_cast<char*>(buffer), static_cast<std::size_t>(count));
    }
  }
}

}  // namespace

ProcessOutput run_process(const std::vector<std::string>& arguments,
                          double seconds, std::size_t most_bytes) {
  ProcessOutput output;
  Pipe pipe;
  if (pipe.ends[0] < 0) {
    output.error = std::string("cannot make a pipe: ") + std::strerror(errno);
    return output;
  }
  pid_t child = 0;
  const int failed = spawn(arguments, pipe.ends[1], child);
  if (failed != 0) {
    output.error =
        "cannot run `" + arguments.front() + "`: " + std::strerror(failed);
    return output;
  }
  pipe.close_end(1);
  const auto limit = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6)));
  if (!read_all(pipe.ends[0], Clock::now() + limit, most_bytes, output.text)) {
    kill(child, SIGKILL);
    output.error = "time-out of `" + arguments.front() + "`";
  }
  while (waitpid(child, &output.status, 0) < 0 && errno == EINTR) {
  }
  return output;
}

}  // namespace rung
