#include "core/simulation/world/scanners.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/plant/grid_blocks.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Polygon;

std::vector<Polygon> standing_things(const World& world, const plant::HallId& id) {
    std::vector<Polygon> things;
    if (const auto* hall = plant::find_hall(world.plant, id)) {
        things.push_back(hall->outline);
        std::ranges::move(plant::grid_blocks(*hall), std::back_inserter(things));
    }
    for (const auto& area : world.plant.areas) {
        if (area.hall == id && area.kind == plant::AreaKind::kObstacle) {
            things.push_back(area.outline);
        }
    }
    return things;
}

}  // namespace

SimulatedScanners::SimulatedScanners(const World& world, const plant::HallId& hall,
                                     const plant::VehicleType& type, const Pose2& true_pose,
                                     std::uint64_t seed)
    : true_pose_(true_pose), random_(seed) {
    const auto things = standing_things(world, hall);
    for (const auto& scanner : type.scanners) scanners_.emplace_back(scanner, things);
}

void SimulatedScanners::scan(std::vector<control::Scan>& scans) {
    seen_ = others_;
    if (neighbours_) neighbours_(true_pose_.position(), seen_);
    scans.resize(scanners_.size());
    for (std::size_t i = 0; i < scanners_.size(); ++i) {
        scanners_[i].scan(true_pose_, seen_, random_, scans[i]);
        scans[i].blind = covered_;
        if (covered_) {
            std::ranges::fill(scans[i].ranges_m, std::numeric_limits<float>::infinity());
        }
    }
}

}  // namespace pulseline::simulation
