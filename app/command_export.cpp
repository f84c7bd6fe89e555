#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "app/commands.h"
#include "app/output.h"
#include "app/select.h"
#include "app/session.h"
#include "base/text.h"
#include "smt/exports/problem.h"

namespace rung {
namespace {

struct Format {
  std::string_view name;
  std::string (*write)(const ModelProblem& problem);
  bool binary = false;
};
constexpr std::array kFormats = {
    Format{"aiger", to_aiger, true},
    Format{"btor2", to_btor2},
    Format{"chc", to_horn},
};

const Format* find_format(const std::string& name) {
  const auto* const found =
      std::find_if(kFormats.begin(), kFormats.end(),
                   [&](const Format& it) { return it.name == name; });
  return found == kFormats.end() ? nullptr : found;
}

std::string unknown_format(const Options& options) {
  std::vector<std::string_view> names;
  names.reserve(kFormats.size());
  for (const Format& format : kFormats) names.push_back(format.name);
  return fmt::format("--to: there is no format `{}`{}", options.to,
                     did_you_mean(options.to, names));
}

}  // namespace

int run_export(const Options& options) {
  const Format* const format = find_format(options.to);
  if (format == nullptr) return usage_error(unknown_format(options));
  const bool to_output = options.output.empty() || options.output == "-";
  if (format->binary && to_output && ::isatty(STDOUT_FILENO) != 0) {
    return usage_error("--to aiger is binary: a terminal cannot show it");
  }
  Session session(options);
  if (session.error()) return usage_error(*session.error());
  if (session.inputs().size() != 1) {
    return usage_error("export takes one program, and a directory is none");
  }
  Loaded loaded = session.load(session.inputs().front());
  if (!loaded.program) {
    return print_input_errors(session.sources(), loaded.report, options);
  }
  const ModelProblem problem = make_problem(
      *loaded.program, select(loaded.report.properties, options.properties),
      wanted_by(options.properties));
  if (!problem.error.empty()) return usage_error(problem.error);
  const std::string text = format->write(problem);
  if (to_output) return print_out(text) ? 0 : kExitUsage;
  const auto error = write_file(options.output, text);
  return error ? output_error(options.output, *error) : 0;
}

}  // namespace rung
