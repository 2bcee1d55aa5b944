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

std::vector<geometry::Pose2> charger_contacts(const plant::Plant& plant) {
    std::vector<geometry::Pose2> poses;
    for (const auto& station : plant.stations) {
        if (station.charger) poses.push_back(station.pose);
    }
    return poses;
}

}  // namespace pulseline::agent
