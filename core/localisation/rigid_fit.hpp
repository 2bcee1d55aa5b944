#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::localisation {

/// A point of the body that was found in the hall.
struct PlacedPoint {
    geometry::Point2 in_body;
    geometry::Point2 in_hall;
    double sigma_m = 0;  // per axis, of one against the other
};

/// Planar rigid fit of a body to where its points were found, weighted by their sigmas.
struct RigidFit {
    geometry::Pose2 pose;  // hall from body
    /// How (x_m, y_m, heading_rad) moves with each point's place in the hall.
    std::vector<Eigen::Matrix<double, 3, 2>> by_place;
    double chi2 = 0;  // of 2 n - 3 degrees of freedom
    double worst_m = 0;
    bool agrees() const;
};

/// REQUIRES: two points at least that do not coincide in the body, sigmas above 0.
RigidFit rigid_fit(std::span<const PlacedPoint> points);

/// Chi-square that one in 100,000 exceeds by chance (Wilson and Hilferty's approximation).
double chi2_limit(int degrees_of_freedom);

}  // namespace pulseline::localisation
