#include "app/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>

#include "analysis/rollover.h"
#include "frontend/recognise.h"

namespace rung {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// The language of an input, or why there is no reader for it.
const Language* choose_language(const Input& input, const Options& options,
                                std::string_view text, DiagnosticSink& sink) {
  const std::string_view named = !options.language.empty()
                                     ? std::string_view(options.language)
                                     : declared_language(text);
  const Language* language =
      named.empty() ? &recognise(text) : find_language(named);
  if (language == nullptr) {
    std::string known;
    for (const Language& one : languages()) {
      if (!one.supported()) continue;
      known += fmt::format("{}`{}`", known.empty() ? "" : ", ", one.name);
    }
    sink.report(
        file_error(input.file, "RP073",
                   fmt::format("there is no language `{}`: the names are {}",
                               named, known)));
    return nullptr;
  }
  if (!language->supported()) {
    sink.report(file_error(
        input.file, "RP074",
        fmt::format("{} are not read, and this {} one of them",
                    language->plural,
                    named.empty() ? "looks like" : "is said to be")));
    return nullptr;
  }
  return language;
}

void check_dialect(const Input& input, const Language& language,
                   const Options& options, DiagnosticSink& sink) {
  if (options.dialect.empty()) return;
  const bool scripts = language.name == "script" || language.name == "postfix";
  if (!scripts) {
    sink.report(
        file_error(input.file, "RP075",
                   fmt::format("this is `{}`: `--dialect` is for scripts",
                               language.name)));
  } else if (!language.has_preset(options.dialect)) {
    sink.report(file_error(
        input.file, "RP075",
        fmt::format("there is no dialect `{}`: the names "
                    "are `{}`",
                    options.dialect, fmt::join(language.presets, "`, `"))));
  } else if (!options.semantics.empty() &&
             options.dialect != options.semantics) {
    sink.report(file_error(
        input.file, "RP076",
        fmt::format("the dialect `{}` has its own semantics, not `{}`",
                    options.dialect, options.semantics)));
  }
}

/// A configuration speaks for many programs: what it says of the meaning of
/// other languages says nothing of this one.
Options fitting(const Language& language, Options options) {
  const auto drop = [&](const char* key, std::string& value) {
    const bool meant = language.has_preset(value);
    if (options.configured.contains(key) && !meant) value.clear();
  };
  drop("semantics", options.semantics);
  drop("dialect", options.dialect);
  return options;
}

/// What the options ask for; what they leave open, the text decides.
ReadOptions choose_reading(const Input& input, const Language& language,
                           const Options& options, DiagnosticSink& sink) {
  ReadOptions reading;
  if (!options.semantics.empty() && !language.has_preset(options.semantics)) {
    sink.report(file_error(
        input.file, "RP076",
        fmt::format(
            "there are no semantics `{}` for this language: {} `{}`",
            options.semantics,
            language.presets.size() == 1 ? "the preset is" : "the presets are",
            fmt::join(language.presets, "`, `"))));
    return reading;
  }
  check_dialect(input, language, options, sink);
  reading.semantics = find_semantics(options.semantics);
  reading.stable_inputs = options.stable_inputs;
  reading.pou = options.pou;
  reading.dialect =
      options.dialect.empty() ? options.semantics : options.dialect;
  return reading;
}

/// What is not part of the answer.
std::vector<std::string> notes_of(const Program& program) {
  std::vector<std::string> notes;
  std::string inputs;
  for (const Cell& cell : program.cells) {
    if (!cell.plant_written || cell.role != CellRole::Input) continue;
    inputs += inputs.empty() ? "" : ", ";
    inputs += cell.type == Type::Word
                  ? fmt::format("`{}` is free in {}..{}", cell.name, cell.low,
                                cell.high)
                  : fmt::format("`{}` is free", cell.name);
  }
  if (!program.plant.statements.empty()) {
    notes.push_back("the plant (`//Sim`) is not part of proofs" +
                    (inputs.empty() ? "" : ": " + inputs));
  }
  return notes;
}

/// Timers on a clock of 32 bits. False: an error; some read it in a way that
/// is not modelled.
bool roll_over(const Input& input, const Ast& ast, Program& program,
               FileReport& report, DiagnosticSink& sink) {
  if (ast.dialect.starts_with("plclib")) {
    sink.report(file_error(input.file, "RP076",
                           "`--rollover`: how plcLib's timers behave when "
                           "millis() begins anew is not modelled"));
    return false;
  }
  report.semantics += "+rollover";
  if (!use_rollover(program)) {
    report.notes.emplace_back(
        "`--rollover` changes nothing: no timer here reads a clock of 32 bits");
  }
  return true;
}

/// Reads, builds and binds the properties, as far as there are no errors.
std::shared_ptr<Program> build(const Input& input, const Options& options,
                               const std::vector<AstAnnotation>& extra,
                               const SourceSet& sources, FileReport& report,
                               DiagnosticList& errors) {
  const std::string_view text = sources[input.file].text();
  const Language* language = choose_language(input, options, text, errors);
  if (language == nullptr) return nullptr;
  report.language = language->name;
  const Options fit = fitting(*language, options);  // `reading` points into it
  const ReadOptions reading = choose_reading(input, *language, fit, errors);
  if (errors.has_errors()) return nullptr;
  const Ast ast = language->read(sources, input.file, reading, errors);
  report.dialect = ast.dialect;
  report.semantics = ast.semantics.empty() ? ast.dialect : ast.semantics;
  if (errors.has_errors()) return nullptr;
  BuildOptions build_options;
  if (options.scan) build_options.scan = *options.scan;
  auto program =
      std::make_shared<Program>(build_program(ast, build_options, errors));
  if (errors.has_errors()) return nullptr;
  if (options.rollover && !roll_over(input, ast, *program, report, errors)) {
    return nullptr;
  }
  report.properties = read_properties(*program, extra, sources, errors);
  if (errors.has_errors()) return nullptr;
  // The command line has the last word over `//@ scan` lines, and what counts
  // scans of the time that its file says over both.
  if (options.scan && !options.configured.contains("scan")) {
    program->scan = *options.scan;
  }
  if (ast.dialect == "ldmicro") {
    program->scan = {ast.scan_min_ms, ast.scan_max_ms};
  }
  return program;
}

}  // namespace

