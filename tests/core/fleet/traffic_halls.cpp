#include "tests/core/fleet/traffic_halls.hpp"

#include <gtest/gtest.h>

namespace pulseline::fleet::testing {

using plant::VehicleId;

plant::Plant plant_of(const std::vector<Spot>& spots,
                      const std::vector<std::pair<const char*, const char*>>& lanes, int vehicles) {
    plant::Plant plant = small_plant();
    plant.halls[0].outline = {{0, 0}, {100, 0}, {100, 80}, {0, 80}};
    plant.stations.clear();
    plant.markers.clear();
    plant.nodes.clear();
    plant.edges.clear();
    plant.vehicles.clear();
    for (const Spot& spot : spots) {
        plant.nodes.push_back({plant::NodeId(spot.name), plant.halls[0].id, {spot.x_m, spot.y_m}});
        if (spot.station == 0) continue;
        plant::Station station;
        station.id = plant::StationId("s" + std::to_string(spot.station));
        station.number = spot.station;
        station.name = spot.name;
        station.hall = plant.halls[0].id;
        station.pose = {spot.x_m, spot.y_m, 0};
        station.node = plant::NodeId(spot.name);
        station.resting_place = true;
        plant.stations.push_back(station);
    }
    for (const auto& [a, b] : lanes) {
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
            plant::RoadmapEdge edge;
            edge.from = plant::NodeId(from);
            edge.to = plant::NodeId(to);
            edge.id = plant::EdgeId(std::string(from) + "." + to);
            plant.edges.push_back(edge);
        }
    }
    for (int i = 0; i < vehicles; ++i) {
        plant::Vehicle vehicle;
        vehicle.id = VehicleId("V" + std::to_string(i + 1));
        vehicle.type = plant.vehicle_types[0].id;
        vehicle.manufacturer = "test";
        vehicle.serial_number = vehicle.id.str();
        vehicle.home = plant.stations[static_cast<std::size_t>(i)].id;
        plant.vehicles.push_back(vehicle);
    }
    return plant;
}

plant::Plant corridor() {
    return plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40}, {"bay", 40, 52, 3}},
        {{"west", "middle"}, {"middle", "east"}, {"middle", "bay"}}, 2);
}

plant::Plant two_ways() {
    return plant_of({{"west", 10, 40, 1},
                     {"east", 70, 40, 2},
                     {"low", 40, 40, 3},
                     {"a", 10, 60},
                     {"b", 70, 60},
                     {"far", 90, 40, 4}},
                    {{"west", "low"},
                     {"low", "east"},
                     {"west", "a"},
                     {"a", "b"},
                     {"b", "east"},
                     {"east", "far"}},
                    2);
}

void confirm_poses(World& world) {
    world.connect_all();
    for (auto& [id, vehicle] : world.vehicles) {
        vehicle.state.position_initialized = true;
    }
    world.run(1);
}

JobOrder order_of(const World& world, const std::string& vehicle) {
    for (const auto& [id, order] : world.store.orders) {
        if (order.assigned_vehicle == VehicleId(vehicle) ||
            order.wanted_vehicle == VehicleId(vehicle)) {
            return order;
        }
    }
    return {};
}

Closure close_lane(World& world, double from_x_m, double to_x_m) {
    NewClosure closure;
    closure.name = "Door test";
    closure.hall = world.plant.halls[0].id;
    closure.outline = {{from_x_m, 36}, {to_x_m, 36}, {to_x_m, 44}, {from_x_m, 44}};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    EXPECT_TRUE(closed);
    return closed ? *closed : Closure{};
}

}  // namespace pulseline::fleet::testing
