#include "server/agent/map_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <string>

#include "api/plant/plant_file.hpp"
#include "server/agent/map_hall.hpp"

namespace pulseline::agent {
namespace {

struct MapOptions {
    std::string world_file;
    std::string vehicle;
    std::string out;
    std::string errors = "nominal";
    std::uint64_t seed = 1;
    double within_m = mapping::MapBuilder::kWithin_m;
};

Status make_map(const MapOptions& options) {
    auto plant = api::plant_file::load_plant_file(options.world_file);
    if (!plant) return fail(plant.error());
    const auto world = simulation::make_world(std::move(*plant), options.seed,
                                              localisation::ErrorBudget::named(options.errors));
    const auto* vehicle = plant::find_vehicle(world.plant, plant::VehicleId(options.vehicle));
    const auto* home =
        vehicle == nullptr ? nullptr : plant::find_station(world.plant, vehicle->home);
    if (home == nullptr) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "the plant " + options.world_file + " has no vehicle " + options.vehicle +
                        " with a home station");
    }
    const bool is_from_afar = options.within_m > mapping::MapBuilder::kWithin_m;
    const auto way = way_over_lanes(
        world.plant, home->hall, home->pose,
        is_from_afar ? plant::find_vehicle_type(world.plant, vehicle->type) : nullptr);
    if (!way) return fail(way.error());
    int told_percent = -1;
    const auto map = map_hall(
        world, *vehicle, home->hall, *way, options.seed,
        [&](double share) {
            const int percent = static_cast<int>(100 * share);
            if (percent / 10 == told_percent / 10) return;
            told_percent = percent;
            fmt::print(stderr, "{} % of the lanes of {} driven\n", percent, home->hall.str());
        },
        options.within_m);
    if (!map) return fail(map.error());
    const auto written = mapping::write_map(*map, options.out);
    if (!written) return written;
    fmt::print("{}: {} x {} cells of {} m\n", options.out, map->columns, map->rows, map->cell_m);
    return {};
}

}  // namespace

int map_command(int argc, char** argv) {
    CLI::App app{"A simulated vehicle drives along the lanes of its hall and maps it."};
    app.name("pulseline-agent map");
    MapOptions options;
    app.add_option("--world", options.world_file, "plant file of the simulated world")->required();
    app.add_option("--vehicle", options.vehicle, "id of the vehicle that drives: TP-01")
        ->required();
    app.add_option("--out", options.out, "FILE.yaml; the picture FILE.png is beside it")
        ->required();
    app.add_option("--seed", options.seed, "of all simulated errors");
    app.add_option("--within", options.within_m,
                   "metres: what is farther off is not drawn; more where lanes keep far from walls")
        ->check(CLI::Range(1.0, 100.0));
    app.add_option("--errors", options.errors,
                   "how well the simulated machines and floor are kept: nominal, kind, harsh")
        ->check(CLI::IsMember({"nominal", "kind", "harsh"}));
    CLI11_PARSE(app, argc, argv);
    const auto made = make_map(options);
    if (made) return 0;
    fmt::print(stderr, "pulseline-agent map: {}\n", made.error().what);
    return 1;
}

}  // namespace pulseline::agent
