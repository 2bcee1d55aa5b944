#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::simulation {

/// Something elastic that a body may rest on. It pushes and never pulls.
struct Support {
    geometry::Point2 place;  // body frame
    double height_m = 0;     // of its top, while nothing presses on it
    double stiffness_npm = 0;
};

/// A rigid body in balance on its supports.
struct Rest {
    Eigen::Vector3d plane;        // z in m at the body's origin, its slopes along x and y
    std::vector<double> force_n;  // of each support, 0 where the body is clear of it
};

/// How a body of that weight and centre (body frame) lies on them: where its energy, that of the
/// springs and of its weight, is least. Nothing: it tips, since its centre lies outside of what can
/// carry it, or there is no weight.
std::optional<Rest> rest_on(const std::vector<Support>& supports, double weight_n,
                            geometry::Point2 centre);

}  // namespace pulseline::simulation
