#pragma once

#include <optional>

#include "core/geometry/pose2.hpp"

namespace pulseline::kinematics {

/// The circle tangent to a vehicle's heading line that passes through a target: Tang 2020 eq. 7 to
/// 13 as corrected (closed form, no tangent or cotangent of the heading).
struct TangentArc {
    double rho_m = 0;         // signed radius: > 0 centre on the right, forwards is clockwise
    geometry::Point2 centre;  // P
    double phi_rad = 0;       // bearing of the target from the heading; ccw positive
    double arrival_rad = 0;   // heading on arrival, forwards and backwards alike
    double offset_m = 0;      // distance of the target from the heading line; > 0 on the left

    /// Change of heading, ccw positive: forwards 2 phi, backwards the rest of the circle.
    double turn_rad(bool backwards) const;
    /// Central angle gamma >= 0.
    double gamma_rad(bool backwards) const;
};

/// nullopt when the target lies exactly on the heading line (or is the start itself).
std::optional<TangentArc> tangent_arc(const geometry::Pose2& from, geometry::Point2 target);

}  // namespace pulseline::kinematics
