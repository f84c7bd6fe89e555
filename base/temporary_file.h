#pragma once

#include <string>
#include <string_view>

namespace rung {

/// Makes an empty file in the system's folder for such, and gives its path.
std::string make_temporary_file();

/// A file for another program to read, removed with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view content);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& error() const { return error_; }  // empty: it is written

 private:
  std::string path_;
  std::string error_;
};

}  // namespace rung
