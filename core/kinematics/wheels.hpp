#pragma once

#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

/// Wheels and body motion, both ways, for every family: differential (Li 2020), Mecanum (Wang,
/// matrix as corrected) and any set of steered wheels, of which Tang's platform is one (Tang 2020
/// eq. 3, 10 and 11 as corrected). Angles are counter-clockwise, y is to the left; Tang's are
/// clockwise.
namespace pulseline::kinematics {

/// Velocity of the body in its own frame.
struct Twist {
    double vx_mps = 0;      // forward
    double vy_mps = 0;      // to the left
    double turn_radps = 0;  // counter-clockwise
    bool operator==(const Twist&) const = default;
};

/// What one wheel does on the floor.
struct WheelMotion {
    double angle_rad = 0;  // of its rolling direction in the body frame; 0 for one not steered
    double speed_mps = 0;  // of its rim; for Mecanum wheels radius times rate
    bool operator==(const WheelMotion&) const = default;
};

/// What the wheels say, and how much they contradict each other.
struct BodyMotion {
    Twist twist;
    /// Root mean square of the speeds along the floor that the twist leaves unexplained: slip, or a
    /// wrong wheel. For four Mecanum wheels |w1 + w2 - w3 - w4| R / 4.
    double slip_mps = 0;
};

/// How far a steered wheel turns to either side. A little more than a quarter turn: with rolling
/// backwards every direction can be had, and two ways near the end of the range.
constexpr double kSteeringLimit_rad = radians(100.0);

/// The wheels of a twist, in the type's order of wheels. A steered wheel takes, of its direction
/// and the opposite one rolling backwards, what is inside `steering_limit_rad` and turns less from
/// its present angle (`present`: empty or one each; without it from straight ahead); at rest it
/// keeps it. Fails, Errc::kUnreachable: cannot_move_so {wheel, sideways_mps} when a wheel that is
/// not steered would be dragged sideways. REQUIRES: kSteeringLimit is at least a quarter turn.
Result<std::vector<WheelMotion>> wheels_of(const plant::VehicleType& type, const Twist& twist,
                                           std::span<const WheelMotion> present = {},
                                           double steering_limit_rad = kSteeringLimit_rad);

/// The twist that explains the wheels best (least squares over all of them; wheels of one line
/// cannot say everything about some twists, then the least twist). REQUIRES: one motion a wheel.
BodyMotion body_of(const plant::VehicleType& type, std::span<const WheelMotion> wheels);

/// How many times the twist may be driven: no wheel rolls faster than the type's top speed, nor the
/// body, which turns no faster than its limit. Infinite for standing still.
double most_times(const plant::VehicleType& type, const Twist& twist);
/// The same motion slowed down until that holds for it.
Twist within_limits(const plant::VehicleType& type, const Twist& twist);

/// Longest time that steered wheels need to turn from one set of angles to another.
double steering_duration_s(const plant::VehicleType& type, std::span<const WheelMotion> from,
                           std::span<const WheelMotion> to);

}  // namespace pulseline::kinematics
