#pragma once

#include <string>
#include <vector>

#include "smt/smtlib.h"

namespace rung {

/// A certificate's scripts, one for each of its parts, as a file for other
/// solvers: in a folder that was asked for, or a temporary one that is removed
/// with this object.
class ScriptFile {
 public:
  /// `directory` may be empty; `name` is the user's, and is cleaned.
  ScriptFile(const std::vector<const CertificateScript*>& scripts,
             const std::string& directory, const std::string& name);
  ~ScriptFile();
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& error() const { return error_; }  // empty: it is written

 private:
  bool temporary_;
  std::string path_;
  std::string error_;
};

}  // namespace rung
