#include "core/localisation/rigid_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/geometry/bearing.hpp"

namespace pulseline::localisation {

using geometry::Point2;
using geometry::Pose2;

Pose2 pose_by_two(const PlacedPoint& rear, const PlacedPoint& front) {
    const double heading_rad =
        wrap(bearing_rad(rear.in_hall, front.in_hall) - bearing_rad(rear.in_body, front.in_body));
    const Point2 middle = Pose2{0, 0, heading_rad} * (0.5 * (rear.in_body + front.in_body));
    const Point2 at = 0.5 * (rear.in_hall + front.in_hall) - middle;
    return {at.x_m, at.y_m, heading_rad};
}

RigidFit rigid_fit(std::span<const PlacedPoint> points) {
    const auto weight = [](const PlacedPoint& point) { return 1 / square(point.sigma_m); };
    double sum = 0;
    Point2 body;
    Point2 hall;
    for (const PlacedPoint& point : points) {
        sum += weight(point);
        body = body + weight(point) * point.in_body;
        hall = hall + weight(point) * point.in_hall;
    }
    body = (1 / sum) * body;
    hall = (1 / sum) * hall;
    double along = 0;
    double across = 0;
    double spread = 0;  // of the points about their middle, weighted
    for (const PlacedPoint& point : points) {
        const Point2 arm = point.in_body - body;
        along += weight(point) * dot(arm, point.in_hall - hall);
        across += weight(point) * cross(arm, point.in_hall - hall);
        spread += weight(point) * dot(arm, arm);
    }
    RigidFit fit;
    const Pose2 turned{0, 0, std::atan2(across, along)};
    const Point2 middle = turned * body;  // from the body's origin, hall frame
    fit.pose = {hall.x_m - middle.x_m, hall.y_m - middle.y_m, turned.heading_rad};
    for (const PlacedPoint& point : points) {
        const Point2 arm = turned * (point.in_body - body);
        const Eigen::RowVector2d turn =
            weight(point) / spread * Eigen::RowVector2d(-arm.y_m, arm.x_m);
        Eigen::Matrix<double, 3, 2> by_place;
        by_place.topRows<2>() = weight(point) / sum * Eigen::Matrix2d::Identity() +
                                Eigen::Vector2d(middle.y_m, -middle.x_m) * turn;
        by_place.row(2) = turn;
        fit.by_place.push_back(by_place);
        const double off_m = distance(fit.pose * point.in_body, point.in_hall);
        fit.chi2 += square(off_m / point.sigma_m);
        fit.worst_m = std::max(fit.worst_m, off_m);
    }
    return fit;
}

bool RigidFit::agrees() const {
    return chi2 <= chi2_limit(2 * static_cast<int>(by_place.size()) - 3);
}

double chi2_limit(int degrees_of_freedom) {
    constexpr double kQuantile = 4.2649;  // of the normal distribution, 99.999 %
    const double k = degrees_of_freedom;
    const double spread = 2 / (9 * k);
    const double root = 1 - spread + kQuantile * std::sqrt(spread);
    return k * root * root * root;
}

}  // namespace pulseline::localisation
