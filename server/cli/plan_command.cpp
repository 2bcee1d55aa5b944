#include "server/cli/plan_command.hpp"

#include <fmt/core.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/plant/moving_ai_file.hpp"
#include "api/plant/occupancy_file.hpp"
#include "core/planning/grid/grid_search.hpp"

namespace pulseline::server::cli {
namespace {

using nlohmann::json;
using planning::Algorithm;
using Timer = std::chrono::steady_clock;

double us_since(Timer::time_point begin) {
    return std::chrono::duration<double, std::micro>(Timer::now() - begin).count();
}

int unreadable(const PlanInput& input, const std::string& what, std::ostream& out) {
    if (input.json) {
        out << json{{"error", what}}.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
    } else {
        out << "pulseline: " << what << "\n";
    }
    return kPlanUnreadable;
}

/// Text of a file, parsed; errors name the file.
template <class Parse>
auto read(const std::string& file, Parse parse) {
    const auto name_file = [&](Error error) {
        error.what = file + ": " + error.what;
        return error;
    };
    return api::plant_file::read_file(file).and_then(
        [&](const auto& text) { return parse(text).map_error(name_file); });
}

Result<Algorithm> algorithm_named(const std::string& name) {
    for (const auto algorithm :
         {Algorithm::kTurnJump, Algorithm::kBucket, Algorithm::kAstar, Algorithm::kDijkstra}) {
        if (planning::to_string(algorithm) == name) return algorithm;
    }
    return fail(Errc::kInvalid, "unknown_algorithm",
                "There is no algorithm " + name + ". Choose turn-jump, bucket, astar or dijkstra.");
}

struct Answer {
    std::size_t problem = 0;
    bool found = false;
    planning::GridRoute route;
    double time_us = 0;
};

void print(const PlanInput& input, const Answer& answer, double build_us, std::ostream& out) {
    const auto& route = answer.route;
    if (input.json) {
        out << json{{"problem", answer.problem},
                    {"cost", answer.found ? json(route.cost_in_k()) : json(nullptr)},
                    {"length", route.length},
                    {"turns", route.turns},
                    {"expanded", route.expanded},
                    {"time_us", answer.time_us},
                    {"build_us", build_us}}
                   .dump()
            << "\n";
    } else {
        const std::string cost = answer.found ? fmt::format("{:g}", route.cost_in_k()) : "no route";
        out << fmt::format("{:6} {:>12} {:7} {:5} {:9} {:10.1f} us\n", answer.problem, cost,
                           route.length, route.turns, route.expanded, answer.time_us);
    }
}

}  // namespace

int plan_scenario(const PlanInput& input, std::ostream& out) {
    const auto algorithm = algorithm_named(input.algorithm);
    if (!algorithm) return unreadable(input, algorithm.error().what, out);
    const auto cost = planning::unit_cell_cost(input.k_same, input.k_diff);
    if (!cost) return unreadable(input, cost.error().what, out);
    const auto grid = read(input.map, api::plant_file::parse_moving_ai_map);
    if (!grid) return unreadable(input, grid.error().what, out);
    const auto problems = read(input.scenario, api::plant_file::parse_moving_ai_scenario);
    if (!problems) return unreadable(input, problems.error().what, out);

    const auto begin = Timer::now();
    const planning::GridMap map(planning::point_layers(*grid));
    const double build_us = us_since(begin);
    planning::GridSearch search;
    search.prepare(map, *algorithm);
    if (!input.json) {
        out << fmt::format("{} x {} cells, tables built in {:.1f} ms\n", map.width(), map.height(),
                           build_us / 1000)
            << "problem         cost  length turns  expanded          time\n";
    }
    const auto last = static_cast<std::size_t>(std::max(input.limit, 0));
    const std::size_t first =
        last > 0 && last < problems->size() ? problems->size() - last : std::size_t{0};
    Answer answer;
    for (std::size_t i = first; i < problems->size(); ++i) {
        planning::GridRequest request{(*problems)[i].start, (*problems)[i].goal};
        request.cost = *cost;
        if (const auto ok = planning::check(map, request); !ok) {
            return unreadable(
                input, fmt::format("{}: problem {}: {}", input.scenario, i, ok.error().what), out);
        }
        answer.problem = i;
        const auto start = Timer::now();
        answer.found =
            search.run(map, request, *algorithm, answer.route) == planning::SearchEnd::kFound;
        answer.time_us = us_since(start);
        print(input, answer, build_us, out);
    }
    return kPlanned;
}

void add_plan_command(CLI::App& app, int& exit_code) {
    const auto input = std::make_shared<PlanInput>();
    auto* plan = app.add_subcommand("plan", "Solve a MovingAI scenario with the direction penalty");
    plan->add_option("--map", input->map, "Grid, FILE.map")->required();
    plan->add_option("--scen", input->scenario, "Problems, FILE.scen")->required();
    plan->add_option("--limit", input->limit, "Only the last N problems")
        ->check(CLI::PositiveNumber);
    plan->add_option("--k-same", input->k_same, "Cost of a cell straight on")
        ->capture_default_str();
    plan->add_option("--k-diff", input->k_diff, "Cost of a cell after a change of direction")
        ->capture_default_str();
    plan->add_option("--algorithm", input->algorithm, "turn-jump, bucket, astar or dijkstra")
        ->capture_default_str();
    plan->add_flag("--json", input->json, "One JSON object a line");
    plan->callback([input, &exit_code] { exit_code = plan_scenario(*input, std::cout); });
}

}  // namespace pulseline::server::cli
