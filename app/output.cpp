#include "app/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "reports/github.h"
#include "reports/gitlab.h"
#include "reports/html/page.h"
#include "reports/json.h"
#include "reports/junit.h"
#include "reports/sarif.h"
#include "reports/text.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> kFormats = {
    "text", "json", "jsonl", "sarif", "junit", "github", "gitlab", "html"};

TextOptions text_options(const Options& options, bool colour) {
  return {options.detail, colour};
}

std::string render(const Report& report, std::string_view format,
                   const Options& options, bool colour) {
  if (format == "json") return write_json(report);
  if (format == "jsonl") return write_jsonl(report);
  if (format == "sarif") return write_sarif(report);
  if (format == "junit") return write_junit(report);
  if (format == "github") return write_github(report);
  if (format == "gitlab") return write_gitlab(report);
  if (format == "html") return write_html(report);
  return write_text(report, text_options(options, colour));
}

std::string render(const EquivalenceReport& report, std::string_view format,
                   const Options& options, bool colour) {
  if (format == "json") return write_json(report);
  if (format == "jsonl") return write_jsonl(report);
  if (format == "text") {
    return write_text(report, text_options(options, colour));
  }
  if (format == "html") return write_html(report);
  return render(as_report(report), format, options, colour);
}

std::string render(const RunReport& report, std::string_view format,
                   const Options& options, bool colour) {
  if (format == "json") return write_json(report);
  return write_text(report, text_options(options, colour));
}

std::string render(const BoundReport& report, std::string_view format,
                   const Options& options, bool colour) {
  if (format == "json") return write_json(report);
  return write_text(report, text_options(options, colour));
}

int exit_status(const RunReport&) { return 0; }

template <class AnyReport>
int emit_all(const AnyReport& report, const Options& options) {
  bool stdout_taken = false;
  int status = exit_status(report);
  const auto failed = [&status] { status = std::max(status, kExitUsage); };
  for (const FormatRequest& request : options.formats) {
    if (request.path.empty()) {
      stdout_taken = true;
      const bool ok = print_out(
          render(report, request.format, options, use_colour(options)));
      if (!ok) failed();
      continue;
    }
    const bool colour = options.colour == ColourMode::Always;
    const auto error = write_file(
        request.path, render(report, request.format, options, colour));
    if (error) {
      output_error(request.path, *error);
      failed();
    }
  }
  if (!stdout_taken &&
      !print_out(render(report, "text", options, use_colour(options)))) {
    failed();
  }
  return status;
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::optional<std::string> write_in_place(const std::string& path,
                                          std::string_view bytes) {
  std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "wb"));
  if (!file) return std::strerror(errno);
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
      std::fflush(file.get()) == 0;
  if (!written) return std::strerror(errno);
  return std::nullopt;
}

}  // namespace

bool print_out(std::string_view text) {
  const bool ok =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
      std::fflush(stdout) == 0;
  if (!ok) output_error("standard output", std::strerror(errno));
  return ok;
}

std::optional<std::string> write_file(const std::string& path,
                                      std::string_view bytes) {
  std::error_code ignored;
  const bool in_place =
      fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
  if (in_place) return write_in_place(path, bytes);
  const std::string temporary = fmt::format("{}.{}.tmp", path, ::getpid());
  if (auto error = write_in_place(temporary, bytes)) {
    fs::remove(temporary, ignored);
    return error;
  }
  std::error_code error;
  fs::rename(temporary, path, error);
  if (!error) return std::nullopt;
  fs::remove(temporary, ignored);
  return error.message();
}

int output_error(const std::string& path, const std::string& why) {
  return usage_error(fmt::format("cannot write {}: {}", path, why));
}

std::optional<std::string> check_formats(const Options& options) {
  int on_stdout = 0;
  for (const FormatRequest& request : options.formats) {
    if (std::find(kFormats.begin(), kFormats.end(), request.format) ==
        kFormats.end()) {
      return fmt::format("--format: there is no format `{}`: the names are {}",
                         request.format, fmt::join(kFormats, ", "));
    }
    if (request.path.empty()) ++on_stdout;
  }
  if (on_stdout > 1) {
    return "--format: only one format can go to standard output; write the "
           "others to files, FORMAT:FILE";
  }
  return std::nullopt;
}

bool use_colour(const Options& options) {
  if (options.colour != ColourMode::Auto) {
    return options.colour == ColourMode::Always;
  }
  const char* no_colour = std::getenv("NO_COLOR");
  const bool forbidden = no_colour != nullptr && *no_colour != '\0';
  return !forbidden && ::isatty(STDOUT_FILENO) != 0;
}

int print_input_errors(const SourceSet& sources, const FileReport& report,
                       const Options& options) {
  std::string out;
  for (const Diagnostic& finding : report.findings) {
    out += write_diagnostic(sources, finding, use_colour(options)) + "\n";
  }
  std::fwrite(out.data(), 1, out.size(), stderr);
  return kExitUsage;
}

int emit(const Report& report, const Options& options) {
  return emit_all(report, options);
}

int emit(const EquivalenceReport& report, const Options& options) {
  return emit_all(report, options);
}

int emit(const RunReport& report, const Options& options) {
  return emit_all(report, options);
}

int emit(const BoundReport& report, const Options& options) {
  return emit_all(report, options);
}

}  // namespace rung
