#include "frontend/st/reader.h"

#include "frontend/iec/text_reader.h"

namespace rung {

Ast read_structured_text(const SourceSet& sources, FileId file,
                         const ReadOptions& options, DiagnosticSink& sink) {
  return iec::read_text(sources, file, "st", options, sink);
}

bool is_structured_text(std::string_view text) {
  return iec::looks_like(text) == iec::Looks::StructuredText;
}

}  // namespace rung
