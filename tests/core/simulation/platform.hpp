#pragma once

#include <cmath>

#include "core/simulation/machine/vehicle_motion.hpp"

/// Builders for tests of the simulated vehicle.
namespace pulseline::simulation::testing {

using kinematics::Segment;

inline plant::VehicleType platform_type() {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("platform");
    type.name = "Platform";
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.max_speed_mps = 0.5;
    type.max_accel_mps2 = 0.1;
    type.max_turn_rate_radps = 0.1;
    type.max_turn_accel_radps2 = 0.05;
    return type;
}

inline MotionErrors exact() {
    MotionErrors none;
    none = {.distance_scale = 0,
            .turn_scale = 0,
            .steering_bias_rad = 0,
            .slip_m_per_sqrt_m = 0,
            .heading_rad_per_sqrt_m = 0,
            .heading_rad_per_sqrt_rad = 0,
            .settle_m = 0,
            .settle_rad = 0,
            .fine_scale = 0,
            .fine_offset_m = 0,
            .fine_offset_rad = 0,
            .fine_m = 0,
            .fine_rad = 0};
    return none;
}

inline Segment straight(const Pose2& from, double length_m, double direction_rad = 0) {
    Segment segment;
    segment.kind = Segment::Kind::kStraight;
    segment.start = from;
    segment.end =
        from * Pose2{length_m * std::cos(direction_rad), length_m * std::sin(direction_rad), 0};
    segment.length_m = length_m;
    segment.direction_rad = direction_rad;
    return segment;
}

inline Segment turn(const Pose2& from, double turn_rad) {
    Segment segment;
    segment.kind = Segment::Kind::kRotate;
    segment.start = from;
    segment.end = from * Pose2{0, 0, turn_rad};
    segment.turn_rad = turn_rad;
    return segment;
}

inline Segment arc(const Pose2& from, geometry::Point2 centre, double turn_rad,
                   bool backwards = false) {
    Segment segment;
    segment.kind = Segment::Kind::kArc;
    segment.start = from;
    segment.centre = centre;
    segment.turn_rad = turn_rad;
    const auto radius = from.position() - centre;
    const auto end = centre + Pose2{0, 0, turn_rad} * radius;
    segment.end = {end.x_m, end.y_m, wrap(from.heading_rad + turn_rad)};
    segment.length_m = (backwards ? -1 : 1) * std::abs(turn_rad) * norm(radius);
    return segment;
}

}  // namespace pulseline::simulation::testing
