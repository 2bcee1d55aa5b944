#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>

namespace pulseline::server::cli {

constexpr int kPlantSound = 0;
constexpr int kPlantFaults = 1;
constexpr int kPlantUnreadable = 2;  // file or database

/// Prints every fault on its own line (element, what, remedy; JSON objects with `json`). A plant
/// without faults gets warnings about its layout, which refuse nothing.
int plant_validate(const std::string& plant_file, bool json, std::ostream& out);
/// Puts the plant file in the place of the database's plant, when it has no fault.
int plant_import(const std::string& database, const std::string& plant_file, bool json,
                 std::ostream& out);
/// Writes the database's plant as a plant file with its grids; works beside a running server.
int plant_export(const std::string& database, const std::string& plant_file, std::ostream& out);

/// `pulseline plant validate|import|export`.
void add_plant_commands(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
