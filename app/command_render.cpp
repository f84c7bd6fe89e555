#include "app/commands.h"
#include "app/output.h"
#include "app/session.h"
#include "reports/ladder/svg.h"
#include "reports/ladder/text.h"

namespace rung {
namespace {

/// The picture's formats are not those of reports.
std::optional<std::string> check_picture_formats(const Options& options) {
  int on_stdout = 0;
  for (const FormatRequest& request : options.formats) {
    if (request.format != "text" && request.format != "svg") {
      return "render draws the formats text and svg, not " + request.format;
    }
    if (request.path.empty()) ++on_stdout;
  }
  if (on_stdout > 1) return "only one picture can go to standard output";
  return std::nullopt;
}

}  // namespace

int run_render(const Options& options) {
  if (const auto error = check_picture_formats(options)) {
    return usage_error(*error);
  }
  Options reading = options;
  std::vector<FormatRequest> formats;
  formats.swap(reading.formats);
  if (formats.empty()) formats = {{"text", ""}};
  Session session(reading);
  if (session.error()) return usage_error(*session.error());
  if (session.inputs().size() != 1) {
    return usage_error("render takes one program, and a directory is none");
  }
  const Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  for (const FormatRequest& request : formats) {
    const std::string picture =
        request.format == "svg"
            ? draw_ladder_svg(session.sources(), *loaded.program)
            : draw_ladder(session.sources(), *loaded.program, options.ascii);
    if (request.path.empty()) {
      if (!print_out(picture)) return kExitUsage;
    } else if (const auto error = write_file(request.path, picture)) {
      return output_error(request.path, *error);
    }
  }
  return 0;
}

}  // namespace rung
