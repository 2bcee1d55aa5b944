#include "tests/bench/lanes.hpp"

#include <string>
#include <utility>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::bench {

plant::Plant lanes(int count) {
    plant::Plant plant = fleet::testing::small_plant();
    constexpr double kLane_m = 4;
    constexpr double kLength_m = 24;
    plant.halls.front().outline =
        geometry::transformed({kLength_m / 2 + 10, kLane_m * count / 2 + 10, 0},
                              geometry::rectangle(kLength_m + 40, kLane_m * count + 40));
    const plant::Station station = plant.stations.front();
    const plant::Vehicle vehicle = plant.vehicles.front();
    const plant::RoadmapEdge edge = plant.edges.front();
    plant.stations.clear();
    plant.markers.clear();
    plant.nodes.clear();
    plant.edges.clear();
    plant.vehicles.clear();
    const auto node = [](int number) { return plant::NodeId("n" + std::to_string(number)); };
    const auto join = [&](int from, int to) {
        for (const auto& [a, b] : {std::pair{from, to}, std::pair{to, from}}) {
            plant.edges.push_back(edge);
            plant.edges.back().from = node(a);
            plant.edges.back().to = node(b);
            plant.edges.back().id = plant::EdgeId(node(a).str() + node(b).str());
        }
    };
    for (int i = 0; i < count; ++i) {
        for (int end = 0; end < 2; ++end) {
            const int number = 2 * i + end + 1;
            plant::Station made = station;
            made.id = plant::StationId("s" + std::to_string(number));
            made.number = number;
            made.markers.clear();
            made.resting_place = true;
            made.pose = {10 + end * kLength_m, 10 + i * kLane_m, 0};
            made.node = node(number);
            plant.stations.push_back(made);
            plant.nodes.push_back({made.node, made.hall, made.pose.position()});
        }
        join(2 * i + 1, 2 * i + 2);
        plant.vehicles.push_back(vehicle);
        plant::Vehicle& made = plant.vehicles.back();
        made.id = plant::VehicleId("V" + std::to_string(i + 1));
        made.serial_number = made.id.str();
        made.home = plant.stations[static_cast<std::size_t>(2 * i)].id;
    }
    return plant;
}

}  // namespace pulseline::bench
