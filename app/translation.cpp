#include "app/translation.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "app/controller.h"
#include "app/load.h"
#include "frontend/postfix/reader.h"
#include "smt/translation.h"

namespace rung {
namespace {

constexpr int kExitUndecided = 3;

/// Every cell that a rung writes, so that memory is compared as well.
void observe_memory(Program& program) {
  for (const CellId id : ids_of(program.cells)) {
    if (program.cells[id].role == CellRole::Memory) {
      program.cells[id].role = CellRole::Output;
    }
  }
}

/// Name, type, direction and range of every cell, before the first scan and
/// in all others; the scan's time. The first that differs, or nothing.
std::string lost_declaration(const Program& source, const Program& written) {
  std::unordered_map<std::string_view, const Cell*> cells;
  for (const Cell& cell : written.cells) cells.emplace(cell.name, &cell);
  for (const Cell& cell : source.cells) {
    const auto found = cells.find(cell.name);
    if (found == cells.end()) return "`" + cell.name + "` is lost";
    const Cell& other = *found->second;
    if (other.type != cell.type || other.role != cell.role ||
        other.initial != cell.initial || other.low != cell.low ||
        other.high != cell.high) {
      return "the declaration of `" + cell.name + "` differs";
    }
  }
  if (written.cells.size() != source.cells.size()) return "a cell is new";
  if (written.instances.size() != source.instances.size()) {
    return "an element is lost or new";
  }
  if (written.scan.min_ms != source.scan.min_ms ||
      written.scan.max_ms != source.scan.max_ms) {
    return "the scan interval differs";
  }
  return {};
}

/// What was written, read again as a user would read it; else the error.
std::optional<Program> read_back(std::string written, SourceSet& sources,
                                 std::string& error) {
  DiagnosticList errors;
  const FileId file =
      add_postfix(sources, "what was written", std::move(written), errors);
  std::optional<Program> program;
  if (file.has_value()) {
    const Ast ast = read_postfix(sources, file, errors);
    if (!errors.has_errors()) program = build_program(ast, {}, errors);
  }
  if (!errors.has_errors()) return program;
  for (const Diagnostic& item : errors.items()) {
    if (item.severity == Severity::Error) error = item.message;
  }
  return std::nullopt;
}

/// Whether the controller's own loader takes the bytes; else its refusal.
std::string refusal_of(const std::string& bytes) {
  const LoadedMachine loaded(bytes);
  if (loaded.refusal == rungproof::Refusal::None) return {};
  return fmt::format("the machine refuses it ({}) at byte {}",
                     static_cast<int>(loaded.refusal),
                     loaded.machine.refused_at());
}

std::string first_difference(const EquivalenceResult& result) {
  if (!result.trace_a || result.trace_a->steps.empty()) return result.reason;
  return fmt::format("an output differs at the end of scan {}",
                     result.trace_a->steps.back().scan);
}

EquivalenceOptions equivalence_options(const Options& options) {
  EquivalenceOptions equivalence;
  equivalence.budget.seconds = options.timeout;
  equivalence.self_check = options.self_check;
  return equivalence;
}

Validation answer(const EquivalenceResult& result) {
  if (!result.failures.empty()) {
    return {kExitInternal, "a self-check failed", result.engine};
  }
  switch (result.verdict) {
    case EquivalenceVerdict::Equivalent:
      return {0, "", result.engine};
    case EquivalenceVerdict::Different:
      return {kExitInternal, first_difference(result), result.engine};
    case EquivalenceVerdict::Bounded:
    case EquivalenceVerdict::Unknown:
      break;
  }
  const std::string& why = result.error.empty() ? result.reason : result.error;
  return {kExitUndecided, why, result.engine};
}

Validation compare(Program source, Program written, const Options& options) {
  std::string lost = lost_declaration(source, written);
  if (!lost.empty()) return {kExitInternal, std::move(lost), ""};
  observe_memory(source);
  observe_memory(written);
  // Where elapsed times saturate is a choice of the encoding: the properties
  // of the source have raised it there.
  for (const InstanceId id : ids_of(source.instances)) {
    written.instances[id].clock_cap = source.instances[id].clock_cap;
  }
  return answer(
      check_equivalence(source, written, equivalence_options(options)));
}

}  // namespace

Validation validate_translation(const Program& source,
                                const std::string& written,
                                const Options& options) {
  if (options.binary) {
    std::string refusal = refusal_of(written);
    if (!refusal.empty()) return {kExitInternal, std::move(refusal), ""};
  }
  SourceSet sources;
  std::string error;
  auto program = read_back(written, sources, error);
  if (!program) {
    return {kExitInternal, "it cannot be read back: " + error, ""};
  }
  // Without a rung there is nothing to compare.
  if (source.rungs.empty() && program->rungs.empty()) return {};
  return compare(source, std::move(*program), options);
}

Validation validate_written(const Program& source,
                            const backend::Written& written,
                            const Options& options) {
  SourceSet sources;
  Options reading;
  reading.language = options.to;
  reading.scan = source.scan;
  const FileId file = sources.add("what was written", written.text);
  Loaded loaded = load({file, "what was written", {}}, reading, {}, sources);
  if (!loaded.program) {
    std::string error;
    int status = kExitInternal;
    for (const Diagnostic& item : loaded.report.findings) {
      if (item.severity != Severity::Error || !error.empty()) continue;
      // A limit of the reader's, and nothing wrong with the text.
      if (item.code == "RP050") status = kExitUsage;
      error = fmt::format("line {}: {}",
                          sources[file].position(item.where.begin).line,
                          item.message);
    }
    return {status, "it cannot be read back: " + error, ""};
  }
  // A text may say itself how long its scans take.
  const ScanInterval own = loaded.program->scan;
  if (own.min_ms < source.scan.min_ms || own.max_ms > source.scan.max_ms) {
    return {kExitInternal, "its scan time is not one of the source's", ""};
  }
  loaded.program->scan = source.scan;
  const TranslationCheck check =
      check_translation(source, *loaded.program,
                        {written.signals, written.elements, written.relations},
                        equivalence_options(options));
  if (!check.lost.empty()) return {kExitInternal, check.lost, ""};
  return answer(check.result);
}

int unproved(const Validation& validation, std::string_view consequence) {
  fmt::print(stderr,
             "rungproof: {}the lowered program is not proved equivalent to its "
             "source, so {}: {}\n",
             validation.status == kExitInternal ? "internal error: " : "",
             consequence, validation.reason);
  return validation.status;
}

}  // namespace rung