std::vector<AstAnnotation> property_lines(const SourceSet& sources,
                                          FileId file) {
  std::vector<AstAnnotation> lines;
  const std::string_view text = sources[file].text();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end =
        std::min(text.find_first_of("\r\n", at), text.size());
    const std::size_t begin =
        std::min(text.find_first_not_of(kBlanks, at), end);
    std::string_view line = text.substr(begin, end - begin);
    at = end + 1;
    while (!line.empty() && kBlanks.find(line.back()) != kBlanks.npos) {
      line.remove_suffix(1);
    }
    if (line.empty() || line.starts_with("//")) continue;
    const auto offset = static_cast<std::uint32_t>(begin);
    const auto length = static_cast<std::uint32_t>(line.size());
    lines.push_back({line, {file, offset, offset + length}});
  }
  return lines;
}

std::vector<std::string_view> presets_of(const Input& input,
                                         const Options& options,
                                         const SourceSet& sources) {
  if (input.error) return {};
  DiagnosticList ignored;  // load() reports them
  const Language* const language =
      choose_language(input, options, sources[input.file].text(), ignored);
  if (language == nullptr) return {};
  return {language->presets.begin(), language->presets.end()};
}

Loaded load(const Input& input, const Options& options,
            const std::vector<AstAnnotation>& extra, const SourceSet& sources) {
  Loaded loaded;
  loaded.report.file = input.file;
  loaded.report.path = input.path;
  if (input.error) {
    loaded.report.findings.push_back(*input.error);
    return loaded;
  }
  DiagnosticList found;
  loaded.program = build(input, options, extra, sources, loaded.report, found);
  loaded.report.findings = found.take();
  sort_diagnostics(loaded.report.findings);
  if (loaded.program) {
    loaded.report.program = loaded.program;
    for (std::string& note : notes_of(*loaded.program)) {
      loaded.report.notes.push_back(std::move(note));
    }
  }
  return loaded;
}

}  // namespace rung
