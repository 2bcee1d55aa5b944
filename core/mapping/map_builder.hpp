#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/control/scan.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace pulseline::mapping {

/// Builds the map of a hall while a vehicle drives through it: simultaneous localisation and
/// mapping by a Rao-Blackwellised particle filter (Grisetti 2007; Li 2022 section 2.3), by MRPT.
/// Each particle has a way of its own, as far from the one that the vehicle's senses tell as their
/// noise allows, and the map that follows from it; ways whose map fits to what is seen again stay.
/// Matching scan to scan alone would bend a hall of 100 m by a metre. Thread safety: none.
class MapBuilder {
public:
    /// Where lanes lead along walls: what is seen from farther off is drawn less sharply.
    static constexpr double kWithin_m = 12;

    /// `start`: where the vehicle stands, which gives the map its frame. What is farther off than
    /// `within_m` is not drawn.
    explicit MapBuilder(const geometry::Pose2& start, double within_m = kWithin_m);
    ~MapBuilder();

    /// The vehicle has moved by `moved` since, seen from where it was, with this covariance of
    /// (ahead_m, left_m, turn_rad), and its scanners see this now.
    void take(const geometry::Pose2& moved, const Eigen::Matrix3d& moved_covariance,
              const std::vector<control::Scan>& scans);
    /// A code tells where it stands now: ways that have come elsewhere count the less the more
    /// sigmas they are off, and all go on from there, so that a map that knows codes is not bent.
    void stands_at(const geometry::Pose2& pose, const Eigen::Matrix3d& covariance);
    OccupancyMap map() const;

private:
    struct Slam;
    std::unique_ptr<Slam> slam_;
};

}  // namespace pulseline::mapping
