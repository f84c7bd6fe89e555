#include "base/temporary_file.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rung {

std::string make_temporary_file() {
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path(ignored);
  std::string path = (folder / "rungproof-XXXXXX").string();
  const int file = mkstemp(path.data());
  if (file >= 0) close(file);
  return path;
}

TemporaryFile::TemporaryFile(std::string_view content)
    : path_(make_temporary_file()) {
  std::ofstream out(path_, std::ios::binary);
  out << content;
  out.close();
  if (!out) error_ = "cannot write `" + path_ + "`";
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace rung
