#include "frontend/il_iec/reader.h"

#include "frontend/iec/text_reader.h"

namespace rung {

Ast read_il_iec(const SourceSet& sources, FileId file,
                const ReadOptions& options, DiagnosticSink& sink) {
  return iec::read_text(sources, file, "il-iec", options, sink);
}

bool is_il_iec(std::string_view text) {
  return iec::looks_like(text) == iec::Looks::List;
}

}  // namespace rung
