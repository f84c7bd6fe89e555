#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rung::test {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// A directory of its own, removed at the end.
class Sandbox {
 public:
  Sandbox() {
    std::string name =
        (fs::temp_directory_path() / "rungproof-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Sandbox() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  const fs::path& path() const { return path_; }

  /// The exit status; output is in `.stdout` and `.stderr`.
  int run(const std::string& command) const {
    const std::string program = fs::path(RUNG_PROGRAM).parent_path().string();
    const std::string line = "cd '" + path_.string() + "' && PATH='" + program +
                             "':\"$PATH\" && ( " + command +
                             " ) >.stdout 2>.stderr";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string out() const { return read_text(path_ / ".stdout"); }
  std::string err() const { return read_text(path_ / ".stderr"); }

 private:
  fs::path path_;
};

}  // namespace rung::test
