#include "core/mapping/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/angle.hpp"

namespace pulseline::mapping {
namespace {

constexpr int kDirections = 8;
// Two cells, so that a wall in two rows is one.
constexpr double kOneLine_m = 0.1;

Eigen::Vector2d towards(int direction) {
    const double angle_rad = direction * kPi / kDirections;
    return {std::cos(angle_rad), std::sin(angle_rad)};
}

int nearest_direction(const Eigen::Vector2d& across) {
    int nearest = 0;
    for (int i = 1; i < kDirections; ++i) {
        if (std::abs(across.dot(towards(i))) > std::abs(across.dot(towards(nearest)))) nearest = i;
    }
    return nearest;
}

}  // namespace

void Surfaces::add(const Met& met, const Eigen::Matrix<double, 2, 3>& by_pose) {
    for (int i = 0; i < 2; ++i) {
        if (met.worth[i] <= 0) continue;
        Eigen::Vector2d across = met.across.col(i);
        const int direction = nearest_direction(across);
        const Eigen::Vector2d unit = towards(direction);
        if (across.dot(unit) < 0) across = -across;
        const Eigen::Vector3d moves = by_pose.transpose() * across;
        information_ += met.worth[i] * moves * moves.transpose();
        rays_.push_back({direction, unit.x() * met.middle.x_m + unit.y() * met.middle.y_m,
                         met.worth[i] * moves});
    }
}

std::vector<Eigen::Vector3d> Surfaces::answers() const {
    std::vector<Ray> rays = rays_;
    std::ranges::sort(rays, [](const Ray& a, const Ray& b) {
        return std::tie(a.direction, a.offset_m) < std::tie(b.direction, b.offset_m);
    });
    std::vector<Eigen::Vector3d> answers;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool same = i > 0 && rays[i].direction == rays[i - 1].direction &&
                          rays[i].offset_m - rays[i - 1].offset_m < kOneLine_m;
        if (!same) answers.emplace_back(Eigen::Vector3d::Zero());
        answers.back() += rays[i].answer;
    }
    return answers;
}

}  // namespace pulseline::mapping
