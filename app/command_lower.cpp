#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "backend/postfix/lower.h"
#include "base/text.h"
#include "frontend/postfix/reader.h"
#include "smt/equivalence.h"

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

/// What was written, as a program again.
std::optional<Program> read_back(SourceSet& sources, const std::string& bytes,
                                 DiagnosticSink& sink) {
  DiagnosticList errors;
  const FileId file = add_postfix(sources, "(lowered)", bytes, errors);
  Program program;
  if (!errors.has_errors()) {
    program = build_program(read_postfix(sources, file, errors), {}, errors);
  }
  const bool ok = !errors.has_errors();
  for (Diagnostic& error : errors.take()) sink.report(std::move(error));
  if (!ok) return std::nullopt;
  return program;
}

/// Says why the lowered program is not left on disk: a fault of ours.
int refuse(const std::string& why) {
  fmt::print(stderr,
             "rungproof: internal error: the lowered program is not proved "
             "equivalent to its source, so it is not written: {}\n",
             why);
  return kExitInternal;
}

/// Nothing when `lowered` is proved to be the same program.
std::optional<std::string> difference(const Program& program,
                                      const Program& lowered,
                                      const Options& options) {
  EquivalenceOptions equivalence;
  equivalence.budget.seconds = options.timeout;
  equivalence.self_check = options.self_check;
  const EquivalenceResult result =
      check_equivalence(program, lowered, equivalence);
  if (!result.failures.empty()) return result.failures.front().what;
  if (!result.error.empty()) return result.error;
  switch (result.verdict) {
    case EquivalenceVerdict::Equivalent:
      return std::nullopt;
    case EquivalenceVerdict::Different:
      return "they differ";
    case EquivalenceVerdict::Bounded:
    case EquivalenceVerdict::Unknown:
      break;
  }
  return result.reason.empty() ? "no proof was found" : result.reason;
}

int write_lowered(const Options& options, const std::string& bytes) {
  if (options.output.empty()) return print_out(bytes) ? 0 : kExitUsage;
  const auto error = write_file(options.output, bytes);
  return error ? output_error(options.output, *error) : 0;
}

}  // namespace

int run_lower(const Options& options) {
  if (const auto error = check_target(options)) return usage_error(*error);
  const bool to_terminal =
      options.binary && options.output.empty() && ::isatty(STDOUT_FILENO) != 0;
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
  DiagnosticList unread;
  const auto lowered = read_back(session.sources(), *bytes, unread);
  if (!lowered) return refuse(unread.items().front().message);
  if (const auto why = difference(program, *lowered, options)) {
    return refuse(*why);
  }
  return write_lowered(options, *bytes);
}

}  // namespace rung
