#include "backend/unit/lower_iec.h"

#include "backend/unit/builder.h"
#include "backend/unit/elements_iec.h"
#include "backend/unit/iec_text.h"

namespace rung::backend {

std::string program_name(const Program& program, const SourceSet& sources) {
  std::string name = sources[program.file].path();
  name.erase(0, name.find_last_of('/') + 1);
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos) name.resize(dot);
  return name;
}

std::optional<Unit> iec_unit(const Program& program, const SourceSet& sources,
                             std::string_view language, DiagnosticSink& sink) {
  const Profile profile = {.name = language, .names = &iec_names()};
  const auto elements = iec_elements();
  return UnitBuilder(program, profile, sink)
      .build(*elements, program_name(program, sources));
}

std::optional<Written> lower_to_iec(const Program& program,
                                    const SourceSet& sources,
                                    std::string_view language, WriteUnit write,
                                    DiagnosticSink& sink) {
  std::optional<Unit> unit = iec_unit(program, sources, language, sink);
  if (!unit) return std::nullopt;
  merge_pins(*unit);
  Written written = finish_written(*unit, {});
  written.text = write(*unit, place_comments(program, sources),
                       carry_properties(program, written.signals));
  return written;
}

}  // namespace rung::backend
