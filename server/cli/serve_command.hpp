#pragma once

#include <CLI/CLI.hpp>

namespace pulseline::server::cli {

/// `pulseline serve`. Each add_* sets `exit_code` when its command runs.
void add_serve_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
