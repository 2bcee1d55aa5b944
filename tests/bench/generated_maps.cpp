#include "tests/bench/generated_maps.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <random>

#include "api/plant/occupancy_file.hpp"

namespace pulseline::bench {
namespace {

namespace fs = std::filesystem;
using planning::Cell;

constexpr std::size_t kProblems = 200;

plant::OccupancyGrid empty_grid(int width, int height) {
    plant::OccupancyGrid grid;
    grid.width = width;
    grid.height = height;
    grid.resolution_m = 1;
    grid.occupied.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    return grid;
}

void fill(plant::OccupancyGrid& grid, Cell first, Cell last, bool occupied) {
    for (int row = std::max(first.row, 0); row <= std::min(last.row, grid.height - 1); ++row) {
        for (int col = std::max(first.col, 0); col <= std::min(last.col, grid.width - 1); ++col) {
            grid.occupied[static_cast<std::size_t>(row) * grid.width + col] = occupied ? 1 : 0;
        }
    }
}

/// Racks of 10 x 2 cells between aisles of one cell.
plant::OccupancyGrid warehouse() {
    auto grid = empty_grid(161, 64);
    for (int row = 3; row + 2 < grid.height - 2; row += 3) {
        for (int col = 6; col + 10 < grid.width - 5; col += 11) {
            fill(grid, {col, row}, {col + 9, row + 1}, true);
        }
    }
    return grid;
}

/// Rooms of 15 x 15 cells, one door in every wall between two.
plant::OccupancyGrid rooms(std::mt19937& random) {
    auto grid = empty_grid(256, 256);
    constexpr int kPitch = 16;
    for (int i = kPitch - 1; i < 256; i += kPitch) {
        fill(grid, {0, i}, {255, i}, true);
        fill(grid, {i, 0}, {i, 255}, true);
    }
    for (int room = 0; room < 16; ++room) {
        for (int wall = kPitch - 1; wall < 255; wall += kPitch) {
            const int along = room * kPitch + static_cast<int>(random() % (kPitch - 1));
            fill(grid, {along, wall}, {along, wall}, false);
            fill(grid, {wall, along}, {wall, along}, false);
        }
    }
    return grid;
}

plant::OccupancyGrid scattered(std::mt19937& random, int size, unsigned percent) {
    auto grid = empty_grid(size, size);
    for (auto& cell : grid.occupied) cell = random() % 100 < percent;
    return grid;
}

/// Walls at 45 degrees across the whole floor, each with gaps: no two cells of one in a line.
plant::OccupancyGrid diagonal_walls(int size) {
    auto grid = empty_grid(size, size);
    for (int i = 0; i < size; ++i) {
        for (int wall = 0; wall < 4; ++wall) {
            const int row = (i + wall * size / 4) % size;
            if (i / 60 % 2 == 1 && i % 60 <= 6) continue;
            fill(grid, {i, row}, {i, row + 1}, true);
        }
    }
    return grid;
}

/// Corridors of one cell, all joined, with some loops (depth-first).
plant::OccupancyGrid maze(std::mt19937& random, int side) {
    auto grid = empty_grid(2 * side + 1, 2 * side + 1);
    fill(grid, {0, 0}, {2 * side, 2 * side}, true);
    const auto open = [&](int col, int row) { fill(grid, {col, row}, {col, row}, false); };
    std::vector<Cell> way{{0, 0}};
    open(1, 1);
    while (!way.empty()) {
        const Cell at = way.back();
        std::vector<Cell> steps;
        for (const Cell step : planning::kStep) {
            const Cell next{at.col + step.col, at.row + step.row};
            const bool inside =
                next.col >= 0 && next.row >= 0 && next.col < side && next.row < side;
            if (inside && grid.is_occupied(2 * next.col + 1, 2 * next.row + 1)) {
                steps.push_back(step);
            }
        }
        if (steps.empty()) {
            way.pop_back();
            continue;
        }
        const Cell step = steps[random() % steps.size()];
        open(2 * at.col + 1 + step.col, 2 * at.row + 1 + step.row);
        way.push_back({at.col + step.col, at.row + step.row});
        open(2 * way.back().col + 1, 2 * way.back().row + 1);
    }
    for (int i = 0; i < side * side / 20; ++i) {
        const int col = 1 + static_cast<int>(random() % static_cast<unsigned>(side - 1));
        const int row = 1 + static_cast<int>(random() % static_cast<unsigned>(side - 1));
        open(2 * col, 2 * row + 1);
    }
    return grid;
}

void keep_longest(std::vector<api::plant_file::MovingAiProblem>& problems) {
    std::stable_sort(problems.begin(), problems.end(),
                     [](const auto& a, const auto& b) { return a.length > b.length; });
    if (problems.size() > kProblems) problems.resize(kProblems);
}

/// Random pairs of free cells; some of a random map may not be joined.
BenchMap with_problems(std::string name, plant::OccupancyGrid grid, std::mt19937& random) {
    BenchMap map{std::move(name), std::move(grid), {}};
    const auto cell = [&] {
        while (true) {
            const Cell at{static_cast<int>(random() % static_cast<unsigned>(map.grid.width)),
                          static_cast<int>(random() % static_cast<unsigned>(map.grid.height))};
            if (!map.grid.is_occupied(at.col, at.row)) return at;
        }
    };
    for (int i = 0; i < 2'000; ++i) {
        const Cell start = cell();
        const Cell goal = cell();
        map.problems.push_back({start, goal, double(planning::manhattan(start, goal))});
    }
    keep_longest(map.problems);
    return map;
}

}  // namespace

std::vector<BenchMap> maps_in(const std::string& folder) {
    std::vector<fs::path> maps;
    std::vector<fs::path> scenarios;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".map") maps.push_back(entry.path());
        if (entry.path().extension() == ".scen") scenarios.push_back(entry.path());
    }
    std::sort(maps.begin(), maps.end());
    std::sort(scenarios.begin(), scenarios.end());
    std::vector<BenchMap> result;
    for (const fs::path& path : maps) {
        const auto grid = api::plant_file::read_file(path).and_then(
            [](const auto& t) { return api::plant_file::parse_moving_ai_map(t); });
        if (!grid) {
            std::cerr << path.string() << ": " << grid.error().what << '\n';
            continue;
        }
        BenchMap map{path.stem().string(), *grid, {}};
        for (const fs::path& scenario : scenarios) {
            if (!scenario.filename().string().starts_with(map.name)) continue;
            const auto problems = api::plant_file::read_file(scenario).and_then(
                [](const auto& t) { return api::plant_file::parse_moving_ai_scenario(t); });
            if (!problems) {
                std::cerr << scenario.string() << ": " << problems.error().what << '\n';
                continue;
            }
            map.problems.insert(map.problems.end(), problems->begin(), problems->end());
        }
        keep_longest(map.problems);
        result.push_back(std::move(map));
    }
    return result;
}

std::vector<BenchMap> generated_maps() {
    std::mt19937 random(11);
    std::vector<BenchMap> maps;
    maps.push_back(with_problems("generated-warehouse", warehouse(), random));
    maps.push_back(with_problems("generated-rooms", rooms(random), random));
    for (const unsigned percent : {2u, 10u, 25u, 40u}) {
        maps.push_back(with_problems("generated-random-" + std::to_string(percent),
                                     scattered(random, 256, percent), random));
    }
    maps.push_back(with_problems("generated-open", empty_grid(256, 256), random));
    maps.push_back(with_problems("generated-diagonals", diagonal_walls(256), random));
    maps.push_back(with_problems("generated-maze", maze(random, 127), random));
    return maps;
}

}  // namespace pulseline::bench
