#pragma once

#include <CLI/CLI.hpp>

namespace pulseline::server::cli {

/// `pulseline user add|list` and `pulseline token create|list|revoke`.
void add_access_commands(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
