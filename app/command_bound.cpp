#include <chrono>

#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "app/version.h"
#include "reports/bound.h"
#include "smt/bound.h"

namespace rung {
namespace {

/// The question as a text of its own: messages point into it.
std::optional<ResponseQuestion> read_question(Session& session,
                                              Program& program,
                                              FileReport& report) {
  const std::string& text = session.options().question;
  const FileId file = session.sources().add("the question", text);
  const auto length = static_cast<std::uint32_t>(text.size());
  DiagnosticList found;
  auto question = read_response(
      program, Slice{session.sources()[file].text(), {file, 0, length}}, found);
  report.findings = found.take();
  return question;
}

}  // namespace

int run_bound(const Options& options) {
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  for (const FormatRequest& request : options.formats) {
    if (request.format != "text" && request.format != "json") {
      return usage_error("bound writes the formats text and json, not " +
                         request.format);
    }
  }
  if (session.inputs().size() != 1) {
    return usage_error("bound takes one program, and a directory is none");
  }
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const auto question = read_question(session, *loaded.program, loaded.report);
  if (!question) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  BoundReport report;
  report.sources = &session.sources();
  report.version = kVersion;
  report.solvers = solver_versions();
  report.self_check = options.self_check;
  report.question = *question;
  const auto start = std::chrono::steady_clock::now();
  report.bounds = find_bounds(*loaded.program, loaded.report.properties,
                              *question, session.verify_options(0));
  report.milliseconds = std::chrono::duration<double, std::milli>(
                            std::chrono::steady_clock::now() - start)
                            .count();
  report.file = std::move(loaded.report);
  return emit(report, options);
}

}  // namespace rung
