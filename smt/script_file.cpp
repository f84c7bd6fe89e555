#include "smt/script_file.h"

#include <filesystem>
#include <fstream>

#include "base/file_stem.h"
#include "base/temporary_file.h"

namespace rung {
ScriptFile::ScriptFile(const std::vector<const CertificateScript*>& scripts,
                       const std::string& directory, const std::string& name)
    : temporary_(directory.empty()) {
  std::error_code ignored;
  if (temporary_) {
    path_ = make_temporary_file();
  } else {
    std::filesystem::create_directories(directory, ignored);
    path_ = (std::filesystem::path(directory) / (file_stem(name) + ".smt2"))
                .string();
  }
  std::ofstream out(path_, std::ios::binary);
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    if (i > 0) out << "(reset)\n";
    out << scripts[i]->file("Rungproof certificate: " + name + ", part " +
                            std::to_string(i + 1) + " of " +
                            std::to_string(scripts.size()));
  }
  out << "(exit)\n";
  out.close();
  if (!out) error_ = "cannot write `" + path_ + "`";
}

ScriptFile::~ScriptFile() {
  std::error_code ignored;
  if (temporary_) std::filesystem::remove(path_, ignored);
}

}  // namespace rung
