#include "core/simulation/world/scanners.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Polygon;

std::vector<Polygon> standing_things(const World& world, const plant::HallId& id) {
    std::vector<Polygon> things;
    if (const auto* hall = plant::find_hall(world.plant, id)) things.push_back(hall->outline);
    for (const auto& area : world.plant.areas) {
        if (area.hall == id && area.kind == plant::AreaKind::kObstacle) {
            things.push_back(area.outline);
        }
    }
    return things;
}

/// Front left and back right, each looking away from the body.
std::vector<Pose2> corners(const Polygon& footprint) {
    const auto box = geometry::bounding_box(footprint);
    return {{box.max.x_m, box.max.y_m, kPi / 4}, {box.min.x_m, box.min.y_m, -3 * kPi / 4}};
}

}  // namespace

SimulatedScanners::SimulatedScanners(const World& world, const plant::HallId& hall,
                                     const plant::VehicleType& type, const Pose2& true_pose,
                                     std::uint64_t seed)
    : true_pose_(true_pose), random_(seed) {
    const auto things = standing_things(world, hall);
    for (const Pose2& corner : corners(type.footprint)) scanners_.emplace_back(corner, things);
}

void SimulatedScanners::scan(std::vector<control::Scan>& scans) {
    seen_ = others_;
    if (neighbours_) neighbours_(true_pose_.position(), seen_);
    scans.resize(scanners_.size());
    for (std::size_t i = 0; i < scanners_.size(); ++i) {
        scanners_[i].scan(true_pose_, seen_, random_, scans[i]);
    }
}

}  // namespace pulseline::simulation
