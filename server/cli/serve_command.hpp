#pragma once

#include <CLI/CLI.hpp>

namespace pulseline::server::cli {

/// Exit codes: 0 done, 1 failed, 2 wrong usage or configuration.
constexpr int kFailed = 1;
constexpr int kUsage = 2;

/// `pulseline serve`. Each add_* sets `exit_code` when its command runs.
void add_serve_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
