#include "app/trace_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "analysis/explanation.h"
#include "app/output.h"
#include "base/file_stem.h"
#include "reports/vcd.h"
#include "reports/waves.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

/// Two names that are the same as files get numbers.
std::string free_stem(const std::string& name, std::set<std::string>& used) {
  const std::string stem = file_stem(name);
  std::string free = stem;
  for (int i = 2; !used.insert(free).second; ++i) {
    free = fmt::format("{}-{}", stem, i);
  }
  return free;
}

std::vector<CellId> all_cells(const Program& program) {
  std::vector<CellId> cells;
  for (const CellId id : ids_of(program.cells)) cells.push_back(id);
  return cells;
}

std::optional<std::string> write_run(const Program& program,
                                     const ObligationResult& result,
                                     const std::string& path) {
  const auto put = [&](const std::string& ending,
                       const std::string& text) -> std::optional<std::string> {
    const auto error = write_file(path + ending, text);
    if (!error) return std::nullopt;
    return fmt::format("{}{}: {}", path, ending, *error);
  };
  const Trace& trace = *result.trace;
  if (auto error = put(
          ".vcd",
          write_vcd(program, record(program, stimulus_of(program, trace))))) {
    return error;
  }
  if (auto error =
          put(".json", write_wavejson(program, trace, all_cells(program),
                                      result.obligation.name))) {
    return error;
  }
  const auto stimulus = write_stimulus(program, trace);
  if (!stimulus) {
    return fmt::format("{}.csv: an input's name cannot be the name of a column",
                       path);
  }
  return put(".csv", *stimulus);
}

}  // namespace

std::optional<std::string> write_traces(const Report& report,
                                        const std::string& directory) {
  if (directory.empty()) return std::nullopt;
  for (std::size_t i = 0; i < report.files.size(); ++i) {
    const FileReport& file = report.files[i];
    fs::path place = directory;
    if (report.files.size() > 1) {
      place /= fmt::format("{}-{}", i + 1, fs::path(file.path).stem().string());
    }
    std::error_code error;
    fs::create_directories(place, error);
    if (error) {
      return fmt::format("cannot make the directory {}: {}", place.string(),
                         error.message());
    }
    std::set<std::string> used;
    for (const ObligationResult& result : file.results) {
      const bool has_run =
          file.program && result.trace && !result.trace->steps.empty();
      if (!has_run) continue;
      const std::string name = free_stem(result.obligation.name, used);
      if (auto failed =
              write_run(*file.program, result, (place / name).string())) {
        return failed;
      }
    }
  }
  return std::nullopt;
}

}  // namespace rung
