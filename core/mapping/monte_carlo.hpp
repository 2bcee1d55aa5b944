#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/control/scan.hpp"
#include "core/mapping/occupancy_map.hpp"

namespace pulseline::mapping {

/// A map prepared for many scans, shared by all vehicles of a program.
struct MatchedMap;
std::shared_ptr<const MatchedMap> prepare(OccupancyMap map);

/// Where a vehicle stands by what its scanners see of a hall that was mapped before: adaptive
/// Monte-Carlo localisation (Fox 2003; Li 2022 section 2.3), by MRPT. It follows a vehicle from a
/// place that is roughly known; a hall looks alike in too many places to find it from nothing.
/// Thread safety: none, and all that share a map must be of one thread.
class MonteCarlo {
public:
    MonteCarlo(std::shared_ptr<const MatchedMap> map, std::uint64_t seed);
    ~MonteCarlo();
    MonteCarlo(MonteCarlo&&) noexcept;

    /// Covariance of (x_m, y_m, heading_rad), hall frame.
    void begin_at(const geometry::Pose2& pose, const Eigen::Matrix3d& covariance);

    struct Cloud {
        geometry::Pose2 pose;
        Eigen::Matrix3d covariance;  // of (x_m, y_m, heading_rad), hall frame
        int returns = 0;             // rays that met something
        /// Of them, how many ended where the map has something: the others met what is not in it.
        double explained = 0;
        /// Of them, how many went through what the map has: none, where it is right, whoever stands
        /// around.
        double through = 0;
    };
    /// The vehicle has moved by `moved`, seen from where it was, with this covariance of (ahead_m,
    /// left_m, turn_rad), and its scanners see this now.
    Cloud step(const geometry::Pose2& moved, const Eigen::Matrix3d& moved_covariance,
               const std::vector<control::Scan>& scans);

private:
    struct Particles;
    std::unique_ptr<Particles> particles_;
};

}  // namespace pulseline::mapping
