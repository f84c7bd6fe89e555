#include "check/solver.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/process.h"

namespace rung::check {
namespace {

constexpr std::size_t kMostText = std::size_t{16} << 20;

/// A file that is gone with this.
class Temporary {
 public:
  Temporary() {
    std::error_code ignored;
    path_ = (std::filesystem::temp_directory_path(ignored) /
             "rungproof-check-XXXXXX")
                .string();
    const int file = mkstemp(path_.data());
    made_ = file >= 0;
    if (made_) close(file);
  }
  ~Temporary() {
    std::error_code ignored;
    if (made_) std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const std::string& path() const { return path_; }
  bool made() const { return made_; }

 private:
  std::string path_;
  bool made_ = false;
};

bool write(const std::string& path, const std::vector<std::string>& scripts) {
  std::ofstream out(path, std::ios::binary);
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    out << (i > 0 ? "(reset)\n" : "") << scripts[i];
  }
  out << "(exit)\n";
  out.close();
  return static_cast<bool>(out);
}

}  // namespace

Answers ask_solver(const std::string& solver,
                   const std::vector<std::string>& scripts, double seconds) {
  Answers result;
  const Temporary file;
  if (!file.made() || !write(file.path(), scripts)) {
    result.error = "cannot write `" + file.path() + "`";
    return result;
  }
  std::vector<std::string> command = {"z3", "-smt2", "smt.arith.solver=2",
                                      file.path()};
  if (solver == "cvc5") {
    command = {"cvc5", "--lang=smt2", "--incremental", file.path()};
  }
  const ProcessOutput output = run_process(command, seconds, kMostText);
  std::istringstream lines(output.text);
  for (std::string line; std::getline(lines, line);) {
    if (line == "sat" || line == "unsat" || line == "unknown") {
      result.list.push_back(line);
    } else if (result.error.empty()) {
      result.error = solver + ": " + line.substr(0, 200);
    }
  }
  if (!output.error.empty()) result.error = output.error;
  if (result.error.empty() && output.status != 0) {
    result.error = solver + " failed";
  }
  return result;
}

}  // namespace rung::check
