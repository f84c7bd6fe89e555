#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "app/translation.h"
#include "backend/postfix/lower.h"
#include "base/text.h"

namespace rung {
namespace {

/// A language that can be written; `write` is null while it is only planned.
struct Target {
  std::string_view name;
  bool supported = false;
};
constexpr std::array kTargets = {
    Target{"postfix", true}, Target{"il-iec"},  Target{"il-mitsubishi"},
    Target{"plclib"},        Target{"plcopen"}, Target{"ldmicro"},
    Target{"ascii"},         Target{"st"},      Target{"script"},
};

std::optional<std::string> check_target(const Options& options) {
  std::vector<std::string_view> names;
  for (const Target& target : kTargets) {
    if (target.name == options.to && target.supported) return std::nullopt;
    if (target.name == options.to) {
      return fmt::format("--to: `{}` is not supported yet", options.to);
    }
    names.push_back(target.name);
  }
  return fmt::format("--to: there is no language `{}`{}", options.to,
                     did_you_mean(options.to, names));
}

/// Says why the lowered program is not left on disk: a fault of ours, or a
/// proof that did not come to an end.
int refuse(const Validation& validation) {
  fmt::print(stderr,
             "rungproof: {}the lowered program is not proved equivalent to its "
             "source, so it is not written: {}\n",
             validation.status == kExitInternal ? "internal error: " : "",
             validation.reason);
  return validation.status;
}

bool to_standard_output(const Options& options) {
  return options.output.empty() || options.output == "-";
}

int write_lowered(const Options& options, const std::string& bytes) {
  if (to_standard_output(options)) return print_out(bytes) ? 0 : kExitUsage;
  const auto error = write_file(options.output, bytes);
  return error ? output_error(options.output, *error) : 0;
}

}  // namespace

int run_lower(const Options& options) {
  if (const auto error = check_target(options)) return usage_error(*error);
  const bool to_terminal = options.binary && to_standard_output(options) &&
                           ::isatty(STDOUT_FILENO) != 0;
  if (to_terminal) return usage_error("--binary: a terminal cannot show it");
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  if (session.inputs().size() != 1) {
    return usage_error("lower takes one program, and a directory is none");
  }
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const Program& program = *loaded.program;
  DiagnosticList found;
  const std::optional<std::string> bytes =
      options.binary ? lower_to_postfix_binary(program, found)
                     : lower_to_postfix_text(program, found);
  loaded.report.findings = found.take();
  if (!bytes) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  print_input_errors(session.sources(), loaded.report, options);  // notes
  const Validation validation = validate_translation(program, *bytes, options);
  if (validation.status != 0) return refuse(validation);
  return write_lowered(options, *bytes);
}

}  // namespace rung
