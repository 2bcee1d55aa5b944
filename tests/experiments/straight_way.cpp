#include "tests/experiments/straight_way.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace pulseline::experiments {
namespace {

using geometry::Pose2;

constexpr double kLength_m = kWayLength_m;
constexpr double kPiece_m = 4;

/// Transmitters on both sides of the way, as they stand in a hall.
void set_up_transmitters(plant::Plant& plant) {
    constexpr double kEvery_m = 15;
    constexpr double kBeside_m = 8;
    for (double at_m = 0; at_m <= kLength_m; at_m += kEvery_m) {
        plant::Transmitter transmitter;
        const auto number = static_cast<double>(plant.transmitters.size());
        transmitter.id = plant::TransmitterId(fmt::format("tx-{}", number + 1));
        transmitter.hall = plant.halls.front().id;
        transmitter.position = {at_m, plant.transmitters.size() % 2 == 0 ? kBeside_m : -kBeside_m};
        transmitter.heading_rad = wrap(number);
        transmitter.rate_hz = 35 + 0.5 * number;
        transmitter.range_m = 30;
        plant.transmitters.push_back(transmitter);
    }
}

/// Reflectors on both walls of the way, no two distances alike.
void set_up_reflectors(plant::Plant& plant) {
    constexpr double kEvery_m = 12;
    constexpr double kWall_m = 12;
    for (int i = 0; i * kEvery_m <= kLength_m + kEvery_m; ++i) {
        plant::Reflector reflector;
        reflector.id = plant::ReflectorId(fmt::format("r-{}", i + 1));
        reflector.hall = plant.halls.front().id;
        reflector.position = {i * kEvery_m + 3 * std::sin(2.4 * i),
                              i % 2 == 0 ? kWall_m : -kWall_m};
        plant.reflectors.push_back(reflector);
    }
}

/// Racks and jigs on both sides of the way, no two alike.
void set_up_racks(plant::Plant& plant) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (const double side : {-1.0, 1.0}) {
        for (double at_m = -20; at_m < kLength_m + 20; at_m += 5 + 5 * share(random)) {
            const double from_m = 3.5 + 2 * share(random);
            const double to_m = from_m + 0.6 + 1.4 * share(random);
            const double end_m = at_m + 1 + 2 * share(random);
            plant::Area rack;
            rack.id = plant::AreaId(fmt::format("rack-{}", plant.areas.size() + 1));
            rack.hall = plant.halls.front().id;
            rack.kind = plant::AreaKind::kObstacle;
            rack.outline = {{at_m, std::min(side * from_m, side * to_m)},
                            {end_m, std::min(side * from_m, side * to_m)},
                            {end_m, std::max(side * from_m, side * to_m)},
                            {at_m, std::max(side * from_m, side * to_m)}};
            plant.areas.push_back(rack);
        }
    }
}

}  // namespace

void lay_code(plant::Plant& plant, const plant::VehicleType& type, const Pose2& pose) {
    plant::Marker marker;
    const std::string number = std::to_string(plant.markers.size() + 1);
    marker.id = plant::MarkerId("code-" + number);
    marker.payload = number;
    marker.kind = type.usual_code.kind;
    marker.size_m = type.usual_code.size_m;
    marker.hall = plant.halls.front().id;
    marker.pose = pose;
    marker.sigma_xy_m = 1e-4;
    marker.sigma_heading_rad = 5e-4;
    plant.markers.push_back(marker);
}

plant::Plant straight_way(plant::Plant plant, const plant::VehicleType& type, Method method,
                          double spacing_m) {
    plant.markers.clear();
    plant.transmitters.clear();
    plant.reflectors.clear();
    plant.areas.clear();
    plant.halls.front().outline = {{-30, -30}, {230, -30}, {230, 30}, {-30, 30}};
    if (method == Method::kLight) set_up_transmitters(plant);
    if (method == Method::kReflectors) set_up_reflectors(plant);
    if (method == Method::kContours) set_up_racks(plant);
    for (double at_m = spacing_m; spacing_m > 0 && at_m <= kLength_m; at_m += spacing_m) {
        lay_code(plant, type, {at_m, 0, 0});
    }
    return plant;
}

std::vector<kinematics::Segment> pieces() {
    std::vector<kinematics::Segment> pieces;
    for (double at_m = 0; at_m < kLength_m; at_m += kPiece_m) {
        kinematics::Segment piece;
        piece.start = {at_m, 0, 0};
        piece.end = {at_m + kPiece_m, 0, 0};
        piece.length_m = kPiece_m;
        pieces.push_back(piece);
    }
    return pieces;
}

}  // namespace pulseline::experiments
