#include "frontend/script/reader.h"

namespace rung {

Ast read_script(const SourceSet&, FileId file, std::string_view,
                DiagnosticSink&) {
  return {.file = file};
}

}  // namespace rung
