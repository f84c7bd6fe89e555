#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "app/commands.h"
#include "app/controller.h"
#include "app/output.h"
#include "app/session.h"
#include "app/translation.h"
#include "backend/ascii/write.h"
#include "backend/il_iec/write.h"
#include "backend/il_mitsubishi/write.h"
#include "backend/ldmicro/write.h"
#include "backend/plclib/write.h"
#include "backend/plcopen/write.h"
#include "backend/postfix/lower.h"
#include "backend/script/write.h"
#include "backend/st/write.h"
#include "base/text.h"

namespace rung {
namespace {

/// A language that can be written; `write` is null for postfix, which has a
/// form in bytes as well.
struct Target {
  std::string_view name;
  std::optional<backend::Written> (*write)(const Program& program,
                                           const SourceSet& sources,
                                           DiagnosticSink& sink) = nullptr;
};
constexpr std::array kTargets = {
    Target{"postfix"},
    Target{"il-iec", lower_to_il_iec},
    Target{"il-mitsubishi", lower_to_il_mitsubishi},
    Target{"plclib", lower_to_plclib},
    Target{"plcopen", lower_to_plcopen},
    Target{"ldmicro", lower_to_ldmicro},
    Target{"ascii", lower_to_ascii},
    Target{"st", lower_to_st},
    Target{"script", lower_to_script},
};

std::optional<std::string> check_target(const Options& options) {
  std::vector<std::string_view> names;
  for (const Target& target : kTargets) {
    if (target.name == options.to) return std::nullopt;
    names.push_back(target.name);
  }
  return fmt::format("--to: there is no language `{}`{}", options.to,
                     did_you_mean(options.to, names));
}

bool to_standard_output(const Options& options) {
  return options.output.empty() || options.output == "-";
}

int write_lowered(const Options& options, const std::string& bytes) {
  if (to_standard_output(options)) return print_out(bytes) ? 0 : kExitUsage;
  const auto error = write_file(options.output, bytes);
  return error ? output_error(options.output, *error) : 0;
}

std::optional<backend::Written> write_postfix(const Program& program,
                                              const Options& options,
                                              DiagnosticSink& sink) {
  std::optional<std::string> bytes =
      options.binary || options.header ? lower_to_postfix_binary(program, sink)
                                       : lower_to_postfix_text(program, sink);
  if (!bytes) return std::nullopt;
  return backend::Written{.text = std::move(*bytes)};
}

std::optional<std::string> check_form(const Options& options) {
  const char* const form = options.binary   ? "--binary"
                           : options.header ? "--header"
                           : options.report ? "--report"
                                            : nullptr;
  if (form == nullptr) return std::nullopt;
  if (options.to != "postfix") {
    return fmt::format("{}: only postfix has a binary form", form);
  }
  if (options.binary && options.header) {
    return "--header: the bytes or an array of them, not both";
  }
  const bool to_terminal = options.binary && !options.report &&
                           to_standard_output(options) &&
                           ::isatty(STDOUT_FILENO) != 0;
  if (to_terminal) return "--binary: a terminal cannot show it";
  return std::nullopt;
}

/// What was lowered and proved, in the form that is asked for.
int deliver(const Program& program, const std::string& text,
            const Options& options) {
  if (options.report) {
    DiagnosticList known;  // it has been lowered before
    const auto bytes = options.binary || options.header
                           ? text
                           : lower_to_postfix_binary(program, known);
    if (!bytes || !print_out(controller_report(*bytes))) return kExitUsage;
    if (options.output.empty()) return 0;
  }
  return write_lowered(
      options, options.header ? controller_header(text, options) : text);
}

}  // namespace

int run_lower(const Options& options) {
  if (const auto error = check_target(options)) return usage_error(*error);
  if (const auto error = check_form(options)) return usage_error(*error);
  if (options.rollover) {
    return usage_error(
        "lower writes what a program is; `--rollover` says on which clock it "
        "runs");
  }
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  if (session.inputs().size() != 1) {
    return usage_error("lower takes one program, and a directory is none");
  }
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const auto* const target =
      std::find_if(kTargets.begin(), kTargets.end(),
                   [&](const Target& it) { return it.name == options.to; });
  DiagnosticList found;
  std::optional<backend::Written> written =
      target->write != nullptr
          ? target->write(*loaded.program, session.sources(), found)
          : write_postfix(*loaded.program, options, found);
  loaded.report.findings = found.take();
  print_input_errors(session.sources(), loaded.report, options);  // and notes
  if (!written) return kExitUsage;
  const Validation validation =
      target->write != nullptr
          ? validate_written(*loaded.program, *written, options)
          : validate_translation(*loaded.program, written->text, options);
  if (validation.status != 0) return unproved(validation, "it is not written");
  return deliver(*loaded.program, written->text, options);
}

}  // namespace rung
