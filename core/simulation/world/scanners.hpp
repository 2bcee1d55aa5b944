#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "core/onboard/scanners.hpp"
#include "core/simulation/world/lidar.hpp"
#include "core/simulation/world/world.hpp"

namespace pulseline::simulation {

/// The scanners of a vehicle's type, which see the walls, columns (of its grid) and obstacles of
/// its hall, what put() places and the vehicles around.
class SimulatedScanners : public onboard::Scanners {
public:
    /// `true_pose`: where the vehicle truly stands; must outlive it.
    SimulatedScanners(const World& world, const plant::HallId& hall, const plant::VehicleType& type,
                      const Pose2& true_pose, std::uint64_t seed);

    /// Something not in the drawing, hall frame.
    void put(geometry::Polygon obstacle) { others_.push_back(std::move(obstacle)); }
    void take_away() { others_.clear(); }
    /// The windows of all of them, until they are cleaned.
    void cover() { covered_ = true; }
    void clean() { covered_ = false; }
    /// The bodies of the vehicles near a place, as they truly stand now: asked at every scan.
    using Neighbours = std::function<void(geometry::Point2, std::vector<geometry::Polygon>&)>;
    void see(Neighbours neighbours) { neighbours_ = std::move(neighbours); }

    void scan(std::vector<control::Scan>& scans) override;

private:
    const Pose2& true_pose_;
    std::vector<Lidar> scanners_;
    std::vector<geometry::Polygon> others_;
    Neighbours neighbours_;
    std::vector<geometry::Polygon> seen_;  // by the last scan, beside what stands for good
    std::mt19937_64 random_;
    bool covered_ = false;
};

}  // namespace pulseline::simulation
