#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/program.h"
#include "backend/unit/unit.h"
#include "base/source.h"

namespace rung {

/// A language that can be written and read.
struct WrittenLanguage {
  std::string_view name;
  std::optional<backend::Written> (*write)(const Program& program,
                                           const SourceSet& sources,
                                           DiagnosticSink& sink);
};
inline std::ostream& operator<<(std::ostream& out,
                                const WrittenLanguage& language) {
  return out << language.name;
}

/// All of them but postfix, which has tests of its own.
const std::vector<WrittenLanguage>& written_languages();

/// A text as a program, with what it points into; errors are in `error`.
struct ReadProgram {
  SourceSet sources;
  Program program;
  std::string error;
};
std::unique_ptr<ReadProgram> read_program(std::string_view language,
                                          std::string_view dialect,
                                          const std::string& text,
                                          const std::string& path = "test");

struct Lowered {
  std::optional<backend::Written> written;
  std::string refused;  // the messages, a line each
};
Lowered lower(const WrittenLanguage& language, const ReadProgram& source);

/// Empty when what was written is proved to be its source; else what the
/// validation says.
std::string validate(const WrittenLanguage& language, const ReadProgram& source,
                     const backend::Written& written, double seconds = 20);

/// The example programs: name and text.
std::vector<std::pair<std::string, std::string>> corpus();

}  // namespace rung
