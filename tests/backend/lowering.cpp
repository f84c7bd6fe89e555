#include "lowering.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/property.h"
#include "backend/ascii/write.h"
#include "backend/il_iec/write.h"
#include "backend/il_mitsubishi/write.h"
#include "backend/ldmicro/write.h"
#include "backend/plclib/write.h"
#include "backend/plcopen/write.h"
#include "backend/script/write.h"
#include "backend/st/write.h"
#include "frontend/recognise.h"
#include "smt/translation.h"

namespace rung {

const std::vector<WrittenLanguage>& written_languages() {
  static const std::vector<WrittenLanguage> kAll = {
      {"il-iec", lower_to_il_iec},
      {"script", lower_to_script},
      {"il-mitsubishi", lower_to_il_mitsubishi},
      {"ascii", lower_to_ascii},
      {"st", lower_to_st},
      {"plcopen", lower_to_plcopen},
      {"ldmicro", lower_to_ldmicro},
      {"plclib", lower_to_plclib},
  };
  return kAll;
}

std::unique_ptr<ReadProgram> read_program(std::string_view language,
                                          std::string_view dialect,
                                          const std::string& text,
                                          const std::string& path) {
  auto read = std::make_unique<ReadProgram>();
  DiagnosticList found;
  const FileId file = read->sources.add(path, text);
  ReadOptions options;
  options.dialect = dialect;
  const Ast ast =
      find_language(language)->read(read->sources, file, options, found);
  if (!found.has_errors()) read->program = build_program(ast, {}, found);
  // `//@ input` and `//@ scan` lines.
  if (!found.has_errors()) {
    read_properties(read->program, {}, read->sources, found);
  }
  for (const Diagnostic& item : found.items()) {
    if (item.severity != Severity::Error) continue;
    const LineColumn at = read->sources[file].position(item.where.begin);
    read->error += std::to_string(at.line) + ": " + item.message + "\n";
  }
  return read;
}

Lowered lower(const WrittenLanguage& language, const ReadProgram& source) {
  DiagnosticList found;
  Lowered result;
  result.written = language.write(source.program, source.sources, found);
  for (const Diagnostic& item : found.items()) {
    if (item.severity != Severity::Error) continue;
    result.refused += std::string(item.code) + " " + item.message + "\n";
  }
  return result;
}

std::string validate(const WrittenLanguage& language, const ReadProgram& source,
                     const backend::Written& written, double seconds) {
  const auto back = read_program(language.name, "", written.text);
  if (!back->error.empty()) return "it cannot be read: " + back->error;
  // Where the text says itself how long a scan takes, and nothing else counts.
  const ScanInterval own = back->program.scan;
  const bool other = own.min_ms < source.program.scan.min_ms ||
                     own.max_ms > source.program.scan.max_ms;
  if (language.name == "ldmicro" && other) return "different: its scan time";
  back->program.scan = source.program.scan;
  EquivalenceOptions options;
  options.budget.seconds = seconds;
  const TranslationCheck check = check_translation(
      source.program, back->program,
      {written.signals, written.elements, written.relations}, options);
  if (!check.lost.empty()) return check.lost;
  if (!check.result.failures.empty()) return check.result.failures[0].what;
  switch (check.result.verdict) {
    case EquivalenceVerdict::Equivalent:
      return "";
    case EquivalenceVerdict::Different:
      return "different: " + check.result.differs;
    case EquivalenceVerdict::Bounded:
    case EquivalenceVerdict::Unknown:
      break;
  }
  return "undecided: " + check.result.reason + check.result.error;
}

std::vector<std::pair<std::string, std::string>> corpus() {
  const std::filesystem::path root = RUNG_SOURCE_DIR "/corpus";
  std::vector<std::pair<std::string, std::string>> programs;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".rung") continue;
    const std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    programs.emplace_back(
        std::filesystem::relative(entry.path(), root).generic_string(),
        text.str());
  }
  std::sort(programs.begin(), programs.end());
  return programs;
}

}  // namespace rung
