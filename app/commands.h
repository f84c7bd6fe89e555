#pragma once

#include "app/options.h"

namespace rung {

/// One function a subcommand; each returns the exit code.
int run_check(const Options& options);  // check, lint and prove
int run_lint(const Options& options);
int run_bound(const Options& options);
int run_equiv(const Options& options);
int run_lock(const Options& options);
int run_lower(const Options& options);
int run_export(const Options& options);
int run_simulation(const Options& options);
int run_render(const Options& options);
int run_baseline(const Options& options);
int run_config(const Options& options);
int run_rule(const Options& options);
int run_upload(const Options& options);
int run_lsp(const Options& options);
int run_monitor(const Options& options);

}  // namespace rung
