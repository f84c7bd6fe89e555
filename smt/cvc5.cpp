#include "smt/cvc5.h"

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
#include <sstream>

extern char** environ;

namespace rung {
namespace {

using Clock = std::chrono::steady_clock;

struct Output {
  std::string text;
  int status = 0;     // as waitpid gives it
  std::string error;  // it did not run, or not to its end
};

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
bool read_all(int in, Clock::time_point deadline, std::string& text) {
  constexpr std::size_t kMostText = std::size_t{1} << 20;
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
    if (text.size() < kMostText) {
      text.append(static_cast<char*>(buffer), static_cast<std::size_t>(count));
    }
  }
}

Output run(const std::vector<std::string>& arguments, double seconds) {
  Output output;
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
  if (!read_all(pipe.ends[0], Clock::now() + limit, output.text)) {
    kill(child, SIGKILL);
    output.error = "time-out of `" + arguments.front() + "`";
  }
  while (waitpid(child, &output.status, 0) < 0 && errno == EINTR) {
  }
  return output;
}

/// "This is cvc5 version 1.0.3 [git ...]"
std::string version_of(const std::string& banner) {
  const std::string_view marker = "cvc5 version ";
  const std::size_t found = banner.find(marker);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + marker.size();
  return banner.substr(begin, banner.find_first_of(" \n", begin) - begin);
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

SolverAnswers run_cvc5(const std::string& path, double seconds) {
  SolverAnswers result;
  const Output banner = run({"cvc5", "--version"}, 10);
  result.error = banner.error;
  if (!result.error.empty()) return result;
  result.version = version_of(banner.text);
  const Output output =
      run({"cvc5", "--lang=smt2", "--incremental", path}, seconds);
  result.error = output.error;
  if (!result.error.empty()) return result;
  std::istringstream lines(output.text);
  for (std::string line; std::getline(lines, line);) {
    if (line == "sat" || line == "unsat" || line == "unknown") {
      result.answers.push_back(line);
    } else if (result.error.empty()) {
      result.error = "cvc5: " + first_line(line);
    }
  }
  if (result.error.empty() && output.status != 0) {
    result.error = "cvc5 failed with status " + std::to_string(output.status);
  }
  return result;
}

}  // namespace rung
