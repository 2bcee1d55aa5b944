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

/// Where a vehicle stands by what its scanners see of a hall that was mapped before: Monte-Carlo
/// localisation (Fox 2003; Li 2022 section 2.3), by MRPT, as a Gaussian particle filter (Kotecha
/// and Djuric 2003): each look draws new particles around where the vehicle holds itself to be, so
/// that none die out along a wall that tells nothing about where along it one is. It needs a place
/// that is roughly known; a hall looks alike in too many places to find it from nothing. Thread
/// safety: none, and all that share a map must be of one thread.
class MonteCarlo {
public:
    MonteCarlo(std::shared_ptr<const MatchedMap> map, std::uint64_t seed);
    ~MonteCarlo();
    MonteCarlo(MonteCarlo&&) noexcept;

    /// What a look tells by itself: where the vehicle was held to be is not in it. Covariances of
    /// (x_m, y_m, heading_rad), hall frame, with the map's own error.
    struct Told {
        bool anything = false;
        bool everything = false;  // in all directions
        geometry::Pose2 pose;
        Eigen::Matrix3d covariance;  // huge in directions of which it tells nothing
        /// What of it the map is off, which looks from near there share; 0 where it tells nothing.
        Eigen::Matrix3d of_map;
    };
    struct Look {
        Told news;        // in directions in which the map is better than what was known before
        Told check;       // in all in which it is better than how wide it had to look around
        int returns = 0;  // rays that met something
        /// Of them, how many ended where the map has something: the others met what is not in it.
        double explained = 0;
        /// Of them, how many went through what the map has: none, where it is right, whoever stands
        /// around.
        double through = 0;
    };
    /// The vehicle is held to be about there, with this covariance; it looks around as far as
    /// `covariance + around` says, in case that something has moved it. `of_map`: the map's own
    /// error, as a covariance of the same three.
    Look look(const geometry::Pose2& about, const Eigen::Matrix3d& covariance,
              const Eigen::Matrix3d& around, const Eigen::Matrix3d& of_map,
              const std::vector<control::Scan>& scans);

private:
    struct Particles;
    std::unique_ptr<Particles> particles_;
};

}  // namespace pulseline::mapping
