#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>

namespace pulseline::server::cli {

struct PlanInput {
    std::string map;       // MovingAI .map
    std::string scenario;  // MovingAI .scen
    int limit = 0;         // the last so many problems; 0: all
    double k_same = 10;
    double k_diff = 20;
    std::string algorithm = "turn-jump";
    bool json = false;
};

constexpr int kPlanned = 0;
constexpr int kPlanUnreadable = 2;  // files, costs or algorithm

/// Solves a scenario 4-connected with the direction penalty, start heading free, one line per
/// problem: its place in the file (0-based), cost (in the units of k), length, turns, expansions
/// and times; without a route the cost is null.
int plan_scenario(const PlanInput& input, std::ostream& out);

/// `pulseline plan`.
void add_plan_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
