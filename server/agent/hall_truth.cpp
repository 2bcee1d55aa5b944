#include "server/agent/hall_truth.hpp"

namespace pulseline::agent {
namespace {

constexpr double kAround_m = 20;      // farther codes are no camera's business
constexpr std::size_t kQrBytes = 11;  // of a version 1 symbol, level Q

}  // namespace

std::vector<simulation::FloorCode> codes_around(const simulation::World& world,
                                                const plant::HallId& hall,
                                                const geometry::Pose2& true_pose, bool drawn) {
    std::vector<simulation::FloorCode> codes;
    for (const auto& marker : world.markers) {
        const bool drawable =
            marker.kind != plant::MarkerKind::kQr || marker.payload.size() <= kQrBytes;
        if (drawn && !drawable) continue;
        if (marker.hall != hall) continue;
        if (distance(marker.pose.position(), true_pose.position()) > kAround_m) continue;
        codes.push_back({marker.payload, marker.pose, marker.size_m, false, marker.kind});
    }
    return codes;
}

double first_load_kg(const plant::Plant& plant, const plant::Vehicle& vehicle) {
    const auto* load = plant::first_load(plant, vehicle.id);
    return load == nullptr ? 0 : load->mass_kg;
}

std::optional<simulation::TrueLoad> carried_at_first(const plant::Plant& plant,
                                                     const plant::Vehicle& vehicle) {
    const auto* load = plant::first_load(plant, vehicle.id);
    if (load == nullptr) return std::nullopt;
    return simulation::TrueLoad{load->id, load->mass_kg, load->centre};
}

std::vector<geometry::Pose2> charger_contacts(const plant::Plant& plant) {
    std::vector<geometry::Pose2> poses;
    for (const auto& station : plant.stations) {
        if (station.charger) poses.push_back(station.pose);
    }
    return poses;
}

geometry::Polygon thing_at(geometry::Point2 place) {
    constexpr double kBox_m = 0.5;
    return geometry::transformed({place.x_m, place.y_m, 0}, geometry::rectangle(kBox_m, kBox_m));
}

}  // namespace pulseline::agent
