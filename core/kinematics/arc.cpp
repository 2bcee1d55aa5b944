#include "core/kinematics/arc.hpp"

#include <cmath>

namespace pulseline::kinematics {

using geometry::Point2;

double TangentArc::turn_rad(bool backwards) const {
    return 2 * phi_rad - (backwards ? std::copysign(2 * kPi, phi_rad) : 0.0);
}

double TangentArc::gamma_rad(bool backwards) const { return std::abs(turn_rad(backwards)); }

std::optional<TangentArc> tangent_arc(const geometry::Pose2& from, Point2 target) {
    const double c = std::cos(from.heading_rad);
    const double s = std::sin(from.heading_rad);
    const Point2 d = target - from.position();
    const Point2 right{s, -c};
    const double to_right = dot(right, d);
    if (to_right == 0) return std::nullopt;
    TangentArc arc;
    arc.offset_m = -to_right;
    arc.rho_m = dot(d, d) / (2 * to_right);
    arc.centre = from.position() + arc.rho_m * right;
    arc.phi_rad = std::atan2(-to_right, c * d.x_m + s * d.y_m);
    arc.arrival_rad = wrap(from.heading_rad + 2 * arc.phi_rad);
    return arc;
}

}  // namespace pulseline::kinematics
