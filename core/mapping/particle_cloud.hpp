#pragma once

#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/control/scan.hpp"
#include "core/geometry/pose2.hpp"
#include "core/mapping/likelihood_field.hpp"

namespace pulseline::mapping {

/// A Gaussian of (x_m, y_m, heading_rad).
struct Around {
    geometry::Pose2 about;
    Eigen::Matrix3d covariance;
};

/// Places where a vehicle may stand, each weighed by how well it explains what the scanners see, by
/// MRPT. Frame: that of the grid, whose corner is the origin. Thread safety: none.
class ParticleCloud {
public:
    ParticleCloud(std::shared_ptr<LikelihoodField> grid, std::uint64_t seed);
    /// Whether few particles and few rays are enough.
    static bool is_well_known(const Eigen::Matrix3d& covariance);

    struct Told {
        geometry::Pose2 mean;
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        double power = 0;     // what one ray counted: 1, where enough particles see what it sees
        double carrying = 0;  // particles that carry weight: all of the above is known by so many
    };
    /// The mean of where it may stand, which was held to be `prior` before. Where that is known
    /// roughly it anneals: particles are drawn anew around those that carry weight, and count as if
    /// they had been drawn around `prior`, until each ray counts in full.
    Told look(const Around& prior, const std::vector<control::Scan>& rays);

private:
    struct Weighed {
        std::vector<double> weights;  // their sum is 1
        double power = 0;
    };
    void spread(const Around& drawn, unsigned count);
    void weigh(const std::vector<control::Scan>& rays);
    std::vector<double> count_as(const Around& prior, const Around& drawn) const;
    std::vector<double> weights(const std::vector<double>& counts, double power) const;
    Weighed tempered(const std::vector<double>& counts, int finer) const;
    geometry::Pose2 at(std::size_t particle) const;
    Around gaussian_of(const std::vector<double>& weights) const;

    std::uint64_t seed_;
    std::uint64_t drawn_ = 0;  // times
    mrpt::slam::CMonteCarloLocalization2D cloud_;
};

}  // namespace pulseline::mapping
