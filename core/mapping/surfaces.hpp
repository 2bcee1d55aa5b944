#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::mapping {

/// What a ray's end met in a map: two directions across it, the first of a wall's face, and how
/// much the ray tells along each: 1 across a wall, 0 along it, both at a corner.
struct Met {
    Eigen::Matrix2d across;  // unit vectors, as columns
    Eigen::Vector2d worth;
    geometry::Point2 middle;  // of the cells around
};

/// The surfaces that the rays of one look have met. All that lies in one line is one surface: a map
/// puts it into one row of cells, so that all of it is off by the same. Thread safety: none.
class Surfaces {
public:
    /// A ray's end on it; `by_pose`: how that moves with (x_m, y_m, heading_rad) of the body.
    void add(const Met& met, const Eigen::Matrix<double, 2, 3>& by_pose);
    /// Of all rays, what they tell of the pose, in units of one ray across a wall.
    const Eigen::Matrix3d& information() const { return information_; }
    /// A vector a surface: how the sum over its rays answers to the surface being off by one unit.
    std::vector<Eigen::Vector3d> answers() const;

private:
    struct Ray {
        int direction = 0;
        double offset_m = 0;
        Eigen::Vector3d answer;
    };
    std::vector<Ray> rays_;
    Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
};

}  // namespace pulseline::mapping
