#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::server::cli {

struct SheetInput {
    std::string database;
    std::vector<int> stations;  // numbers; empty: every marker of the plant
    std::string format = "pdf";
    std::string folder;
};

/// Writes one true-scale sheet per marker and list.csv into the folder; prints what it wrote.
int write_marker_sheets(const plant::Plant& plant, const SheetInput& input, std::ostream& out);

/// `pulseline markers sheet`.
void add_markers_commands(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
