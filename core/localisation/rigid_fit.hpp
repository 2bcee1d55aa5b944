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

/// By two points: the heading turns the line between them in the body into the one in the hall, and
/// their middles coincide. With receivers 4 (rear) and 1 (front) of one side, whose line is the
/// body's own x, that is Wang's pose angle beta (4.2, four cases, right but undefined for y1 = y4)
/// plus pi/2; with two of a diagonal the middle is his eq. 1 and 2. REQUIRES: two different points.
geometry::Pose2 pose_by_two(const PlacedPoint& rear, const PlacedPoint& front);

/// By two points or more; of two the heading is pose_by_two's.
/// REQUIRES: two points at least that do not coincide in the body, sigmas above 0.
RigidFit rigid_fit(std::span<const PlacedPoint> points);

/// Chi-square that one in 100,000 exceeds by chance (Wilson and Hilferty's approximation).
double chi2_limit(int degrees_of_freedom);

}  // namespace pulseline::localisation
