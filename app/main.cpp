#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string_view>

#include "app/commands.h"
#include "app/options.h"
#include "base/heap.h"

namespace rung {
namespace {

struct Command {
  std::string_view name;
  int (*run)(const Options&);
};

constexpr Command kCommands[] = {
    {"check", run_check},   {"lint", run_lint},
    {"prove", run_check},   {"equiv", run_equiv},
    {"lower", run_lower},   {"run", run_simulation},
    {"render", run_render}, {"rule", run_rule},
    {"export", run_export}, {"bound", run_bound},
    {"upload", run_upload}, {"monitor", run_monitor},
    {"config", run_config}, {"baseline", run_baseline},
    {"lsp", run_lsp},       {"lock", run_lock},
};

int run(int argc, char** argv) {
  const auto parsed = parse_options(argc, argv);
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  const auto& options = std::get<Options>(parsed);
  prepare_heap();
  for (const Command& command : kCommands) {
    if (command.name == options.command) return command.run(options);
  }
  return kExitUsage;
}

}  // namespace
}  // namespace rung

int main(int argc, char** argv) {
  try {
    return rung::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rungproof: internal error: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "rungproof: internal error\n");
  }
  return rung::kExitInternal;
}
